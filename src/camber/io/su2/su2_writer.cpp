#include <camber/basis/node_order.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/su2/su2_types.hpp>
#include <camber/io/su2/su2_writer.hpp>

#include <algorithm>

namespace camber::io {
namespace {

void write_elements(OutputFile& out, const ElementBlock& block) {
  const std::span<const int> order =
      file_to_canonical(NodeConvention::su2, block.shape, block.order);
  const int code = su2::element_code(block.shape, block.order);
  for (std::size_t e = 0; e < block.nodes.size(); e += order.size()) {
    out.print("{}", code);
    for (const int n : order) out.print(" {}", block.nodes[e + static_cast<std::size_t>(n)]);
    out.append("\n");
  }
}

}  // namespace

NameRules su2_name_rules() { return {.forbidden = " \t%=(),", .keeps_volumes = false}; }

void write_su2(const NamedMesh& named, const std::string& path, const std::string& display) {
  const MeshData& mesh = named.mesh;
  check_mesh(mesh, display);
  OutputFile out(path, display);
  std::size_t cells = 0;
  for (const ElementBlock& b : mesh.blocks) cells += dimension(b.shape) == 3 ? b.size() : 0;
  out.print("NDIME= 3\nNELEM= {}\n", cells);
  for (const ElementBlock& b : mesh.blocks) {
    if (dimension(b.shape) == 3) write_elements(out, b);
  }
  out.print("NPOIN= {}\n", mesh.points.size());
  for (const Vec3& x : mesh.points) out.print("{} {} {}\n", x.x(), x.y(), x.z());
  const auto is_patch = [](const EntityRecord& e) { return e.key.dim == 2; };
  out.print("NMARK= {}\n", std::count_if(mesh.entities.begin(), mesh.entities.end(), is_patch));
  for (const EntityRecord& patch : mesh.entities) {
    if (!is_patch(patch)) continue;
    const auto belongs = [&](const ElementBlock& b) {
      return dimension(b.shape) == 2 && b.entity == patch.key.tag;
    };
    std::size_t faces = 0;
    for (const ElementBlock& b : mesh.blocks) faces += belongs(b) ? b.size() : 0;
    out.print("MARKER_TAG= {}\nMARKER_ELEMS= {}\n", patch.name, faces);
    for (const ElementBlock& b : mesh.blocks) {
      if (belongs(b)) write_elements(out, b);
    }
  }
  out.finish();
}

}  // namespace camber::io
