// How far placed wall faces and edges miss the CAD.
#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/elevate/placement.hpp>

#include <algorithm>

namespace camber {
Deviation measure_face(Projector& projector, const GeometryGroup& group, Shape shape, int q,
                       std::span<const Vec3> nodes, const WallCorner* seed) {
  const Quadrature& rule = sixth_order(shape);
  Deviation deviation;
  GeomEntity entity = seed ? seed->face : GeomEntity{};
  Vec2 uv = seed ? seed->uv : Vec2::Zero();
  for (std::size_t g = 0; g < rule.points.size(); ++g) {
    const Vec3 x = evaluate(shape, q, nodes, rule.points[g]);
    const Mat3 J = jacobian(shape, q, nodes, rule.points[g]);
    Projection foot;
    if (group.size() == 1 && entity == group.front()) {
      foot = projector.closest(entity, x, uv);
    } else {
      foot = project_to_group(projector, group, x);
    }
    if (foot.status != ProjectionStatus::failed) {
      entity = foot.entity;
      uv = foot.uv;
    }
    const double distance = foot.status == ProjectionStatus::failed ? 0.0 : foot.distance;
    const double area = rule.weights[g] * J.col(0).cross(J.col(1)).norm();
    deviation.maximum = std::max(deviation.maximum, distance);
    deviation.integral += distance * area;
    deviation.area += area;
  }
  return deviation;
}

void Placement::measure() {
  for (int q = 1; q <= max_order_; ++q) {
    face_deviation_[at(q)].resize(wall_.face_count());
    edge_deviation_[at(q)].assign(wall_.edge_count(), 0.0);
  }
  parallel_for_with(
      wall_.face_count(), 32, [&] { return model_.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t s = begin; s < end; ++s) measure_slot(*projector, static_cast<Index>(s));
      });
  parallel_for_with(
      wall_.edge_count(), 64, [&] { return model_.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t s = begin; s < end; ++s) measure_edge(*projector, static_cast<Index>(s));
      });
  largest_ = 0.0;
  for (const Points& moved :
       {edge_displacement_[at(max_order_)], face_displacement_[at(max_order_)]}) {
    for (const Vec3& d : moved) largest_ = std::max(largest_, d.norm());
  }
}

void Placement::measure_slot(Projector& projector, Index slot) {
  const Index f = wall_.faces[at(slot)];
  const Shape shape = topology_.face_shape[at(f)];
  const GeometryGroup& group = association_.patches[at(association_.face2patch[at(f)])].group;
  for (int q = 1; q <= max_order_; ++q) {
    Points nodes = straight_face_nodes(mesh_, topology_, f, q);
    if (q > 1) {
      const std::span<const Vec3> moved = face_displacement(slot, q);
      for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] += moved[i];
    }
    face_deviation_[at(q)][at(slot)] = measure_face(
        projector, group, shape, q, nodes, &wall_.corners[at(wall_.face_corners[at(slot)][0])]);
  }
}

void Placement::measure_edge(Projector& projector, Index slot) {
  const Index e = wall_.edges[at(slot)];
  const GeomEntity curve = association_.edge2curve[at(e)];
  if (curve.dim != 1) return;
  const Vec3 &a = mesh_.vertices[at(topology_.edge2vertex[at(e)][0])],
             &b = mesh_.vertices[at(topology_.edge2vertex[at(e)][1])];
  for (int q = 1; q <= max_order_; ++q) {
    std::array<Vec3, 8> nodes;
    for (int i = 0; i <= q; ++i) {
      const double s = static_cast<double>(i) / q;
      nodes[at(i)] = (1.0 - s) * a + s * b;
      if (q > 1) nodes[at(i)] += edge_displacement(slot, q)[at(i)];
    }
    double farthest = 0.0;
    for (const Vec3& xi : sixth_order(Shape::line).points) {
      const Vec3 x = evaluate(Shape::line, q, std::span(nodes.data(), at(q + 1)), xi);
      const Projection foot = projector.closest(curve, x);
      if (foot.status != ProjectionStatus::failed) farthest = std::max(farthest, foot.distance);
    }
    edge_deviation_[at(q)][at(slot)] = farthest;
  }
}

}  // namespace camber
