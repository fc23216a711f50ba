#include <camber/base/error.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/io/detail/mesh_check.hpp>

#include <stdexcept>

#include <fmt/format.h>

namespace camber::io {
namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

}  // namespace

int nodes_per_element(Shape shape, int order) {
  return shape == Shape::point ? 1 : node_count(shape, order);
}

void check_mesh(const MeshData& mesh, const std::string& display) {
  const std::size_t n = mesh.points.size();
  require(mesh.point_tags.empty() || mesh.point_tags.size() == n, "one tag per point expected");
  require(mesh.point_entity.empty() || mesh.point_entity.size() == n,
          "one entity per point expected");
  require(mesh.point_parameters.empty() || mesh.point_parameters.size() == n,
          "one parameter pair per point expected");
  for (const ElementBlock& b : mesh.blocks) {
    const int highest = b.shape == Shape::point ? 1 : k_max_order;
    require(b.order >= 1 && b.order <= highest, "elements of order 1 to 4 expected");
    const auto per = static_cast<std::size_t>(nodes_per_element(b.shape, b.order));
    require(b.nodes.size() % per == 0, "whole elements expected");
    require(b.tags.empty() || b.tags.size() == b.size(), "one tag per element expected");
    for (const Index i : b.nodes) require(i >= 0 && at(i) < n, "element with a node out of range");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (mesh.points[i].allFinite()) continue;
    const GlobalId tag =
        mesh.point_tags.empty() ? static_cast<GlobalId>(i) + 1 : mesh.point_tags[i];
    throw FileError(fmt::format("node {} has a coordinate that is not finite", tag), display,
                    "this mesh cannot be written");
  }
}

}  // namespace camber::io
