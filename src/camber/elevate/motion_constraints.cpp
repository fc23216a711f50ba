#include <camber/elevate/motion_constraints.hpp>

namespace camber {

MotionConstraints::MotionConstraints(const LinearMesh& mesh, const Topology& topology,
                                     const Association& association,
                                     const std::vector<Index>& still_faces)
    : edge_(topology.edge_count(), k_none), face_(topology.face_count(), k_none) {
  std::vector<Index> of_patch(association.patches.size(), k_none);
  for (Index f : still_faces) {
    const Index p = association.face2patch[at(f)];
    Index& own = of_patch[at(p)];
    if (own == k_none) {
      const Patch& patch = association.patches[at(p)];
      own = static_cast<Index>(constraints_.size());
      constraints_.push_back(
          {patch.kind == PatchKind::plane ? Kind::plane : Kind::fixed, patch.origin, patch.normal});
    }
    face_[at(f)] = own;
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const std::size_t corner = static_cast<std::size_t>(i);
      Index& edge = edge_[at(topology.face2edge[at(f)][corner])];
      const Vec3& x = mesh.vertices[at(topology.face2vertex[at(f)][corner])];
      if (edge != own) edge = edge == k_none ? own : meet(edge, own, x);
    }
  }
}

Index MotionConstraints::meet(Index first, Index second, const Vec3& x) {
  const Constraint &a = constraints_[at(first)], &b = constraints_[at(second)];
  Constraint both;
  if (a.kind == Kind::plane && b.kind == Kind::plane) {
    const Vec3 along = a.a.cross(b.a);
    if (along.norm() < 1e-6) return first;  // two halves of one plane
    both = {Kind::line, x, along.normalized()};
  }
  constraints_.push_back(both);
  return static_cast<Index>(constraints_.size()) - 1;
}

Vec3 MotionConstraints::move(Index constraint, const Vec3& u) const {
  if (constraint == k_none) return u;
  const Constraint& c = constraints_[at(constraint)];
  switch (c.kind) {
    case Kind::plane:
      return u - u.dot(c.a) * c.a;
    case Kind::line:
      return u.dot(c.a) * c.a;
    case Kind::fixed:
      break;
  }
  return Vec3::Zero();
}

Vec3 MotionConstraints::point(Index constraint, const Vec3& x) const {
  if (constraint == k_none) return x;
  const Constraint& c = constraints_[at(constraint)];
  switch (c.kind) {
    case Kind::plane:
      return x - (x - c.origin).dot(c.a) * c.a;
    case Kind::line:
      return c.origin + (x - c.origin).dot(c.a) * c.a;
    case Kind::fixed:
      break;
  }
  return x;
}

}  // namespace camber
