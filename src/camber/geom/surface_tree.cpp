#include <camber/geom/surface_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace camber {
namespace {

constexpr int k_surface_depth = 14;
// Patches shorter than this part of the surface are left as they are (fans around poles).
constexpr double k_short_patch = 2e-3;
constexpr std::size_t k_max_patches = 60000;
constexpr double k_flat_cosine = 0.97;  // 14 degrees between samples, 28 over a patch
// Fewest patches a direction: three samples of a whole wave would see nothing of it.
constexpr std::size_t k_min_cuts = 4;
// Derivatives shorter than this part of the patch's longest, and normals likewise, tell no
// direction (poles).
constexpr double k_no_length = 1e-6;

using Samples = std::array<std::array<SurfaceJet, 3>, 3>;

/// Smallest cosine of the angle between unit normals and tangents of neighbouring samples, along u
/// and v.
Vec2 turning(const Samples& j) {
  Vec2 cosine = Vec2::Ones();
  double longest_u = 0.0, longest_v = 0.0;
  for (const auto& row : j) {
    for (const auto& p : row) {
      longest_u = std::max(longest_u, p.su.norm());
      longest_v = std::max(longest_v, p.sv.norm());
    }
  }
  const auto angle = [](const Vec3& a, const Vec3& b, double tiny) {
    const double la = a.norm(), lb = b.norm();
    return la > tiny && lb > tiny ? a.dot(b) / (la * lb) : 1.0;
  };
  const double tiny = k_no_length * longest_u * longest_v;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 2; ++b) {
      const SurfaceJet &u0 = j[b][a], &u1 = j[b + 1][a], &v0 = j[a][b], &v1 = j[a][b + 1];
      cosine[0] = std::min({cosine[0], angle(u0.su.cross(u0.sv), u1.su.cross(u1.sv), tiny),
                            angle(u0.su, u1.su, k_no_length * longest_u)});
      cosine[1] = std::min({cosine[1], angle(v0.su.cross(v0.sv), v1.su.cross(v1.sv), tiny),
                            angle(v0.sv, v1.sv, k_no_length * longest_v)});
    }
  }
  return cosine;
}

/// Squared distance from x to the parallelogram's points centre + a du + b dv, |a|, |b| <= 1 (from
/// below: the clamped oblique coordinates are an upper bound, so the plane's distance and each
/// edge's slab are used).
double flat_distance(const Vec3& r, const Vec3& du, const Vec3& dv) {
  const double lu = du.norm(), lv = dv.norm();
  // Interval of the parallelogram along each of its two edge directions.
  const double mixed = std::abs(du.dot(dv));
  double outside = 0.0;
  if (lu > 0.0) outside = std::max(outside, std::abs(r.dot(du)) / lu - lu - mixed / lu);
  if (lv > 0.0) outside = std::max(outside, std::abs(r.dot(dv)) / lv - lv - mixed / lv);
  const Vec3 normal = du.cross(dv);
  const double area = normal.norm();
  const double height = area > 0.0 ? std::abs(r.dot(normal)) / area : 0.0;
  return std::sqrt(height * height + outside * outside);  // both are lower bounds, at right angles
}

}  // namespace

SurfaceTree::SurfaceTree(const ParametricSurface& surface, const UvBox& limits)
    : surface_(surface), limits_(limits) {
  const auto cuts = [&](int k) {
    std::vector<double> result{limits.lower[k]};
    const double shortest = 1e-9 * (limits.upper[k] - limits.lower[k]);
    for (const double t : surface.breaks(k))
      if (t > result.back() + shortest && t < limits.upper[k] - shortest) result.push_back(t);
    result.push_back(limits.upper[k]);
    const std::size_t parts = (k_min_cuts + result.size() - 2) / (result.size() - 1);
    std::vector<double> refined;
    for (std::size_t i = 0; i + 1 < result.size(); ++i)
      for (std::size_t m = 0; m < parts; ++m)
        refined.push_back(std::lerp(result[i], result[i + 1],
                                    static_cast<double>(m) / static_cast<double>(parts)));
    refined.push_back(limits.upper[k]);
    return refined;
  };
  const std::vector<double> u = cuts(0), v = cuts(1);
  Box rough;
  for (const double a : u)
    for (const double b : v) rough.add(surface.jet({a, b}).s);
  size_ = rough.diagonal();
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j) split({{u[i], v[j]}, {u[i + 1], v[j + 1]}}, 0);
  for (const Box& b : boxes_) box_.add(b);
  size_ = box_.diagonal();
  tree_ = BoxTree(boxes_);
}

