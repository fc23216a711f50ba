#pragma once
// Curved meshes with arbitrary shapes of all their edges, faces and insides, for tests.
#include <camber/mesh/curved_mesh.hpp>

#include <random>

namespace camber::testing {

/// Moves every high-order node by up to `amplitude` a coordinate.
inline void shake(CurvedMesh& curved, double amplitude, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  const auto move = [&](std::span<Vec3> nodes) {
    for (Vec3& x : nodes) x += Vec3(uniform(random), uniform(random), uniform(random));
  };
  const Topology& topology = curved.topology();
  for (Index e = 0; at(e) < topology.edge_count(); ++e) move(curved.edge_nodes(e));
  for (Index f = 0; at(f) < topology.face_count(); ++f) move(curved.face_nodes(f));
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) move(curved.cell_nodes(c));
}

/// A random point of the reference shape.
inline Vec3 random_xi(Shape shape, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (;;) {
    const Vec3 xi(uniform(random), uniform(random), uniform(random));
    if (shape == Shape::hexahedron) return xi;
    if (shape == Shape::prism && xi.x() + xi.y() <= 1.0) return xi;
    if (shape == Shape::pyramid && std::max(xi.x(), xi.y()) + xi.z() <= 1.0) return xi;
    if (shape == Shape::tetrahedron && xi.sum() <= 1.0) return xi;
  }
}

}  // namespace camber::testing
