#include <camber/basis/lattice.hpp>
#include <camber/geom/primitive.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/stl/stl_reader.hpp>
#include <camber/pipeline/geometry_source.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace camber {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// The corners of all surface elements; points that none has are left out.
FacetMesh surface_of(const MeshData& mesh) {
  FacetMesh facets;
  std::vector<Index> number(mesh.points.size(), k_none);
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) != 2) continue;
    const std::span<const Vec3> reference = corners(block.shape);
    const std::size_t size = static_cast<std::size_t>(node_count(block.shape, block.order));
    std::vector<std::size_t> corner_place;
    for (const Vec3& xi : reference) {
      const LatticePoint point{static_cast<int>(xi.x()) * block.order,
                               static_cast<int>(xi.y()) * block.order, 0};
      corner_place.push_back(
          static_cast<std::size_t>(lattice_index(block.shape, block.order, point)));
    }
    for (std::size_t first = 0; first < block.nodes.size(); first += size) {
      std::array<Index, 4>& facet = facets.facets.emplace_back();
      facet.fill(k_none);
      for (std::size_t i = 0; i < corner_place.size(); ++i) {
        const Index node = block.nodes[first + corner_place[i]];
        if (number[at(node)] == k_none) {
          number[at(node)] = static_cast<Index>(facets.points.size());
          facets.points.push_back(mesh.points[at(node)]);
        }
        facet[i] = number[at(node)];
      }
    }
  }
  return facets;
}

}  // namespace

bool is_geometry_without_cad(const std::string& source) {
  const std::string extension = extension_of(source);
  return is_primitive(source) || extension == ".stl" || extension == ".msh";
}

std::unique_ptr<GeometryModel> make_geometry(const std::string& source,
                                             const FeatureOptions& features) {
  if (is_primitive(source)) return make_primitive(source);
  const bool is_stl = extension_of(source) == ".stl";
  return reconstruct(surface_of(is_stl ? io::read_stl(source) : io::read_mesh(source)), features);
}

void link_without_cad(CurveOptions& options) {
  if (options.link_by == LinkBy::automatic) options.link_by = LinkBy::shape;
  if (options.scale == 0.0) options.scale = 1.0;
}

}  // namespace camber
