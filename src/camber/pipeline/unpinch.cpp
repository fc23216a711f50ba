#include <camber/elevate/pinched.hpp>
#include <camber/mesh/split_cells.hpp>
#include <camber/pipeline/unpinch.hpp>

#include <utility>

namespace camber {
namespace {

/// Rounds of edge removal: rings that share a cell are served one after the other.
constexpr int k_rounds = 4;

std::vector<std::uint8_t> wall_vertices(const LinearMesh& mesh, const Wall& wall) {
  std::vector<std::uint8_t> is_wall(mesh.vertices.size(), 0);
  for (const WallCorner& corner : wall.corners) is_wall[at(corner.vertex)] = 1;
  return is_wall;
}

}  // namespace

std::vector<Index> unpinch(CurveResult& result, Wall& wall, std::vector<Index> pinched,
                           const Relink& relink) {
  auto& counts = result.report.rescue;
  const auto replace = [&](LinearMesh mesh) {
    result.linear = std::make_unique<LinearMesh>(std::move(mesh));
    result.topology = std::make_unique<Topology>(build_topology(*result.linear));
    wall = relink(result);
    pinched = find_pinched_cells(*result.linear, *result.topology, result.association, wall);
  };
  for (int round = 0; round < k_rounds && !pinched.empty(); ++round) {
    const std::vector<Index> edges =
        edges_behind_pinched_tets(*result.linear, *result.topology, wall, pinched);
    auto [mesh, removed] =
        remove_edges(*result.linear, *result.topology, edges, wall_vertices(*result.linear, wall));
    if (removed == 0) break;
    counts.edges_removed += removed;
    replace(std::move(mesh));
  }
  if (!pinched.empty()) {
    std::vector<Index> split;
    LinearMesh mesh = split_from_centre(*result.linear, pinched, &split);
    counts.pinched_split += split.size();
    if (!split.empty()) replace(std::move(mesh));
  }
  return pinched;
}

}  // namespace camber
