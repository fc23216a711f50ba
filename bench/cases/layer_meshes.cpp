#include "layer_meshes.hpp"

#include <camber/elevate/apply_field.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace camber::testing {
namespace {

std::size_t corners_of(const std::array<Index, 4>& face) { return face[3] == k_none ? 3 : 4; }

SurfaceMesh refined_on_sphere(const SurfaceMesh& coarse) {
  SurfaceMesh fine{coarse.points, {}};
  std::map<std::array<Index, 2>, Index> middle;
  const auto between = [&](Index a, Index b) {
    const auto [place, is_new] = middle.try_emplace({std::min(a, b), std::max(a, b)},
                                                    static_cast<Index>(fine.points.size()));
    if (is_new) fine.points.push_back((fine.points[at(a)] + fine.points[at(b)]).normalized());
    return place->second;
  };
  for (const auto& [a, b, c, unused] : coarse.faces) {
    const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
    fine.faces.push_back({a, ab, ca, k_none});
    fine.faces.push_back({ab, b, bc, k_none});
    fine.faces.push_back({ca, bc, c, k_none});
    fine.faces.push_back({ab, bc, ca, k_none});
  }
  return fine;
}

double six_volumes(const Points& x, const std::vector<Index>& v) {
  const Vec3& o = x[at(v[0])];
  return (x[at(v[1])] - o).cross(x[at(v[2])] - o).dot(x[at(v[3])] - o);
}

void append_tet(MeshData& data, std::vector<Index> corners) {
  if (six_volumes(data.points, corners) < 0.0) std::swap(corners[1], corners[2]);
  append_element(data, Shape::tetrahedron, 1, corners);
}

/// A prism as three tets; each lateral face is cut from its lower wall vertex at the bottom to its
/// higher one at the top, so neighbours agree.
void append_split(MeshData& data, std::array<Index, 3> low, Index step) {
  std::sort(low.begin(), low.end());
  const auto& [a, b, c] = low;
  const std::array<std::vector<Index>, 3> tets{std::vector<Index>{a, b, c, c + step},
                                               std::vector<Index>{a, b, b + step, c + step},
                                               std::vector<Index>{a, a + step, b + step, c + step}};
  for (const std::vector<Index>& tet : tets) append_tet(data, tet);
}

/// Pyramids and tets on the faces of the outermost layer, a tet over every edge between two of
/// these, and the ragged boundary that is left.
void append_caps(MeshData& data, const std::vector<std::array<Index, 4>>& faces, const Points& wall,
                 const std::function<Vec3(const Vec3&)>& direction, const LayerOptions& options) {
  const Index low = static_cast<Index>(data.points.size() - wall.size());
  std::map<std::array<Index, 2>, std::vector<Index>> tips;  // by outer edge
  for (const std::array<Index, 4>& face : faces) {
    const std::size_t n = corners_of(face);
    Vec3 foot = Vec3::Zero(), middle = Vec3::Zero();
    double edge = 0.0;
    std::vector<Index> cell;
    for (std::size_t i = 0; i < n; ++i) {
      foot += wall[at(face[i])] / static_cast<double>(n);
      cell.push_back(face[i] + low);
      const Vec3 &x = data.points[at(face[i] + low)],
                 &next = data.points[at(face[(i + 1) % n] + low)];
      middle += x / static_cast<double>(n);
      edge += (next - x).norm() / static_cast<double>(n);
    }
    const Index tip = static_cast<Index>(data.points.size());
    data.points.emplace_back(middle + options.cap_height * edge * direction(foot).normalized());
    for (std::size_t i = 0; i < n; ++i) {
      const auto [a, b] = std::minmax(cell[i], cell[(i + 1) % n]);
      tips[{a, b}].push_back(tip);
    }
    cell.push_back(tip);
    append_element(data, n == 3 ? Shape::tetrahedron : Shape::pyramid, 1, cell);
  }
  for (const auto& [edge, over] : tips) {
    const auto [a, b] = edge;
    if (over.size() == 1) {
      append_element(data, Shape::triangle, options.outer_entity, {a, b, over[0]});
      continue;
    }
    append_tet(data, {a, b, over[0], over[1]});
    append_element(data, Shape::triangle, options.outer_entity, {a, over[0], over[1]});
    append_element(data, Shape::triangle, options.outer_entity, {b, over[0], over[1]});
  }
}

}  // namespace

void append_element(MeshData& data, Shape shape, int entity, const std::vector<Index>& corners) {
  ElementBlock* block = nullptr;
  for (ElementBlock& known : data.blocks) {
    if (known.shape == shape && known.entity == entity) block = &known;
  }
  if (!block) {
    data.blocks.push_back({shape, 1, entity, {}, {}});
    block = &data.blocks.back();
  }
  const std::vector<int>& place = lattice_map(shape, 1).corner;
  std::vector<Index> nodes(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    nodes[static_cast<std::size_t>(place[i])] = corners[i];
  }
  block->nodes.insert(block->nodes.end(), nodes.begin(), nodes.end());
}

