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
///   47 MB + 750 n_cells + 200 q^3 (n_hex + n_prism / 2 + n_pyramid / 3 + n_tet / 6).
/// q^3 nodes are those of one more cell in a large hex mesh of order q; the other shapes are shares
/// of a hex. How many cells will be curved and how far is known only afterwards: q is the mean of 2
/// and the highest order, at least the lowest; the highest if all are written at it.
/// Source: measured, runs of the bundled cases and of bench/generate with 17000 to 102000 cells at
/// orders 2 and 4. Between 0.9 and 2.8 of the peak in these; a mesh of order 4 throughout may take
/// twice as much as said. Large CAD files are not counted. Never throws.
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
