#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/pipeline/detail/wall_patch.hpp>

#include <algorithm>
#include <utility>

namespace camber::detail {
WallPatch::WallPatch(const LinearMesh& mesh, const Topology& topology,
                     const Association& association, const GeometryModel& model, const Wall& wall,
                     const Placement& placement, std::vector<Index> faces, int order)
    : mesh_(mesh),
      topology_(topology),
      association_(association),
      model_(model),
      wall_(wall),
      projector_(model.projector()),
      faces_(std::move(faces)) {
  patch_.order = order;
  for (Index slot : faces_) add_face(slot, placement);
}

/// An edge may slide if it lies inside the patch and both of its faces are in the set.
bool WallPatch::may_slide(Index edge) const {
  const auto [a, b] = wall_.edge_faces[at(edge)];
  return a != k_none && b != k_none &&
         association_.edge2curve[at(wall_.edges[at(edge)])].dim != 1 &&
         std::binary_search(faces_.begin(), faces_.end(), a) &&
         std::binary_search(faces_.begin(), faces_.end(), b);
}

/// The face's frame goes round clockwise seen from outside.
bool WallPatch::walks_inwards(Index slot) const {
  const Vec3 &a = mesh_.vertices[at(vertex(slot, 0))], &b = mesh_.vertices[at(vertex(slot, 1))],
             &c = mesh_.vertices[at(vertex(slot, 2))];
  return (b - a).cross(c - a).dot(wall_.facet_normal[at(slot)]) < 0.0;
}

Projection WallPatch::foot(Index slot, const Vec3& x) {
  return project_to_group(*projector_, group(slot), x);
}

Index WallPatch::add_node(const Vec3& x, bool is_free, Index slot) {
  const Projection p = is_free ? foot(slot, x) : Projection{};
  patch_.nodes.push_back(x);
  patch_.is_free.push_back(p.status != ProjectionStatus::failed);
  patch_.uv.push_back(p.uv);
  surface_.push_back(p.entity.tag);
  return static_cast<Index>(patch_.nodes.size() - 1);
}

void WallPatch::add_face(Index slot, const Placement& placement) {
  const int q = patch_.order;
  const Index f = wall_.faces[at(slot)];
  const Shape shape = topology_.face_shape[at(f)];
  const LatticeMap& map = lattice_map(shape, q);
  SurfaceFace face;
  face.shape = shape;
  face.straight = straight_face_nodes(mesh_, topology_, f, q);
  face.nodes.assign(face.straight.size(), k_none);
  for (int i = 0; i < corner_total(slot); ++i) {
    const Vec3& out = wall_.corners[at(wall_.face_corners[at(slot)][at(i)])].normal;
    face.corner_normal[at(i)] = walks_inwards(slot) ? Vec3(-out) : out;
    const Index v = vertex(slot, i);
    if (!vertex_node_.contains(v)) vertex_node_[v] = add_node(mesh_.vertices[at(v)], false, slot);
    face.nodes[at(map.corner[at(i)])] = vertex_node_[v];
  }
  for (int i = 0; i < corner_total(slot); ++i) {
    const Index edge = wall_.edge_slot[at(topology_.face2edge[at(f)][at(i)])];
    if (!edge_node_.contains(edge)) {
      edge_node_[edge] = static_cast<Index>(patch_.nodes.size());
      for (const Vec3& x : placement.edge_nodes(edge, q)) add_node(x, may_slide(edge), slot);
    }
    const bool reversed = topology_.edge2vertex[at(wall_.edges[at(edge)])][0] != vertex(slot, i);
    const std::vector<int>& slots = map.edge_interior[at(i)];
    for (std::size_t k = 0; k < slots.size(); ++k) {
      face.nodes[at(slots[k])] =
          edge_node_[edge] + static_cast<Index>(reversed ? slots.size() - 1 - k : k);
    }
  }
  face_node_.push_back(static_cast<Index>(patch_.nodes.size()));
  const std::span<const Vec3> inner = placement.face_nodes(slot, q);
  for (std::size_t k = 0; k < inner.size(); ++k) {
    face.nodes[at(interior_nodes(shape, q)[k])] = add_node(inner[k], true, slot);
  }
  patch_.faces.push_back(std::move(face));
}

OnSurface WallPatch::on_surface() {
  return [this](Index node, const Vec2& uv) {
    const SurfacePoint s = projector_->evaluate_face(surface_[at(node)], uv);
    return SurfaceSample{s.point, s.du, s.dv};
  };
}

NearestPoints WallPatch::nearest_points() {
  last_.clear();
  return [this](std::span<const Index> faces, const Points& points, Points& feet) {
    const bool is_seeded = last_.size() == points.size();
    if (!is_seeded) last_.assign(points.size(), {});
    parallel_for_with(
        points.size(), 256, [&] { return model_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t i = begin; i < end; ++i) {
            const GeometryGroup& members = group(faces_[at(faces[i])]);
            Projection& last = last_[i];
            last = members.size() == 1 && last.status != ProjectionStatus::failed
                       ? projector->closest(last.entity, points[i], last.uv)
                       : project_to_group(*projector, members, points[i]);
            feet[i] = last.status == ProjectionStatus::failed ? points[i] : last.point;
          }
        });
  };
}

void WallPatch::store(Placement& placement) const {
  const int q = patch_.order;
  const auto first = [&](Index node) { return patch_.nodes.begin() + node; };
  for (const auto& [edge, node] : edge_node_) {
    if (may_slide(edge)) placement.set_edge(edge, q, Points(first(node), first(node) + q - 1));
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const auto inner = static_cast<std::ptrdiff_t>(interior_nodes(patch_.faces[i].shape, q).size());
    placement.set_face(faces_[i], q, Points(first(face_node_[i]), first(face_node_[i]) + inner));
  }
}

void WallPatch::store_sampled(Placement& placement, int order) {
  for (const auto& [edge, node] : edge_node_) {
    if (!may_slide(edge)) continue;
    const std::array<Index, 2>& v = topology_.edge2vertex[at(wall_.edges[at(edge)])];
    Points all{mesh_.vertices[at(v[0])]};
    all.insert(all.end(), patch_.nodes.begin() + node,
               patch_.nodes.begin() + node + patch_.order - 1);
    all.push_back(mesh_.vertices[at(v[1])]);
    Points nodes;
    for (int i = 1; i < order; ++i) {
      const Vec3 xi(static_cast<double>(i) / order, 0.0, 0.0);
      nodes.push_back(
          foot(wall_.edge_faces[at(edge)][0], evaluate(Shape::line, patch_.order, all, xi)).point);
    }
    placement.set_edge(edge, order, nodes);
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Shape shape = patch_.faces[i].shape;
    Points all, nodes;
    for (Index n : patch_.faces[i].nodes) all.push_back(patch_.nodes[at(n)]);
    for (int n : interior_nodes(shape, order)) {
      const Vec3 x = evaluate(shape, patch_.order, all, lattice_xi(shape, order)[at(n)]);
      nodes.push_back(foot(faces_[i], x).point);
    }
    placement.set_face(faces_[i], order, nodes);
  }
}

}  // namespace camber::detail
