#pragma once
// Limited-memory BFGS on a plain vector; the objective may answer infinity outside its domain.
#include <camber/base/vec.hpp>

#include <functional>

namespace camber {

struct LbfgsOptions {
  int memory = 10;
  int max_iterations = 100;
  double gradient_tolerance = 1e-8;  // relative to the first scaled gradient
  double longest_step = 1e300;       // in the norm of the inverse of `inverse_diagonal`
};

/// Minimises f from x (changed in place). `inverse_diagonal` is the initial inverse Hessian (one
/// entry a variable, > 0). Weak Wolfe line search; stops when it fails or `is_done(x)` says so.
/// @param f  returns the value and fills the gradient; +inf where undefined (then the gradient is
/// ignored)
/// @return iterations made. Source: Nocedal 1980, doi 10.1090/S0025-5718-1980-0572855-7.
int minimise_lbfgs(const std::function<double(const VecX& x, VecX& gradient)>& f, VecX& x,
                   const VecX& inverse_diagonal, const LbfgsOptions& options,
                   const std::function<bool(const VecX& x)>& is_done = {});

}  // namespace camber
