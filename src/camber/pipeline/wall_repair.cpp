#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/pipeline/wall_repair.hpp>
#include <camber/smooth/surface_patch.hpp>

#include <algorithm>
#include <map>
#include <memory>

namespace camber {
namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

class WallRepair {
 public:
  WallRepair(const LinearMesh& mesh, const Topology& topology, const Association& association,
             const GeometryModel& model, const Wall& wall, Placement& placement)
      : mesh_(mesh),
        topology_(topology),
        association_(association),
        wall_(wall),
        placement_(placement),
        projector_(model.projector()) {
    for (std::size_t s = 0; s < wall.face_count(); ++s) {
      for (int i = 0; i < corner_total(static_cast<Index>(s)); ++i) {
        vertex_faces_[vertex(static_cast<Index>(s), i)].push_back(static_cast<Index>(s));
      }
    }
  }

  std::vector<Index> run(const std::vector<Index>& slots) {
    std::vector<Index> changed;
    for (Index slot : slots) {
      if (std::find(changed.begin(), changed.end(), slot) != changed.end()) continue;
      const std::vector<Index> core = faces_around(slot);
      if (repair(core)) changed.insert(changed.end(), core.begin(), core.end());
    }
    make_sorted_set(changed);
    return changed;
  }

 private:
  [[nodiscard]] int corner_total(Index slot) const {
    return topology_.corners_of_face(wall_.faces[at(slot)]);
  }
  [[nodiscard]] Index vertex(Index slot, int i) const {
    return topology_.face2vertex[at(wall_.faces[at(slot)])][sz(i)];
  }
  [[nodiscard]] Index patch_of(Index slot) const {
    return association_.face2patch[at(wall_.faces[at(slot)])];
  }
  [[nodiscard]] Index edge_slot(Index slot, int i) const {
    return wall_.edge_slot[at(topology_.face2edge[at(wall_.faces[at(slot)])][sz(i)])];
  }

  /// The face's frame goes round clockwise seen from outside.
  [[nodiscard]] bool walks_inwards(Index slot) const {
    const Vec3 &a = mesh_.vertices[at(vertex(slot, 0))], &b = mesh_.vertices[at(vertex(slot, 1))],
               &c = mesh_.vertices[at(vertex(slot, 2))];
    return (b - a).cross(c - a).dot(wall_.facet_normal[at(slot)]) < 0.0;
  }

  /// The face and all faces of its patch that share a vertex with it.
  [[nodiscard]] std::vector<Index> faces_around(Index slot) const {
    std::vector<Index> core;
    for (int i = 0; i < corner_total(slot); ++i) {
      for (Index other : vertex_faces_.at(vertex(slot, i))) {
        if (patch_of(other) == patch_of(slot)) core.push_back(other);
      }
    }
    make_sorted_set(core);
    return core;
  }

  /// An edge may slide if it lies inside the patch and both of its faces are in the core.
  [[nodiscard]] bool may_slide(Index edge, const std::vector<Index>& core) const {
    const auto [a, b] = wall_.edge_faces[at(edge)];
    return a != k_none && b != k_none &&
           association_.edge2curve[at(wall_.edges[at(edge)])].dim != 1 &&
           std::binary_search(core.begin(), core.end(), a) &&
           std::binary_search(core.begin(), core.end(), b);
  }

  [[nodiscard]] Points lattice_of(Index slot, int q) const {
    return straight_face_nodes(mesh_, topology_, wall_.faces[at(slot)], q);
  }

  [[nodiscard]] Projection foot(Index slot, const Vec3& x) const {
    return project_to_group(*projector_, association_.patches[at(patch_of(slot))].group, x);
  }

