#pragma once
// B-spline and NURBS curves and surfaces with two derivatives, by the Cox - de Boor recursion.
#include <camber/base/vec.hpp>
#include <camber/geom/parametric.hpp>

#include <span>
#include <vector>

namespace camber {

/// Highest degree accepted (OpenCASCADE's bound).
inline constexpr int k_max_bspline_degree = 25;

/// Basis functions N_{i,p} over a non-decreasing knot vector, each knot listed with its
/// multiplicity.
class BsplineBasis {
 public:
  /// The p + 1 functions that do not vanish on one span, and their derivatives.
  struct Values {
    double n[k_max_bspline_degree + 1];
    double dn[k_max_bspline_degree + 1];
    double ddn[k_max_bspline_degree + 1];
  };

  /// @param degree p, 1..k_max_bspline_degree
  /// @param knots  n + p + 1 values for n poles; every run is at most p + 1 long
  /// @throws GeometryError if these do not fit together
  BsplineBasis(int degree, std::vector<double> knots);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] int pole_count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  [[nodiscard]] double first() const { return knots_[static_cast<std::size_t>(degree_)]; }
  [[nodiscard]] double last() const {
    return knots_[knots_.size() - 1 - static_cast<std::size_t>(degree_)];
  }
  /// Distinct knots inside [lower, upper], with both of these.
  [[nodiscard]] std::vector<double> breaks(double lower, double upper) const;

  /// Index i of the first pole with an influence at t (span [t_{i+p}, t_{i+p+1})); the end spans
  /// serve parameters beyond the ends.
  [[nodiscard]] int first_pole(double t) const;
  /// N, N', N'' of poles first_pole(t).. at t. Source: [piegl1997] section 2.3, the recursion
  /// differentiated.
  void evaluate(int first_pole, double t, Values& values) const;

 private:
  int degree_;
  std::vector<double> knots_;
};

/// NURBS curve  C = sum w_i N_i P_i / sum w_i N_i.
class BsplineCurve final : public ParametricCurve {
 public:
  /// @param weights empty for a polynomial curve, else one positive weight a pole
  /// @throws GeometryError if sizes differ
  BsplineCurve(BsplineBasis basis, std::span<const Vec3> poles,
               std::span<const double> weights = {});

  [[nodiscard]] CurveJet jet(double t) const override;
  [[nodiscard]] double first() const override { return basis_.first(); }
  [[nodiscard]] double last() const override { return basis_.last(); }
  [[nodiscard]] double period() const override { return 0.0; }
  [[nodiscard]] std::vector<double> breaks() const override {
    return basis_.breaks(first(), last());
  }
  [[nodiscard]] const BsplineBasis& basis() const { return basis_; }

 private:
  BsplineBasis basis_;
  std::vector<Eigen::Vector4d> poles_;  // (w x, w y, w z, w)
  bool is_rational_;
};

/// NURBS tensor-product surface.
class BsplineSurface final : public ParametricSurface {
 public:
  /// @param poles   shape (nu, nv), v running fastest
  /// @param weights empty or the same shape
  /// @throws GeometryError if sizes differ
  BsplineSurface(BsplineBasis u_basis, BsplineBasis v_basis, std::span<const Vec3> poles,
                 std::span<const double> weights = {});

  [[nodiscard]] SurfaceJet jet(const Vec2& uv) const override;
  [[nodiscard]] UvBox domain() const override;
  [[nodiscard]] Vec2 periods() const override { return Vec2::Zero(); }
  [[nodiscard]] std::vector<double> breaks(int direction) const override;
  [[nodiscard]] const BsplineBasis& basis(int direction) const {
    return direction == 0 ? u_basis_ : v_basis_;
  }

 private:
  BsplineBasis u_basis_, v_basis_;
  std::vector<Eigen::Vector4d> poles_;
  bool is_rational_;
};

}  // namespace camber
