#include <camber/base/error.hpp>
#include <camber/pipeline/cad_scale.hpp>

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

namespace camber {
namespace {

/// Mesh lengths per CAD length (OpenCASCADE gives millimetres): mm, m, micrometre, inch, ..., foot.
constexpr std::array<double, 7> k_usual_scales{1.0, 1e-3, 1e3, 1.0 / 25.4, 25.4, 1e-2, 1.0 / 304.8};
/// Boxes of faceted and true surfaces differ; a wrong unit differs by 2.5 times at least.
constexpr double k_box_mismatch = 0.25;

std::string text(const Box& box) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", box.lower.x(),
                     box.lower.y(), box.lower.z(), box.upper.x(), box.upper.y(), box.upper.z());
}

}  // namespace

double fit_cad_scale(const MeshData& data, GeometryModel& geometry, double scale) {
  Box mesh_box, cad_box;
  std::set<int> tags;
  for (const ElementBlock& block : data.blocks) {
    if (dimension(block.shape) != 2 || block.entity < 1 || block.entity > geometry.count(2)) {
      continue;
    }
    if (tags.insert(block.entity).second) cad_box.add(geometry.box(GeomEntity{2, block.entity}));
    for (Index node : block.nodes) mesh_box.add(data.points[at(node)]);
  }
  if (mesh_box.is_empty()) {
    throw GeometryError(
        fmt::format("no surface of the mesh refers to the CAD, which has faces 1..{}",
                    geometry.count(2)),
        data.source,
        "surface tags must be those of the CAD, as Gmsh gives them with Mesh.SaveAll=1");
  }
  if (scale > 0.0) {
    geometry.set_scale(scale);
    return scale;
  }
  const auto mismatch = [&](double factor) {
    const double size = std::max(mesh_box.diagonal(), factor * cad_box.diagonal());
    return std::max((mesh_box.lower - factor * cad_box.lower).norm(),
                    (mesh_box.upper - factor * cad_box.upper).norm()) /
           size;
  };
  const double best =
      *std::min_element(k_usual_scales.begin(), k_usual_scales.end(),
                        [&](double a, double b) { return mismatch(a) < mismatch(b); });
  if (mismatch(best) > k_box_mismatch) {
    throw GeometryError(fmt::format("the mesh's surfaces span {}, their CAD faces {}, and no usual "
                                    "unit makes them equal",
                                    text(mesh_box), text(cad_box)),
                        data.source, "give the CAD that this mesh was made from, or --unit");
  }
  geometry.set_scale(geometry.scale() * best);
  return geometry.scale();
}

}  // namespace camber
