#pragma once
// Small meshes with irregular coordinates for tests of readers and writers.
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

/// One curved element of every shape and order 1..4 (points and lines too), each with nodes of its
/// own on an entity of its own (tag = 10 * base + order, base counts the shapes), entities in
/// groups with names, classified nodes, parameters on curves and surfaces, node and element numbers
/// with gaps.
[[nodiscard]] MeshData zoo(double amplitude = 0.05);

/// The zoo with elements of one shape and order only.
[[nodiscard]] MeshData single(Shape shape, int order, double amplitude = 0.05);

/// Measure (length, area, volume) of every element over all blocks, by quadrature that is exact for
/// polynomial volumes; points have 0.
[[nodiscard]] std::vector<double> measures(const MeshData& mesh);

/// A path in a folder that the test may fill; the folder is new for every test.
[[nodiscard]] std::string scratch(const std::string& name);

[[nodiscard]] std::string slurp(const std::string& path);
void spill(const std::string& path, const std::string& bytes);

/// Fails the test unless both say the same about the same nodes and elements, bit by bit; the order
/// of the points may differ (they are matched by number).
void expect_same_mesh(const MeshData& a, const MeshData& b, bool with_classification);

}  // namespace camber::io
