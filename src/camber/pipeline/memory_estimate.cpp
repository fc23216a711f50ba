#include <camber/base/error.hpp>
#include <camber/pipeline/memory_estimate.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

namespace camber {
namespace {

/// The program, its libraries and a small CAD file.
constexpr double k_program = 47e6;
/// Linear mesh, topology, association and what is known of a cell (docs/performance.md).
constexpr double k_per_cell = 500.0;
/// A node in the mesh to be written, in the file and in the mesh read back.
constexpr double k_per_node = 185.0;
constexpr double k_gigabyte = 1e9;

/// Share of a hexahedron's nodes.
double share(Shape shape) {
  switch (shape) {
    case Shape::hexahedron:
      return 1.0;
    case Shape::prism:
      return 1.0 / 2.0;
    case Shape::pyramid:
      return 1.0 / 3.0;
    case Shape::tetrahedron:
      return 1.0 / 6.0;
    default:
      return 0.0;
  }
}

}  // namespace

std::size_t estimated_memory(const MeshData& mesh, const MemoryQuestion& question) {
  const double highest = std::pow(question.max_order, 3), lowest = std::pow(question.min_order, 3);
  constexpr double k_quadratic = 8.0;
  const bool is_known = highest <= k_quadratic || question.uniform;
  const double nodes = std::max(is_known ? highest : std::sqrt(k_quadratic * highest), lowest);
  double cells = 0.0, hexes = 0.0;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) != 3) continue;
    cells += static_cast<double>(block.size());
    hexes += share(block.shape) * static_cast<double>(block.size());
  }
  return static_cast<std::size_t>(k_program + k_per_cell * cells + k_per_node * nodes * hexes);
}

std::size_t available_memory(const std::string& meminfo) {
  std::ifstream in(meminfo);
  std::string key, unit;
  for (std::size_t kilobytes = 0; in >> key >> kilobytes; std::getline(in, unit)) {
    if (key == "MemAvailable:") return kilobytes * 1024;
  }
  return 0;
}

void require_memory(std::size_t estimate, std::size_t held, std::size_t available,
                    const std::string& mesh) {
  if (available == 0 || estimate <= held + available) return;
  throw MeshError(
      fmt::format("curving it takes about {:.1f} GB of memory and {:.1f} GB are available",
                  static_cast<double>(estimate) / k_gigabyte,
                  static_cast<double>(held + available) / k_gigabyte),
      mesh,
      "use a machine with more, a lower --order or a smaller mesh; --allow-memory goes on all the "
      "same");
}

}  // namespace camber
