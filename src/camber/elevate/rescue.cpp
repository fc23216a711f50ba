#include <camber/base/sorted_set.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <array>

namespace camber {
namespace {

/// Halvings before the displacement of an entity is dropped altogether.
constexpr int k_halvings = 5;

/// Displacement scales of all entities that were ever reduced.
class Reducer {
 public:
  explicit Reducer(CurvedMesh& curved)
      : curved_(curved),
        topology_(curved.topology()),
        straight_(curved.linear(), topology_, curved.orders()) {
    halvings_[0].assign(topology_.edge_count(), 0);
    halvings_[1].assign(topology_.face_count(), 0);
    halvings_[2].assign(curved.linear().cell_count(), 0);
  }

  /// Reduces all entities of the cells once; returns the cells that touch any that changed.
  std::vector<Index> reduce(const std::vector<Index>& cells) {
    std::vector<Index> edges, faces;
    for (Index c : cells) {
      for (Index e : topology_.edges_of_cell(c)) edges.push_back(e);
      for (Index f : topology_.faces_of_cell(c)) faces.push_back(f);
    }
    make_sorted_set(edges);
    make_sorted_set(faces);
    std::vector<Index> touched;
    for (Index e : edges) {
      if (!halve(halvings_[0][at(e)], curved_.edge_nodes(e), straight_.edge_nodes(e))) continue;
      for (Index c : topology_.cells_of_edge(e)) touched.push_back(c);
    }
    for (Index f : faces) {
      if (!halve(halvings_[1][at(f)], curved_.face_nodes(f), straight_.face_nodes(f))) continue;
      for (Index c : topology_.face2cell[at(f)]) {
        if (c != k_none) touched.push_back(c);
      }
    }
    for (Index c : cells) {
      if (halve(halvings_[2][at(c)], curved_.cell_nodes(c), straight_.cell_nodes(c)))
        touched.push_back(c);
    }
    make_sorted_set(touched);
    return touched;
  }

  [[nodiscard]] double kept(Index c) const {
    const int n = halvings_[2][at(c)];
    return n > k_halvings ? 0.0 : std::ldexp(1.0, -n);
  }

 private:
  /// False if the entity is straight already.
  static bool halve(std::uint8_t& count, std::span<Vec3> x, std::span<const Vec3> straight) {
    if (count > k_halvings) return false;
    ++count;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = count > k_halvings ? straight[i] : Vec3(straight[i] + 0.5 * (x[i] - straight[i]));
    }
    return true;
  }

  CurvedMesh& curved_;
  const Topology& topology_;
  CurvedMesh straight_;
  std::array<std::vector<std::uint8_t>, 3> halvings_;
};

}  // namespace

std::vector<Index> uncertified_cells(const CurvedMesh& curved,
                                     const std::vector<Index>& candidates) {
  std::vector<Index> tested;
  for (Index c : candidates) {
    if (curved.cell_order(c) > 1) tested.push_back(c);
  }
  const std::vector<Verdict> verdicts =
      quick_verdicts(tested.size(), [&](std::size_t i, Points& nodes) {
        const int p = curved.cell_order(tested[i]);
        curved.gather(tested[i], p, nodes);
        return ElementKind{curved.linear().cell_shape[at(tested[i])], p};
      });
  std::vector<Index> bad;
  for (std::size_t i = 0; i < tested.size(); ++i) {
    if (verdicts[i] != Verdict::valid) bad.push_back(tested[i]);
  }
  return bad;
}

RescueResult scale_back(CurvedMesh& curved, const std::vector<Index>& uncertified) {
  RescueResult result;
  if (uncertified.empty()) return result;
  Reducer reducer(curved);
  std::vector<Index> bad = uncertified, all = uncertified;
  // Ends: an entity is reduced only so often, and a pass that reduces nothing has no cell to test
  // again.
  while (!bad.empty()) {
    ++result.passes;
    bad = uncertified_cells(curved, reducer.reduce(bad));
    all.insert(all.end(), bad.begin(), bad.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  result.scaled_back = std::move(all);
  for (Index c : result.scaled_back) result.kept.push_back(reducer.kept(c));
  return result;
}

}  // namespace camber