SurfaceMesh icosphere(int refinements) {
  SurfaceMesh mesh;
  const double z = 1.0 / std::sqrt(5.0), r = 2.0 * z;
  mesh.points.emplace_back(0.0, 0.0, 1.0);
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < 5; ++i) {
      const double angle = (2.0 * i + ring) * std::numbers::pi / 5.0;
      mesh.points.emplace_back(r * std::cos(angle), r * std::sin(angle), ring == 0 ? z : -z);
    }
  }
  mesh.points.emplace_back(0.0, 0.0, -1.0);
  for (Index i = 0; i < 5; ++i) {
    const Index next = (i + 1) % 5;
    mesh.faces.push_back({0, 1 + i, 1 + next, k_none});
    mesh.faces.push_back({1 + i, 6 + i, 1 + next, k_none});
    mesh.faces.push_back({6 + i, 6 + next, 1 + next, k_none});
    mesh.faces.push_back({11, 6 + next, 6 + i, k_none});
  }
  for (Vec3& x : mesh.points) x.normalize();
  for (int k = 0; k < refinements; ++k) mesh = refined_on_sphere(mesh);
  return mesh;
}

SurfaceMesh cubed_sphere(int n) {
  SurfaceMesh mesh;
  std::map<std::array<int, 3>, Index> known;
  const auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto [place, is_new] = known.try_emplace(lattice, static_cast<Index>(mesh.points.size()));
    if (is_new) {
      Vec3 x;
      for (std::size_t d = 0; d < 3; ++d) {
        x[static_cast<Eigen::Index>(d)] =
            std::tan(0.25 * std::numbers::pi * (2.0 * lattice[d] / n - 1.0));
      }
      mesh.points.push_back(x.normalized());
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> lattice{};
            lattice[axis] = side;
            lattice[(axis + 1) % 3] = i + di;
            lattice[(axis + 2) % 3] = j + dj;
            return vertex(lattice);
          };
          std::array<Index, 4> face{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::swap(face[1], face[3]);
          mesh.faces.push_back(face);
        }
      }
    }
  }
  return mesh;
}

SurfaceMesh grid(int n_u, int n_v, const std::function<Vec3(double, double)>& point,
                 bool is_triangles, bool is_periodic_in_u) {
  SurfaceMesh mesh;
  const int columns = is_periodic_in_u ? n_u : n_u + 1;
  for (int j = 0; j <= n_v; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.points.push_back(point(static_cast<double>(i) / n_u, static_cast<double>(j) / n_v));
    }
  }
  for (int j = 0; j < n_v; ++j) {
    for (int i = 0; i < n_u; ++i) {
      const auto v = [&](int di, int dj) {
        return static_cast<Index>((j + dj) * columns + (i + di) % columns);
      };
      if (is_triangles) {
        mesh.faces.push_back({v(0, 0), v(1, 0), v(1, 1), k_none});
        mesh.faces.push_back({v(0, 0), v(1, 1), v(0, 1), k_none});
      } else {
        mesh.faces.push_back({v(0, 0), v(1, 0), v(1, 1), v(0, 1)});
      }
    }
  }
  return mesh;
}

SurfaceMesh torus_grid(double major, double minor, int n_u, int n_v, bool is_triangles) {
  const auto point = [&](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = 2.0 * std::numbers::pi * v;
    const double w = major + minor * std::cos(b);
    return Vec3(w * std::cos(a), w * std::sin(a), minor * std::sin(b));
  };
  SurfaceMesh mesh = grid(n_u, n_v, point, is_triangles, true);
  // The last row of the grid is the first.
  const Index row = n_u, last = n_u * n_v;
  for (std::array<Index, 4>& face : mesh.faces) {
    for (Index& v : face) v = v >= last ? v - last : v;
  }
  mesh.points.resize(mesh.points.size() - at(row));
  return mesh;
}

SurfaceMesh stretched(SurfaceMesh surface, const Vec3& factors) {
  for (Vec3& x : surface.points) x = x.cwiseProduct(factors);
  return surface;
}

double mean_edge(const SurfaceMesh& surface) {
  double sum = 0.0, count = 0.0;
  for (const std::array<Index, 4>& face : surface.faces) {
    const std::size_t n = corners_of(face);
    for (std::size_t i = 0; i < n; ++i) {
      sum += (surface.points[at(face[i])] - surface.points[at(face[(i + 1) % n])]).norm();
      count += 1.0;
    }
  }
  return sum / count;
}

std::vector<double> growing_heights(double first, double ratio, double total) {
  std::vector<double> heights{0.0};
  for (double height = first; height < 0.25 * total; height *= ratio) heights.push_back(height);
  for (double share : {0.35, 0.65, 1.0}) heights.push_back(share * total);
  return heights;
}

