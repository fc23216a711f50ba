#include <camber/base/by_key.hpp>
#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/mesh/topology.hpp>
#include <camber/pipeline/detail/gaps.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace camber {
namespace {

/// One element's view of a face: local face of a cell, or a surface element as a whole.
struct View {
  std::size_t element = 0;
  int local = -1;  // -1: surface element
};

struct MatchedFace {
  Shape shape = Shape::triangle;
  View first, second, surface;
  std::size_t cells = 0;
  bool has_surface = false;
};

class FaceMatcher {
 public:
  FaceMatcher(const MeshData& data, const ElementList& cells, const ElementList& surfaces)
      : data_(data), cells_(cells), surfaces_(surfaces) {}

  FaceFindings run() {
    match_cells();
    match_surfaces();
    count();
    measure();
    return findings_;
  }

 private:
  void match_cells() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const std::span<const LocalFace> local = faces(cells_.shape(i));
      for (int f = 0; at(f) < local.size(); ++f) {
        const View view{i, f};
        const auto [place, is_new] = number_.try_emplace(key(view), matched_.size());
        if (is_new) {
          matched_.push_back({local[at(f)].shape, view, {}, {}, 1, false});
          continue;
        }
        MatchedFace& face = matched_[place->second];
        if (++face.cells == 2) face.second = view;
      }
    }
  }

  void match_surfaces() {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const View view{i, -1};
      const auto place = number_.find(key(view));
      if (place == number_.end()) {
        ++findings_.loose;
        continue;
      }
      MatchedFace& face = matched_[place->second];
      face.surface = view;
      face.has_surface = true;
    }
  }

  void count() {
    for (const MatchedFace& face : matched_) {
      if (face.cells == 1) {
        ++findings_.boundary_faces;
        findings_.bare += !face.has_surface;
        continue;
      }
      ++findings_.inner_faces;
      if (face.cells > 2 && findings_.crowded++ == 0) findings_.crowded_at = centre(face);
      findings_.max_order_jump =
          std::max(findings_.max_order_jump, std::abs(order(face.first) - order(face.second)));
    }
  }

  void measure() {
    make_tables();
    std::vector<double> gap(matched_.size(), 0.0);
    std::vector<std::uint8_t> is_twisted(matched_.size(), 0);
    parallel_for(matched_.size(), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const MatchedFace& face = matched_[i];
        for (const auto& [exists, other] :
             {std::pair(face.cells > 1, face.second), std::pair(face.has_surface, face.surface)}) {
          if (!exists) continue;
          const std::optional<double> distance = distance_between(face.shape, face.first, other);
          if (!distance) is_twisted[i] = 1;
          gap[i] = std::max(gap[i], distance.value_or(0.0));
        }
      }
    });
    findings_.twisted =
        static_cast<std::size_t>(std::count(is_twisted.begin(), is_twisted.end(), 1));
    const auto largest = std::max_element(gap.begin(), gap.end());
    if (largest == gap.end() || *largest == 0.0) return;
    findings_.max_gap = *largest;
    findings_.max_gap_at = centre(matched_[static_cast<std::size_t>(largest - gap.begin())]);
  }

  /// Values of the basis of order p at the points where a face of highest order q is compared.
  void make_tables() {
    int highest = 1;
    for (const ElementList* list : {&cells_, &surfaces_}) {
      for (std::size_t i = 0; i < list->size(); ++i) highest = std::max(highest, list->order(i));
    }
    for (Shape shape : {Shape::triangle, Shape::quadrilateral}) {
      for (int q = 2; q <= highest; ++q) {
        std::vector<Vec3> xi(lattice_xi(shape, q).begin(), lattice_xi(shape, q).end());
        const std::vector<Vec3>& gauss_points = sixth_order(shape).points;
        xi.insert(xi.end(), gauss_points.begin(), gauss_points.end());
        for (int p = 1; p <= q; ++p) tables_[{shape, p, q}] = tabulate(shape, p, xi).values;
      }
    }
  }

  [[nodiscard]] const ElementList& list(const View& view) const {
    return view.local < 0 ? surfaces_ : cells_;
  }
  [[nodiscard]] int order(const View& view) const { return list(view).order(view.element); }

  /// All face nodes as the view walks them (canonical order of the face's own shape).
  void face_nodes(const View& view, std::vector<Index>& nodes) const {
    const std::span<const Index> all = list(view).nodes(view.element);
    if (view.local < 0) {
      nodes.assign(all.begin(), all.end());
      return;
    }
    const std::vector<int>& slots =
        lattice_map(cells_.shape(view.element), order(view)).face[at(view.local)];
    nodes.resize(slots.size());
    for (std::size_t n = 0; n < slots.size(); ++n) nodes[n] = all[at(slots[n])];
  }

  [[nodiscard]] std::array<Index, 4> corner_nodes(const View& view) const {
    const std::span<const Index> all = list(view).nodes(view.element);
    const Shape shape = list(view).shape(view.element);
    const std::vector<int>& corner = lattice_map(shape, order(view)).corner;
    const LocalFace& face = faces(shape)[view.local < 0 ? 0 : at(view.local)];
    std::array<Index, 4> v{k_none, k_none, k_none, k_none};
    for (std::size_t i = 0; i < 4; ++i) {
      if (face.corners[i] >= 0) v[i] = all[at(corner[at(face.corners[i])])];
    }
    return v;
  }

  [[nodiscard]] CornerKey key(const View& view) const {
    const std::array<Index, 4> v = corner_nodes(view);
    if (v[3] != k_none) return corner_key(v);
    return corner_key(std::array<Index, 3>{v[0], v[1], v[2]});
  }

  [[nodiscard]] Vec3 centre(const MatchedFace& face) const {
    const std::array<Index, 4> v = corner_nodes(face.first);
    Vec3 sum = Vec3::Zero();
    int n = 0;
    for (Index i : v) {
      if (i == k_none) continue;
      sum += data_.points[at(i)];
      ++n;
    }
    return sum / n;
  }

  /// Largest distance between what `a` and `b` make of the face; empty if b walks its corners in an
  /// order that no rotation or reflection of a's gives.
  [[nodiscard]] std::optional<double> distance_between(Shape shape, const View& a,
                                                       const View& b) const {
    const std::array<Index, 4> corners_a = corner_nodes(a), corners_b = corner_nodes(b);
    const std::span<const std::array<int, 4>> views = face_views(shape);
    const std::size_t n = shape == Shape::triangle ? 3 : 4;
    std::size_t view = 0;
    const auto fits = [&] {
      for (std::size_t i = 0; i < n; ++i) {
        if (corners_a[i] != corners_b[at(views[view][i])]) return false;
      }
      return true;
    };
    while (view < views.size() && !fits()) ++view;
    if (view == views.size()) return std::nullopt;

    std::vector<Index> nodes_a, raw_b;
    face_nodes(a, nodes_a);
    face_nodes(b, raw_b);
    const std::span<const int> place = face_view_nodes(shape, static_cast<int>(view), order(b));
    std::vector<Index> nodes_b(raw_b.size());
    for (std::size_t k = 0; k < nodes_b.size(); ++k) nodes_b[k] = raw_b[at(place[k])];
    if (nodes_a == nodes_b) return 0.0;

    const int q = std::max(order(a), order(b));
    const MatX& table_a = tables_.at({shape, order(a), q});
    const MatX& table_b = tables_.at({shape, order(b), q});
    double farthest = 0.0;
    for (Eigen::Index row = 0; row < table_a.rows(); ++row) {
      Vec3 difference = Vec3::Zero();
      for (std::size_t k = 0; k < nodes_a.size(); ++k) {
        difference += table_a(row, static_cast<Eigen::Index>(k)) * data_.points[at(nodes_a[k])];
      }
      for (std::size_t k = 0; k < nodes_b.size(); ++k) {
        difference -= table_b(row, static_cast<Eigen::Index>(k)) * data_.points[at(nodes_b[k])];
      }
      farthest = std::max(farthest, difference.norm());
    }
    return farthest;
  }

  const MeshData& data_;
  const ElementList &cells_, &surfaces_;
  std::unordered_map<CornerKey, std::size_t, CornerKeyHash> number_;
  std::vector<MatchedFace> matched_;
  std::map<std::tuple<Shape, int, int>, MatX> tables_;
  FaceFindings findings_;
};

}  // namespace

FaceFindings examine_faces(const MeshData& data, const ElementList& cells,
                           const ElementList& surfaces) {
  return FaceMatcher(data, cells, surfaces).run();
}

}  // namespace camber
