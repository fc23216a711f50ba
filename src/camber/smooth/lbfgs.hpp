#pragma once
// Limited-memory BFGS on a plain vector; the objective may answer infinity outside its domain.
#include <camber/base/vec.hpp>

#include <functional>
#include <utility>

namespace camber {

/// The Hessian that the search starts from: symmetric positive definite.
class InitialHessian {
 public:
  virtual ~InitialHessian() = default;
  /// z = B^-1 r.
  virtual void solve(const VecX& r, VecX& z) const = 0;
  /// v^T B v.
  [[nodiscard]] virtual double squared_norm(const VecX& v) const = 0;
};

class DiagonalHessian : public InitialHessian {
 public:
  /// @param inverse  one over each diagonal entry, > 0
  explicit DiagonalHessian(VecX inverse) : inverse_(std::move(inverse)) {}
  void solve(const VecX& r, VecX& z) const override { z = inverse_.cwiseProduct(r); }
  [[nodiscard]] double squared_norm(const VecX& v) const override {
    return (v.array().square() / inverse_.array()).sum();
  }

 private:
  VecX inverse_;
};

struct LbfgsOptions {
  int memory = 10;
  int max_iterations = 100;
  double gradient_tolerance = 1e-8;  // relative to the first gradient, in the norm of B^-1
  double longest_step = 1e300;       // in the norm of B
};

/// Minimises f from x (changed in place), B the initial Hessian. Weak Wolfe line search; stops when
/// it fails or `is_done(x)` says so.
/// @param f  returns the value and fills the gradient; +inf where undefined (then the gradient is
/// ignored)
/// @return iterations made. Source: Nocedal 1980, doi 10.1090/S0025-5718-1980-0572855-7.
int minimise_lbfgs(const std::function<double(const VecX& x, VecX& gradient)>& f, VecX& x,
                   const InitialHessian& hessian, const LbfgsOptions& options,
                   const std::function<bool(const VecX& x)>& is_done = {});

}  // namespace camber
