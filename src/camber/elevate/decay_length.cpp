#include <camber/base/parallel.hpp>
#include <camber/elevate/decay_length.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace camber {
namespace {

/// The decay must end before the middle between two facing walls.
constexpr double k_gap_share = 0.9;

/// What a cell on top of a column bears, in its height; the shortest decay for its sake: layers
/// keep 1 - 1.5 / k_least_reach of their thickness.
constexpr double k_cap_share = 0.3, k_least_reach = 2.5;
constexpr int k_halvings = 30;

/// Calls visit(vertex, slot) for every corner of every wall face.
template <class Visit>
void for_each_corner(const Topology& topology, const Wall& wall, const Visit& visit) {
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    const Index f = wall.faces[s];
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      visit(topology.face2vertex[at(f)][static_cast<std::size_t>(i)], s);
    }
  }
}

std::vector<double> mean_wall_edges(const LinearMesh& mesh, const Topology& topology,
                                    const Wall& wall) {
  std::vector<double> mean(mesh.vertices.size(), 0.0);
  std::vector<int> count(mesh.vertices.size(), 0);
  for (Index e : wall.edges) {
    const std::array<Index, 2>& v = topology.edge2vertex[at(e)];
    const double length = (mesh.vertices[at(v[0])] - mesh.vertices[at(v[1])]).norm();
    for (Index i : v) {
      mean[at(i)] += length;
      ++count[at(i)];
    }
  }
  for (std::size_t v = 0; v < mean.size(); ++v) {
    if (count[v] > 0) mean[v] /= count[v];
  }
  return mean;
}

/// Height over the face of the vertex farthest from it, over the cells on the face.
double cell_height(const LinearMesh& mesh, const Topology& topology, const Wall& wall,
                   std::size_t slot) {
  const Index f = wall.faces[slot];
  const Vec3& foot = mesh.vertices[at(topology.face2vertex[at(f)][0])];
  double height = 0.0;
  for (Index v : mesh.cell(topology.face2cell[at(f)][0])) {
    height = std::max(height, (foot - mesh.vertices[at(v)]).dot(wall.facet_normal[slot]));
  }
  return height;
}

std::vector<double> lengths_over_cells(const LinearMesh& mesh, const Topology& topology,
                                       const Wall& wall) {
  constexpr double k_unset = std::numeric_limits<double>::infinity();
  std::vector<double> length(mesh.vertices.size(), k_unset), height(wall.face_count());
  for (std::size_t s = 0; s < wall.face_count(); ++s)
    height[s] = cell_height(mesh, topology, wall, s);
  for_each_corner(topology, wall, [&](Index v, std::size_t s) {
    length[at(v)] = std::min(length[at(v)], height[s]);
  });
  std::replace(length.begin(), length.end(), k_unset, 0.0);
  return length;
}

/// Largest displacement of the wall faces around each wall vertex.
std::vector<double> largest_displacements(const LinearMesh& mesh, const Topology& topology,
                                          const Wall& wall, const Placement& placement) {
  const int q = placement.max_order();
  std::vector<double> displacement(wall.face_count(), 0.0), largest(mesh.vertices.size(), 0.0);
  for (std::size_t s = 0; s < wall.face_count() && q >= 2; ++s) {
    for (const Vec3& d : placement.face_displacement(static_cast<Index>(s), q)) {
      displacement[s] = std::max(displacement[s], d.norm());
    }
  }
  for_each_corner(topology, wall, [&](Index v, std::size_t s) {
    largest[at(v)] = std::max(largest[at(v)], displacement[s]);
  });
  return largest;
}

/// The lowest cell that stands on the top of each wall vertex's column: its height, and that of
/// the column.
struct Cap {
  double height = std::numeric_limits<double>::infinity(), column = 0.0;
};