void SurfaceTree::split(const UvBox& uv, int depth) {
  Samples j;
  const Vec2 half = 0.5 * (uv.upper - uv.lower), middle = 0.5 * (uv.lower + uv.upper);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      j[a][b] = surface_.jet(middle + Vec2((static_cast<double>(a) - 1.0) * half[0],
                                           (static_cast<double>(b) - 1.0) * half[1]));
  Box box;
  for (const auto& row : j)
    for (const SurfaceJet& sample : row) box.add(sample.s);
  const Vec2 cosine = turning(j);
  if (cosine.minCoeff() < k_flat_cosine && depth < k_surface_depth &&
      box.diagonal() > k_short_patch * size_ && patches_.size() < k_max_patches) {
    const int axis = cosine[0] < cosine[1] ? 0 : 1;
    UvBox left = uv, right = uv;
    left.upper[axis] = right.lower[axis] = middle[axis];
    split(left, depth + 1);
    split(right, depth + 1);
    return;
  }
  Patch patch{uv, j[1][1].s, 0.5 * (j[2][1].s - j[0][1].s), 0.5 * (j[1][2].s - j[1][0].s), 0.0};
  double bulge =
      0.0;  // second differences: 8 times the sagitta of a half interval, taken four times over
  for (std::size_t a = 0; a < 3; ++a) {
    bulge = std::max(bulge, (j[0][a].s - 2.0 * j[1][a].s + j[2][a].s).norm());
    bulge = std::max(bulge, (j[a][0].s - 2.0 * j[a][1].s + j[a][2].s).norm());
    for (std::size_t b = 0; b < 3; ++b) {
      const Vec3 flat = patch.centre + (static_cast<double>(a) - 1.0) * patch.du +
                        (static_cast<double>(b) - 1.0) * patch.dv;
      patch.deviation = std::max(patch.deviation, (j[a][b].s - flat).norm());
    }
  }
  patch.deviation += 0.5 * bulge;
  box.lower.array() -= 0.5 * bulge;
  box.upper.array() += 0.5 * bulge;
  patches_.push_back(patch);
  boxes_.push_back(box);
}

void SurfaceTree::feet(const Vec3& x, const std::function<double()>& bound,
                       const std::function<void(const SurfaceFoot&)>& take) const {
  tree_.nearest(x, bound, [&](int i) {
    const Patch& p = patches_[at(i)];
    const Vec3 r = x - p.centre;
    const double nearest = std::max(0.0, flat_distance(r, p.du, p.dv) - p.deviation);
    if (nearest * nearest >= bound()) return;
    // Start at the foot on the flat patch.
    const double E = p.du.squaredNorm(), F = p.du.dot(p.dv), G = p.dv.squaredNorm();
    const double ru = r.dot(p.du), rv = r.dot(p.dv), det = E * G - F * F;
    Vec2 ab =
        det > 1e-10 * E * G ? Vec2((G * ru - F * rv) / det, (E * rv - F * ru) / det) : Vec2::Zero();
    ab = ab.cwiseMax(-1.0).cwiseMin(1.0);
    const Vec2 start =
        0.5 * (p.uv.lower + p.uv.upper) + 0.5 * ab.cwiseProduct(p.uv.upper - p.uv.lower);
    take(find_foot(surface_, x, start, limits_, size_));
  });
}

void SurfaceTree::crossings(const Vec3& x, const Vec3& d, const std::function<double()>& bound,
                            const std::function<void(const SurfaceFoot&)>& take) const {
  tree_.along_line(x, d, bound, [&](int i) {
    const Patch& p = patches_[at(i)];
    // Across the line only: the flat patch seen along d.
    const auto across = [&](const Vec3& v) -> Vec3 { return v - v.dot(d) * d; };
    const Vec3 r = across(x - p.centre), du = across(p.du), dv = across(p.dv);
    const double E = du.squaredNorm(), F = du.dot(dv), G = dv.squaredNorm();
    const double ru = r.dot(du), rv = r.dot(dv), det = E * G - F * F;
    Vec2 ab =
        det > 1e-10 * E * G ? Vec2((G * ru - F * rv) / det, (E * rv - F * ru) / det) : Vec2::Zero();
    ab = ab.cwiseMax(-1.0).cwiseMin(1.0);
    const Vec2 start =
        0.5 * (p.uv.lower + p.uv.upper) + 0.5 * ab.cwiseProduct(p.uv.upper - p.uv.lower);
    take(find_line_foot(surface_, x, d, start, limits_, size_));
  });
}

}  // namespace camber
