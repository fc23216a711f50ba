#pragma once
// What a run of curve() will hold in memory, from counts alone.
#include <camber/mesh/mesh_data.hpp>

#include <cstddef>
#include <string>

namespace camber {

struct MemoryQuestion {
  int max_order = 4, min_order = 1;
  bool uniform = false;  // every cell is written at max_order
};

/// Peak memory of reading, curving and writing a linear mesh [bytes]:
///   47 MB + 500 n_cells + 185 m (n_hex + n_prism / 2 + n_pyramid / 3 + n_tet / 6).
/// m is the number of nodes of one more hex in a large mesh, p^3 at order p; other shapes are
/// shares of a hex. How many cells will be curved and how far is known only afterwards: above order
/// 2, m is the geometric mean of 2^3 and p^3 for the highest order p, at least that of the lowest
/// order; p^3 if all cells are written at p.
/// Source: measured, docs/performance.md; seven meshes of 6000 to 100000 cells at orders 2 to 4
/// took between 0.85 and 1.1 of what is said, one of 20 million with a quarter of them curved far
/// less. A mesh with order 4 throughout may take three times as much as said. Large CAD files are
/// not counted. Never throws.
[[nodiscard]] std::size_t estimated_memory(const MeshData& mesh, const MemoryQuestion& question);

/// Memory that programs may take without swapping, "MemAvailable" of Linux [bytes]; 0 if the file
/// does not say. Limits of containers and of the process are not in it.
[[nodiscard]] std::size_t available_memory(const std::string& meminfo = "/proc/meminfo");

/// @param held  by this process already, as part of the estimate [bytes]
/// @param available  0: unknown, nothing is refused
/// @throws MeshError if the estimate is above what is available and held together
void require_memory(std::size_t estimate, std::size_t held, std::size_t available,
                    const std::string& mesh);

}  // namespace camber
