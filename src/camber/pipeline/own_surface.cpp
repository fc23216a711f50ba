#include <camber/pipeline/own_surface.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace camber {
namespace {

std::array<GlobalId, 4> face_key(const LinearMesh& mesh, std::span<const Index> corners) {
  std::array<GlobalId, 4> key{-1, -1, -1, -1};
  for (std::size_t i = 0; i < corners.size(); ++i) key[i] = mesh.vertex_tags[at(corners[i])];
  std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(corners.size()));
  return key;
}

std::array<GlobalId, 2> edge_key(const LinearMesh& mesh, Index a, Index b) {
  const auto [low, high] = std::minmax(mesh.vertex_tags[at(a)], mesh.vertex_tags[at(b)]);
  return {low, high};
}

/// Boundary faces as facets, and the mesh's vertices behind the facets' points.
struct BoundaryFacets {
  FacetMesh facets;
  std::vector<Index> vertex;
};

BoundaryFacets boundary_facets(const LinearMesh& mesh, const Topology& topology) {
  BoundaryFacets boundary;
  std::vector<Index> number(mesh.vertices.size(), k_none);
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (!topology.is_boundary(f)) continue;
    const Index cell = topology.face2cell[at(f)][0];
    const std::span<const Index> cell_faces = topology.faces_of_cell(cell);
    const std::size_t local = static_cast<std::size_t>(
        std::find(cell_faces.begin(), cell_faces.end(), f) - cell_faces.begin());
    const LocalFace& face = faces(mesh.cell_shape[at(cell)])[local];
    std::array<Index, 4>& facet = boundary.facets.facets.emplace_back();
    facet.fill(k_none);
    for (std::size_t i = 0; i < (face.shape == Shape::triangle ? 3U : 4U); ++i) {
      const Index v = mesh.cell(cell)[static_cast<std::size_t>(face.corners[i])];
      if (number[at(v)] == k_none) {
        number[at(v)] = static_cast<Index>(boundary.vertex.size());
        boundary.vertex.push_back(v);
        boundary.facets.points.push_back(mesh.vertices[at(v)]);
      }
      facet[i] = number[at(v)];
    }
  }
  return boundary;
}

void tell(const OwnSurface& own, const FeatureOptions& features, Report& report) {
  report.link.method = "mesh";
  report.link.reason =
      fmt::format("{} smooth regions, {} chains of edges sharper than {:g} degrees, {} corners",
                  own.model->count(2), own.model->count(1), features.angle, own.model->count(0));
  report.warnings.emplace_back(
      "there is no CAD: distances are those to a surface made from the mesh itself, and what the "
      "mesh does not resolve cannot come back");
  if (own.model->flat_corners() > 0) {
    report.warnings.push_back(
        fmt::format("at {} places the boundary has too few vertices between its sharp edges to be "
                    "curved; it stays flat there (a larger --feature-angle joins more faces)",
                    own.model->flat_corners()));
  }
}

}  // namespace

OwnSurface reconstruct_boundary(const LinearMesh& mesh, const Topology& topology,
                                const FeatureOptions& options) {
  const BoundaryFacets boundary = boundary_facets(mesh, topology);
  OwnSurface own;
  own.model = reconstruct(boundary.facets, options);
  const Features& features = own.model->features();
  const auto vertex = [&](Index point) { return boundary.vertex[at(point)]; };
  for (Index f = 0; at(f) < boundary.facets.facets.size(); ++f) {
    std::array<Index, 4> corners{};
    const std::span<const Index> points = boundary.facets.corners(f);
    std::transform(points.begin(), points.end(), corners.begin(), vertex);
    own.link.face[face_key(mesh, {corners.data(), points.size()})] = features.region[at(f)] + 1;
  }
  for (std::size_t c = 0; c < features.chains.size(); ++c) {
    for (Index e : features.chains[c].edges) {
      const std::array<Index, 2>& ends = features.edges[at(e)].vertex;
      own.link.curve[edge_key(mesh, vertex(ends[0]), vertex(ends[1]))] = static_cast<int>(c) + 1;
    }
  }
  return own;
}

GivenLink given_link(const SurfaceLink& link, const LinearMesh& mesh, const Topology& topology) {
  GivenLink given;
  given.face_group.resize(topology.face_count());
  given.edge_group.resize(topology.edge_count());
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (!topology.is_boundary(f)) continue;
    const std::span<const Index> corners(topology.face2vertex[at(f)].data(),
                                         static_cast<std::size_t>(topology.corners_of_face(f)));
    const auto found = link.face.find(face_key(mesh, corners));
    if (found != link.face.end()) given.face_group[at(f)] = {{2, found->second}};
  }
  for (std::size_t e = 0; e < topology.edge_count(); ++e) {
    const std::array<Index, 2>& ends = topology.edge2vertex[e];
    const auto found = link.curve.find(edge_key(mesh, ends[0], ends[1]));
    if (found != link.curve.end()) given.edge_group[e] = {{1, found->second}};
  }
  return given;
}

namespace {

/// The surface of the mesh, and the options that link to it.
OwnSurface own_surface(const MeshData& data, const FeatureOptions& features,
                       CurveOptions& options) {
  const LinearMesh mesh = build_linear_mesh(data);
  OwnSurface own = reconstruct_boundary(mesh, build_topology(mesh), features);
  options.link_by = LinkBy::own_surface;
  options.surface_link = std::make_shared<const SurfaceLink>(std::move(own.link));
  return own;
}

}  // namespace

CurveResult curve_without_cad(const MeshData& data, const FeatureOptions& features,
                              CurveOptions options, const Progress& progress) {
  const OwnSurface own = own_surface(data, features, options);
  CurveResult result = curve(data, *own.model, options, progress);
  tell(own, features, result.report);
  return result;
}

CurveResult curve_without_cad(MeshData&& data, const FeatureOptions& features, CurveOptions options,
                              const Progress& progress) {
  const OwnSurface own = own_surface(data, features, options);
  CurveResult result = curve(std::move(data), *own.model, options, progress);
  tell(own, features, result.report);
  return result;
}

}  // namespace camber