std::vector<Cap> caps_of_columns(const LinearMesh& mesh, const Topology& topology,
                                 const Columns& columns) {
  std::vector<Cap> caps(mesh.vertices.size());
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    if (columns.cell_face_slot[at(c)] != k_none) continue;
    for (Index f : topology.faces_of_cell(c)) {
      const std::span<const Index> foot(topology.face2vertex[at(f)].data(),
                                        at(topology.corners_of_face(f)));
      const bool is_top = std::all_of(foot.begin(), foot.end(), [&](Index v) {
        return columns.base[at(v)] != k_none && columns.height[at(v)] > 0.0;
      });
      if (!is_top) continue;
      const auto x = [&](std::size_t i) -> const Vec3& { return mesh.vertices[at(foot[i])]; };
      const Vec3 n =
          (foot.size() == 3 ? (x(1) - x(0)).cross(x(2) - x(0)) : (x(2) - x(0)).cross(x(3) - x(1)))
              .normalized();
      double height = std::numeric_limits<double>::infinity();
      for (Index v : mesh.cell(c)) {
        if (columns.base[at(v)] != k_none) continue;
        height = std::min(height, std::abs((mesh.vertices[at(v)] - x(0)).dot(n)));
      }
      for (Index v : foot) {
        Cap& cap = caps[at(columns.base[at(v)])];
        if (height < cap.height) cap = {height, columns.height[at(v)]};
      }
    }
  }
  return caps;
}

/// @param largest  displacement of the wall around each wall vertex
void limit_lengths_under_caps(const LinearMesh& mesh, const Topology& topology,
                              const Columns& columns, const std::vector<double>& largest,
                              std::vector<double>& length) {
  const std::vector<Cap> caps = caps_of_columns(mesh, topology, columns);
  for (std::size_t v = 0; v < length.size(); ++v) {
    const double d = largest[v], allowed = k_cap_share * caps[v].height;
    const auto is_calm = [&](double l) { return d * decay(caps[v].column / l) <= allowed; };
    double low = k_least_reach * d, high = length[v];
    if (low >= high || is_calm(high)) continue;
    for (int i = 0; i < k_halvings && is_calm(low); ++i) {
      const double middle = 0.5 * (low + high);
      (is_calm(middle) ? low : high) = middle;
    }
    length[v] = low;
  }
}

}  // namespace

double decay(double s) {
  if (s >= 1.0) return 0.0;
  if (s <= 0.0) return 1.0;
  return (1.0 - s) * (1.0 - s) * (1.0 + 2.0 * s);
}

std::vector<double> decay_lengths(const LinearMesh& mesh, const Topology& topology,
                                  const Wall& wall, const Placement& placement,
                                  const Columns& columns, const LayerFieldOptions& options) {
  if (options.decay == Decay::cell) return lengths_over_cells(mesh, topology, wall);
  const std::vector<double> largest = largest_displacements(mesh, topology, wall, placement);
  std::vector<double> length = mean_wall_edges(mesh, topology, wall);
  for (std::size_t v = 0; v < length.size(); ++v) {
    length[v] = std::max(options.reach * length[v], options.reach_per_sagitta * largest[v]);
  }
  limit_lengths_under_caps(mesh, topology, columns, largest, length);
  return length;
}

void limit_lengths_in_gaps(const LinearMesh& mesh, const Wall& wall, const FaceTree& wall_tree,
                           std::vector<double>& length) {
  std::vector<Vec3> inward(mesh.vertices.size(), Vec3::Zero());
  for (const WallCorner& corner : wall.corners) inward[at(corner.vertex)] -= corner.normal;
  parallel_for(mesh.vertices.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (length[v] == 0.0 || inward[v].norm() == 0.0) continue;
      const Vec3 n = inward[v].normalized();
      const Vec3& x = mesh.vertices[v];
      double radius = length[v] / k_gap_share;
      for (int pass = 0; pass < 20; ++pass) {
        FaceHit hit;
        if (!wall_tree.nearest(x + radius * n, radius * (1.0 - 1e-6), hit)) break;
        const Vec3 chord = hit.point - x;
        if (wall.facet_normal[at(hit.item)].dot(n) < 0.3 || chord.dot(n) <= 0.0) break;
        const double smaller = chord.squaredNorm() / (2.0 * chord.dot(n));
        if (smaller >= radius * (1.0 - 1e-6)) break;
        radius = smaller;
      }
      length[v] = std::min(length[v], k_gap_share * radius);
    }
  });
}

}  // namespace camber