MeshData layers_on(const SurfaceMesh& surface, const std::vector<double>& heights,
                   const std::function<Vec3(const Vec3&)>& direction, const LayerOptions& options) {
  MeshData data;
  data.source = "layers";
  const Index step = static_cast<Index>(surface.points.size());
  for (double h : heights) {
    for (const Vec3& x : surface.points) data.points.push_back(x + h * direction(x));
  }
  const auto& first = surface.faces.front();
  const Vec3& a = surface.points[at(first[0])];
  const Vec3 normal = (surface.points[at(first[1])] - a).cross(surface.points[at(first[2])] - a);
  const bool is_inside = normal.dot(direction(a)) < 0.0;
  const Index top = static_cast<Index>(heights.size() - 1);
  std::map<std::array<Index, 2>, int> uses;
  std::vector<std::array<Index, 4>> standing;  // counter-clockwise seen from the layers
  for (std::array<Index, 4> face : surface.faces) {
    const std::size_t n = corners_of(face);
    if (is_inside) std::reverse(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(n));
    standing.push_back(face);
    for (std::size_t i = 0; i < n; ++i) {
      ++uses[{std::min(face[i], face[(i + 1) % n]), std::max(face[i], face[(i + 1) % n])}];
    }
    for (Index layer = 0; layer < top; ++layer) {
      const Index low = layer * step;
      if (options.filling == LayerFilling::tets) {
        append_split(data, {face[0] + low, face[1] + low, face[2] + low}, step);
        continue;
      }
      std::vector<Index> cell;
      for (Index up : {low, low + step}) {
        for (std::size_t i = 0; i < n; ++i) cell.push_back(face[i] + up);
      }
      append_element(data, n == 3 ? Shape::prism : Shape::hexahedron, 1, cell);
    }
    for (Index layer : {0, top}) {
      if (layer == top && options.filling == LayerFilling::capped) continue;
      std::vector<Index> v;
      for (std::size_t i = 0; i < n; ++i) v.push_back(face[i] + layer * step);
      append_element(data, n == 3 ? Shape::triangle : Shape::quadrilateral,
                     layer == 0 ? options.wall_entity : options.outer_entity, v);
    }
  }
  for (const auto& [edge, count] : uses) {
    if (count == 2) continue;
    const auto [v, w] = edge;
    const Vec3 middle = 0.5 * (surface.points[at(v)] + surface.points[at(w)]);
    const int curve = options.rim_curve(middle);
    if (curve > 0) append_element(data, Shape::line, curve, {v, w});
    for (Index layer = 0; layer < top; ++layer) {
      const Index low = layer * step, high = low + step;
      const int entity = options.lateral_entity(middle);
      if (options.filling == LayerFilling::tets) {
        append_element(data, Shape::triangle, entity, {v + low, w + low, w + high});
        append_element(data, Shape::triangle, entity, {v + low, w + high, v + high});
      } else {
        append_element(data, Shape::quadrilateral, entity, {v + low, w + low, w + high, v + high});
      }
    }
  }
  if (options.filling == LayerFilling::capped) {
    append_caps(data, standing, surface.points, direction, options);
  }
  return data;
}

CurvedMesh Case::straight(int order) const {
  return {mesh, topology,
          minimum_rule(topology, std::vector<std::uint8_t>(mesh.cell_count(),
                                                           static_cast<std::uint8_t>(order)))};
}

std::unique_ptr<Case> make_case(const MeshData& data, std::unique_ptr<GeometryModel> model,
                                int max_order) {
  auto c = std::make_unique<Case>();
  c->model = std::move(model);
  c->mesh = build_linear_mesh(data);
  c->topology = build_topology(c->mesh);
  c->association = associate_by_tags(c->mesh, c->topology, *c->model);
  c->wall = build_wall(c->mesh, c->topology, c->association, *c->model);
  c->placement = std::make_unique<Placement>(c->mesh, c->topology, c->association, *c->model,
                                             c->wall, max_order);
  c->columns = find_columns(c->mesh, c->topology, c->wall);
  return c;
}

std::vector<Index> all_cells(const LinearMesh& mesh) {
  std::vector<Index> cells(mesh.cell_count());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

CurvedMesh carried(const Case& c, const LayerField& field, int order) {
  CurvedMesh curved = c.straight(order);
  apply_field(field, curved);
  return curved;
}

BsplineSurface bump(const std::function<double(double, double)>& height, int poles, const Vec3& e1,
                    const Vec3& e2) {
  constexpr int degree = 3;
  const int spans = poles - degree;
  std::vector<double> knots;
  for (int i = -degree; i <= spans + degree; ++i) {
    knots.push_back(std::clamp(static_cast<double>(i) / spans, 0.0, 1.0));
  }
  // Poles over the Greville abscissae make x(u) = u exactly.
  std::vector<double> greville;
  for (int i = 0; i < poles; ++i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += knots[static_cast<std::size_t>(i + k)];
    greville.push_back(sum / degree);
  }
  Points net;
  for (double x : greville) {
    for (double y : greville) {
      net.push_back(x * e1 + y * e2 + height(x, y) * e1.cross(e2));
    }
  }
  return {BsplineBasis(degree, knots), BsplineBasis(degree, knots), net};
}

}  // namespace camber::testing
