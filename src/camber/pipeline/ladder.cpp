#include <camber/base/sorted_set.hpp>
#include <camber/pipeline/detail/lowered_together.hpp>
#include <camber/pipeline/ladder.hpp>
#include <camber/pipeline/volume_start.hpp>
#include <camber/pipeline/wall_repair.hpp>
#include <camber/smooth/elastic.hpp>

#include <algorithm>

namespace camber {
namespace {

/// Wall faces that the cells stand on: the foot of their column or their own faces on the wall; for
/// a cell without either, the wall faces at the feet of its vertices.
std::vector<Index> feet(const LinearMesh& mesh, const Topology& topology, const Wall& wall,
                        const Columns& columns, const std::vector<Index>& cells) {
  std::vector<Index> slots;
  std::vector<std::uint8_t> is_foot(mesh.vertices.size(), 0);
  bool has_loose = false;
  for (Index c : cells) {
    const std::size_t before = slots.size();
    if (columns.cell_face_slot[at(c)] != k_none) slots.push_back(columns.cell_face_slot[at(c)]);
    for (Index f : topology.faces_of_cell(c)) {
      if (wall.face_slot[at(f)] != k_none) slots.push_back(wall.face_slot[at(f)]);
    }
    if (slots.size() > before) continue;
    for (Index v : mesh.cell(c)) {
      if (columns.base[at(v)] == k_none) continue;
      is_foot[at(columns.base[at(v)])] = 1;
      has_loose = true;
    }
  }
  for (std::size_t s = 0; has_loose && s < wall.face_count(); ++s) {
    const Index f = wall.faces[s];
    int standing = 0;
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      standing += is_foot[at(topology.face2vertex[at(f)][static_cast<std::size_t>(i)])];
    }
    if (standing >= 2) slots.push_back(static_cast<Index>(s));
  }
  make_sorted_set(slots);
  return slots;
}

/// Splits off the cells that moving volume nodes cannot mend: those on a wall face whose first cell
/// is bad (the wall nodes themselves are misplaced), everything over such a face, and pinched
/// cells.
std::vector<Index> take_wall_faults(const Topology& topology, const Wall& wall,
                                    const Columns& columns, const std::vector<Index>& pinched,
                                    std::vector<Index>& bad) {
  std::vector<std::uint8_t> is_fault(wall.face_count(), 0);
  for (Index c : bad) {
    const Index slot = columns.cell_face_slot[at(c)];
    if (slot == k_none) continue;
    const std::array<Index, 2>& first = topology.face2cell[at(wall.faces[at(slot)])];
    if (first[0] == c || first[1] == c) is_fault[at(slot)] = 1;
  }
  std::vector<Index> faults, others;
  for (Index c : bad) {
    const Index slot = columns.cell_face_slot[at(c)];
    const bool is_pinched = std::binary_search(pinched.begin(), pinched.end(), c);
    (is_pinched || (slot != k_none && is_fault[at(slot)]) ? faults : others).push_back(c);
  }
  bad = std::move(others);
  return faults;
}

/// Cells that touch a vertex standing over one of the wall faces.
std::vector<Index> cells_over(const LinearMesh& mesh, const Topology& topology, const Wall& wall,
                              const Columns& columns, const std::vector<Index>& slots) {
  std::vector<std::uint8_t> is_foot(mesh.vertices.size(), 0);
  for (Index slot : slots) {
    const Index f = wall.faces[at(slot)];
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      is_foot[at(topology.face2vertex[at(f)][static_cast<std::size_t>(i)])] = 1;
    }
  }
  std::vector<Index> cells;
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    for (Index v : mesh.cell(c)) {
      const Index base = columns.base[at(v)];
      if (base == k_none || !is_foot[at(base)]) continue;
      cells.push_back(c);
      break;
    }
  }
  return cells;
}

/// Passes in which faces lose one order of shape; then all of it.
constexpr int k_gentle_passes = 8;
constexpr int k_passes = 40;
/// Rings of wall faces that are straightened around straight feet, in all.
constexpr int k_max_rings = 12;

/// Rings around bad cells whose nodes the elastic rung moves.
constexpr int k_relaxed_rings = 20;

enum class Keep { all_certified, fewer_uncertified };

