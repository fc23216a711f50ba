#include <camber/reconstruct/detail/chain_curve.hpp>
#include <camber/reconstruct/detail/local_fit.hpp>

#include <algorithm>
#include <cmath>

namespace camber::detail {
namespace {

/// Neighbours along the chain that a fit sees, all together.
constexpr int k_window = 6;

std::vector<CurveFit> fit_all(const FacetMesh& mesh, const Chain& chain) {
  const int n = static_cast<int>(chain.vertices.size());
  const auto point = [&](int i) {
    return mesh.points[at(chain.vertices[static_cast<std::size_t>((i + n) % n)])];
  };
  std::vector<CurveFit> fits;
  for (int i = 0; i < n; ++i) {
    int back = chain.is_closed ? std::min(k_window / 2, (n - 1) / 2) : std::min(i, k_window / 2);
    int forth = chain.is_closed ? back : std::min(n - 1 - i, k_window / 2);
    if (!chain.is_closed) {  // at an end look further to the other side
      back = std::min(i, std::max(back, k_window - 1 - forth));
      forth = std::min(n - 1 - i, std::max(forth, k_window - 1 - back));
    }
    Points before, after;
    for (int k = 1; k <= back; ++k) before.push_back(point(i - k));
    for (int k = 1; k <= forth; ++k) after.push_back(point(i + k));
    fits.push_back(fit_curve_at(point(i), before, after));
  }
  return fits;
}

/// Coefficients of s^k from values at s = 0, 1/4, .., 1.
const Eigen::Matrix<double, 5, 5>& monomials_from_nodes() {
  static const Eigen::Matrix<double, 5, 5> M = [] {
    Eigen::Matrix<double, 5, 5> V;
    for (int r = 0; r < 5; ++r) {
      for (int c = 0; c < 5; ++c) V(r, c) = std::pow(0.25 * r, c);
    }
    return Eigen::Matrix<double, 5, 5>(V.inverse());
  }();
  return M;
}

}  // namespace

ChainCurve::ChainCurve(const FacetMesh& mesh, const Chain& chain) : is_closed_(chain.is_closed) {
  const std::vector<CurveFit> fits = fit_all(mesh, chain);
  const std::size_t n = chain.vertices.size();
  for (std::size_t i = 0; i < chain.edges.size(); ++i) {
    const std::size_t next = (i + 1) % n;
    const Vec3 &a = mesh.points[at(chain.vertices[i])], &b = mesh.points[at(chain.vertices[next])];
    std::array<Vec3, k_patch_order + 1> nodes;
    nodes.front() = a;
    nodes.back() = b;
    for (int k = 1; k < k_patch_order; ++k) {
      const double s = static_cast<double>(k) / k_patch_order;
      const Vec3 straight = (1.0 - s) * a + s * b;
      nodes[static_cast<std::size_t>(k)] =
          (1.0 - s) * fits[i].beside(straight) + s * fits[next].beside(straight);
    }
    std::array<Vec3, k_patch_order + 1> power;
    for (int r = 0; r <= k_patch_order; ++r) {
      power[static_cast<std::size_t>(r)] = Vec3::Zero();
      for (int c = 0; c <= k_patch_order; ++c) {
        power[static_cast<std::size_t>(r)] +=
            monomials_from_nodes()(r, c) * nodes[static_cast<std::size_t>(c)];
      }
    }
    nodes_.push_back(nodes);
    segments_.push_back(power);
  }
}

CurveJet ChainCurve::jet(double t) const {
  if (is_closed_) t = wrap_period(t, 0.0, last());
  const double segment = std::clamp(std::floor(t), 0.0, last() - 1.0), s = t - segment;
  const auto& c = segments_[static_cast<std::size_t>(segment)];
  CurveJet jet;
  jet.c = jet.ct = jet.ctt = Vec3::Zero();
  for (std::size_t k = c.size(); k-- > 0;) {
    jet.ctt = jet.ctt * s + 2.0 * jet.ct;
    jet.ct = jet.ct * s + jet.c;
    jet.c = jet.c * s + c[k];
  }
  return jet;
}

std::vector<double> ChainCurve::breaks() const {
  std::vector<double> t;
  for (std::size_t i = 0; i <= segments_.size(); ++i) t.push_back(static_cast<double>(i));
  return t;
}

}  // namespace camber::detail
