#include <camber/elevate/apply_field.hpp>

#include <array>

#include <camber/base/parallel.hpp>

namespace camber {
namespace {
constexpr std::size_t k_grain = 1024;
}

void apply_field(const LayerField& field, CurvedMesh& curved) {
  const Topology& topology = curved.topology();
  parallel_for(topology.edge_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, 8> u;
    for (std::size_t i = begin; i < end; ++i) {
      const Index e = static_cast<Index>(i);
      const std::span<Vec3> nodes = curved.edge_nodes(e);
      if (nodes.empty()) continue;
      field.edge(e, curved.edge_order(e), std::span(u.data(), nodes.size()));
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        nodes[k] = field.constrained_edge_point(e, nodes[k] + u[k]);
      }
    }
  });
  parallel_for(topology.face_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, 49> u;
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = static_cast<Index>(i);
      const std::span<Vec3> nodes = curved.face_nodes(f);
      if (nodes.empty()) continue;
      field.face(f, curved.face_order(f), std::span(u.data(), nodes.size()));
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        nodes[k] = field.constrained_face_point(f, nodes[k] + u[k]);
      }
    }
  });
  parallel_for(curved.linear().cell_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    Points u;
    for (std::size_t i = begin; i < end; ++i) {
      const Index c = static_cast<Index>(i);
      const std::span<Vec3> nodes = curved.cell_nodes(c);
      if (nodes.empty()) continue;
      u.resize(nodes.size());
      field.cell(c, curved.cell_order(c), u);
      for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] += u[k];
    }
  });
}

}  // namespace camber