/// One elastic solve around the bad cells, kept if it certifies all of them, or as asked. Columns
/// that are carried again beside relaxed ones shear thin cells: so before walls are lowered only a
/// complete success may stay.
/// @param still  then the uncertified cells
bool relax_around(CurvedMesh& curved, const std::vector<Index>& bad, Keep keep,
                  LadderResult& result, std::vector<Index>& still) {
  CurvedMesh relaxed = curved;
  const ElasticResult solve =
      relax_elastic_around(relaxed, bad, k_relaxed_rings, free_nodes(curved));
  add_solve(solve, result.elastic);
  still = uncertified_cells(relaxed, solve.cells);
  if (keep == Keep::all_certified ? !still.empty() : still.size() >= bad.size()) return false;
  curved = std::move(relaxed);
  ++result.elastic_patches;
  return true;
}

}  // namespace

LadderResult climb(CurvedMesh& curved, const Association& association, const GeometryModel& model,
                   Placement& placement, const Carry& carry, const Wall& wall,
                   const Columns& columns, const std::vector<Index>& pinched,
                   const std::vector<Index>& uncertified) {
  LadderResult result;
  result.pinched = pinched;
  const LinearMesh& mesh = curved.linear();
  const Topology& topology = curved.topology();
  std::vector<std::uint8_t> is_smoothed(wall.face_count(), 0);
  bool is_relaxed = false;
  UntangleOptions effort;
  std::vector<Index> bad = uncertified;
  int rings = 0;  // spent, of straight faces around straight feet
  for (int pass = 0; pass < k_passes && !bad.empty(); ++pass) {
    std::vector<Index> to_lower = take_wall_faults(topology, wall, columns, pinched, bad);
    if (to_lower.empty()) {
      const UntangleResult mended = untangle(curved, bad, effort);
      effort.evaluations -= std::min(effort.evaluations, mended.evaluations);
      result.mended.insert(result.mended.end(), mended.mended.begin(), mended.mended.end());
      result.load_steps += mended.load_steps;
      bad = mended.still_bad;
      to_lower = bad;
    }
    const std::vector<Index> slots = feet(mesh, topology, wall, columns, to_lower);
    std::vector<std::pair<Index, int>> caps;
    std::vector<Index> to_smooth;
    for (Index slot : slots) {
      if (!is_smoothed[at(slot)]) to_smooth.push_back(slot);
      is_smoothed[at(slot)] = 1;
    }
    std::vector<Index> changed =
        smooth_wall_faces(mesh, topology, association, model, wall, placement, to_smooth);
    result.wall_faces_smoothed += changed.size();
    const auto relax = [&](Keep keep) {
      std::vector<Index> all = bad, still;
      all.insert(all.end(), to_lower.begin(), to_lower.end());
      make_sorted_set(all);
      if (!relax_around(curved, all, keep, result, still)) return false;
      bad = std::move(still);
      return true;
    };
    if (changed.empty() && !is_relaxed) {
      is_relaxed = true;
      if (relax(Keep::all_certified)) continue;
    }
    for (Index slot : slots) {
      if (std::binary_search(changed.begin(), changed.end(), slot)) continue;
      const int cap = std::min(placement.face_cap(slot), curved.face_order(wall.faces[at(slot)]));
      caps.emplace_back(slot, pass < k_gentle_passes ? cap - 1 : 1);
    }
    const auto lower = [&] {
      caps = lowered_together(mesh, topology, association, wall, placement, caps);
      const std::vector<Index> lowered = placement.lower(caps);
      changed.insert(changed.end(), lowered.begin(), lowered.end());
    };
    lower();
    // All feet are straight already: what is around them bends the cells.
    for (std::vector<Index> ring = slots; changed.empty() && !ring.empty() && rings < k_max_rings;
         ++rings) {
      ring = with_wall_ring(mesh, topology, wall, ring);
      caps.clear();
      for (Index slot : ring) caps.emplace_back(slot, 1);
      lower();
    }
    make_sorted_set(changed);
    if (changed.empty()) {  // nothing left to lower: what the solve leaves is scaled back
      if (!relax(Keep::fewer_uncertified)) {
        bad.insert(bad.end(), to_lower.begin(), to_lower.end());
        make_sorted_set(bad);
      }
      break;
    }
    for (const auto& [slot, cap] : caps) result.lowered_faces.push_back(slot);
    std::vector<Index> again = carry(cells_over(mesh, topology, wall, columns, changed));
    again.insert(again.end(), bad.begin(), bad.end());
    again.insert(again.end(), to_lower.begin(), to_lower.end());
    // Cells that share no more than an edge have changed as well.
    bad = uncertified_cells(curved, with_neighbours(topology, again));
  }
  make_sorted_set(result.lowered_faces);
  std::erase_if(result.lowered_faces, [&](Index slot) {
    return placement.face_cap(slot) >= curved.face_order(wall.faces[at(slot)]);
  });
  result.scaled = scale_back(curved, bad);
  return result;
}

}  // namespace camber