  bool repair(const std::vector<Index>& core) {
    const int q = placement_.max_order();
    SurfacePatch patch;
    patch.order = q;
    std::vector<int> surface;                       // node -> CAD face it slides on
    std::map<Index, Index> vertex_node, edge_node;  // first node
    const auto add = [&](const Vec3& x, bool is_free, Index slot) {
      patch.nodes.push_back(x);
      const Projection p = is_free ? foot(slot, x) : Projection{};
      patch.is_free.push_back(p.status != ProjectionStatus::failed);
      patch.uv.push_back(p.uv);
      surface.push_back(p.entity.tag);
      return static_cast<Index>(patch.nodes.size() - 1);
    };
    std::vector<Index> face_node;  // first interior node by core face
    for (Index slot : core) {
      const Index f = wall_.faces[at(slot)];
      const Shape shape = topology_.face_shape[at(f)];
      const LatticeMap& map = lattice_map(shape, q);
      SurfaceFace face;
      face.shape = shape;
      face.straight = lattice_of(slot, q);
      face.nodes.assign(face.straight.size(), k_none);
      for (int i = 0; i < corner_total(slot); ++i) {
        const Vec3& out = wall_.corners[at(wall_.face_corners[at(slot)][sz(i)])].normal;
        face.corner_normal[sz(i)] = walks_inwards(slot) ? Vec3(-out) : out;
        const Index v = vertex(slot, i);
        if (!vertex_node.contains(v)) vertex_node[v] = add(mesh_.vertices[at(v)], false, slot);
        face.nodes[sz(map.corner[sz(i)])] = vertex_node[v];
      }
      for (int i = 0; i < corner_total(slot); ++i) {
        const Index edge = edge_slot(slot, i);
        if (!edge_node.contains(edge)) {
          edge_node[edge] = static_cast<Index>(patch.nodes.size());
          for (const Vec3& x : placement_.edge_nodes(edge, q)) add(x, may_slide(edge, core), slot);
        }
        const bool reversed =
            topology_.edge2vertex[at(wall_.edges[at(edge)])][0] != vertex(slot, i);
        const std::vector<int>& slots = map.edge_interior[sz(i)];
        for (std::size_t k = 0; k < slots.size(); ++k) {
          face.nodes[sz(slots[k])] =
              edge_node[edge] + static_cast<Index>(reversed ? slots.size() - 1 - k : k);
        }
      }
      face_node.push_back(static_cast<Index>(patch.nodes.size()));
      const std::span<const Vec3> inner = placement_.face_nodes(slot, q);
      for (std::size_t k = 0; k < inner.size(); ++k) {
        face.nodes[sz(interior_nodes(shape, q)[k])] = add(inner[k], true, slot);
      }
      patch.faces.push_back(std::move(face));
    }
    const bool is_repaired = smooth_surface(patch, [&](Index node, const Vec2& uv) {
      const SurfacePoint s = projector_->evaluate_face(surface[at(node)], uv);
      return SurfaceSample{s.point, s.du, s.dv};
    });
    if (!is_repaired) return false;
    store(core, patch, edge_node, face_node);
    return true;
  }

  /// Writes the highest order back and derives the lower ones from it.
  void store(const std::vector<Index>& core, const SurfacePatch& patch,
             const std::map<Index, Index>& edge_node, const std::vector<Index>& face_node) {
    const int top = placement_.max_order();
    for (int q = top; q >= 2; --q) {
      for (const auto& [edge, first] : edge_node) {
        if (!may_slide(edge, core)) continue;
        Points nodes(patch.nodes.begin() + first, patch.nodes.begin() + first + top - 1);
        if (q < top) nodes = sampled_edge(edge, nodes, q);
        placement_.set_edge(edge, q, nodes);
      }
      for (std::size_t i = 0; i < core.size(); ++i) {
        const Shape shape = patch.faces[i].shape;
        Points nodes;
        if (q == top) {
          const auto begin = patch.nodes.begin() + face_node[i];
          nodes.assign(begin, begin + static_cast<std::ptrdiff_t>(interior_nodes(shape, q).size()));
        } else {
          Points all;
          for (Index n : patch.faces[i].nodes) all.push_back(patch.nodes[at(n)]);
          for (int n : interior_nodes(shape, q)) {
            nodes.push_back(
                foot(core[i], evaluate(shape, top, all, lattice_xi(shape, q)[sz(n)])).point);
          }
        }
        placement_.set_face(core[i], q, nodes);
      }
    }
  }

  [[nodiscard]] Points sampled_edge(Index edge, const Points& top_nodes, int q) const {
    const std::array<Index, 2>& v = topology_.edge2vertex[at(wall_.edges[at(edge)])];
    Points all{mesh_.vertices[at(v[0])]};
    all.insert(all.end(), top_nodes.begin(), top_nodes.end());
    all.push_back(mesh_.vertices[at(v[1])]);
    Points nodes;
    for (int i = 1; i < q; ++i) {
      const Vec3 xi(static_cast<double>(i) / q, 0.0, 0.0);
      nodes.push_back(foot(wall_.edge_faces[at(edge)][0],
                           evaluate(Shape::line, placement_.max_order(), all, xi))
                          .point);
    }
    return nodes;
  }

  const LinearMesh& mesh_;
  const Topology& topology_;
  const Association& association_;
  const Wall& wall_;
  Placement& placement_;
  std::unique_ptr<Projector> projector_;
  std::map<Index, std::vector<Index>> vertex_faces_;
};

}  // namespace

std::vector<Index> smooth_wall_faces(const LinearMesh& mesh, const Topology& topology,
                                     const Association& association, const GeometryModel& model,
                                     const Wall& wall, Placement& placement,
                                     const std::vector<Index>& slots) {
  return WallRepair(mesh, topology, association, model, wall, placement).run(slots);
}

}  // namespace camber
