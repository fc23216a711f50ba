#pragma once
// Curved elements for the tests: maps of the reference lattice, and random ones.
#include <camber/basis/lagrange.hpp>
#include <camber/basis/lattice.hpp>

#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

namespace camber::testing {

inline const std::vector<Shape>& volume_shapes() {
  static const std::vector<Shape> shapes{Shape::tetrahedron, Shape::pyramid, Shape::prism,
                                         Shape::hexahedron};
  return shapes;
}

/// The nodes x(xi) of the reference lattice.
inline Points mapped(Shape shape, int p, const std::function<Vec3(const Vec3&)>& x) {
  Points nodes;
  for (const Vec3& xi : lattice_xi(shape, p)) nodes.push_back(x(xi));
  return nodes;
}

inline Vec3 random_vector(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

/// The reference element with every node moved by up to `amplitude` in each direction.
inline Points random_element(Shape shape, int p, double amplitude, std::mt19937& generator) {
  return mapped(shape, p,
                [&](const Vec3& xi) { return Vec3(xi + amplitude * random_vector(generator)); });
}

inline Points transformed(Points nodes, const std::function<Vec3(const Vec3&)>& f) {
  for (Vec3& x : nodes) x = f(x);
  return nodes;
}

inline Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

}  // namespace camber::testing
