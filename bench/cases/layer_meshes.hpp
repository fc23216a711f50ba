#pragma once
// Surface meshes on analytic surfaces and the layers of cells that stand on them.
#include <camber/associate/by_tags.hpp>
#include <camber/elevate/columns.hpp>
#include <camber/elevate/layer_field.hpp>
#include <camber/elevate/placement.hpp>
#include <camber/geom/bspline.hpp>
#include <camber/mesh/curved_mesh.hpp>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace camber::testing {

/// Triangles ([3] = -1) and quadrilaterals, counter-clockwise seen from outside.
struct SurfaceMesh {
  Points points;
  std::vector<std::array<Index, 4>> faces;
};

/// Icosahedron on the unit sphere, each triangle in four `refinements` times: 20, 80, 320, ...
/// Two of its vertices are the poles (0, 0, +-1).
SurfaceMesh icosphere(int refinements);
/// 6 n^2 quadrilaterals on the unit sphere, vertices at equal angles.
SurfaceMesh cubed_sphere(int n);
/// n_u x n_v quadrilaterals (or twice as many triangles) on a torus around z.
SurfaceMesh torus_grid(double major, double minor, int n_u, int n_v, bool is_triangles);
/// point(u, v) on the lattice of [0,1]^2; du x dv points out of the CAD. Quads, or triangles cut
/// along a diagonal. Periodic in u if asked: then u = 1 is u = 0.
SurfaceMesh grid(int n_u, int n_v, const std::function<Vec3(double, double)>& point,
                 bool is_triangles = false, bool is_periodic_in_u = false);
SurfaceMesh stretched(SurfaceMesh surface, const Vec3& factors);
/// Mean length of all edges (inner ones counted twice).
double mean_edge(const SurfaceMesh& surface);

enum class LayerFilling {
  stacked,  // prisms and hexahedra as they are
  tets,     // prisms cut in three
  capped    // stacked, and on every outer face a pyramid or tet, with tets between these
};

/// Adds one linear element; `corners` in the order of shape.hpp.
void append_element(MeshData& data, Shape shape, int entity, const std::vector<Index>& corners);

struct LayerOptions {
  LayerFilling filling = LayerFilling::stacked;
  int wall_entity = 1, outer_entity = 1000;
  /// Surface entity of a lateral face from the middle of its wall edge; needed for open surfaces.
  std::function<int(const Vec3&)> lateral_entity = [](const Vec3&) { return 1001; };
  /// Curve entity of a rim edge, 0 for none.
  std::function<int(const Vec3&)> rim_curve = [](const Vec3&) { return 0; };
  /// Height of a cap over its face, in mean edges of that face.
  double cap_height = 0.5;
};

/// Vertex `layer * points + i` is wall vertex i moved by heights[layer] along direction(point i).
/// heights[0] = 0. Layers may lie inside the surface (direction against its normal). The points of
/// caps come last, one a face, in direction(middle of the wall face).
MeshData layers_on(const SurfaceMesh& surface, const std::vector<double>& heights,
                   const std::function<Vec3(const Vec3&)>& direction,
                   const LayerOptions& options = {});

/// 0, first, ratio * first, ... while below a quarter of the total, then three layers up to it.
std::vector<double> growing_heights(double first, double ratio, double total);

/// Everything between a mesh and its placed wall.
struct Case {
  std::unique_ptr<GeometryModel> model;
  LinearMesh mesh;
  Topology topology;
  Association association;
  Wall wall;
  std::unique_ptr<Placement> placement;
  Columns columns;

  [[nodiscard]] LayerField field(const LayerFieldOptions& options = {}) const {
    return LayerField(mesh, topology, association, wall, *placement, columns, options);
  }
  [[nodiscard]] CurvedMesh straight(int order) const;
};
std::unique_ptr<Case> make_case(const MeshData& data, std::unique_ptr<GeometryModel> model,
                                int max_order = 4);

/// Every cell of the mesh that is of order 2 or more.
std::vector<Index> all_cells(const LinearMesh& mesh);
/// Cells at the given order, carried by the field.
CurvedMesh carried(const Case& c, const LayerField& field, int order);

/// A model of several faces made of one-face models: face i + 1 is parts[i]'s. No curves.
std::unique_ptr<GeometryModel> joined(std::vector<std::unique_ptr<GeometryModel>> parts);

/// Cubic B-spline z(x, y) over [0,1]^2 with the given height at its poles (flat border if these are
/// 0 there), lying in the plane of e1, e2 with z along e3 = e1 x e2, all through the origin.
BsplineSurface bump(const std::function<double(double, double)>& height, int poles,
                    const Vec3& e1 = Vec3::UnitX(), const Vec3& e2 = Vec3::UnitY());

}  // namespace camber::testing
