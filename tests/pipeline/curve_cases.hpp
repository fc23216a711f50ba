#pragma once
// The bundled cases, read once a program, and what every curved mesh of them must fulfil.
#include <camber/geom_occ/cad_file.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/pipeline/curve.hpp>

#include <map>
#include <string>

#include <gtest/gtest.h>

namespace camber::testing {

inline const MeshData& case_mesh(const std::string& name) {
  static std::map<std::string, MeshData> meshes;
  const auto found = meshes.find(name);
  if (found != meshes.end()) return found->second;
  return meshes[name] =
             io::read_mesh(std::string(CAMBER_SOURCE_DIR) + "/cases/" + name + "/linear.msh");
}

inline std::unique_ptr<GeometryModel> case_geometry(const std::string& name) {
  return read_cad(std::string(CAMBER_SOURCE_DIR) + "/cases/" + name + "/body.step");
}

inline CurveResult curve_case(const std::string& name, const CurveOptions& options) {
  const std::unique_ptr<GeometryModel> geometry = case_geometry(name);
  return curve(case_mesh(name), *geometry, options);
}

inline CurveOptions order(int highest) {
  CurveOptions options;
  options.orders.max_order = highest;
  return options;
}

/// What is promised of every result: certified, watertight to rounding, order jumps of one.
inline void expect_promises(const CurveResult& result) {
  const Report& report = result.report;
  EXPECT_EQ(report.validity.invalid, 0u);
  EXPECT_EQ(report.validity.undecided, 0u);
  EXPECT_EQ(report.validity.certified, result.linear->cell_count());
  EXPECT_GT(report.validity.min_scaled_jacobian, 0.0);
  EXPECT_LE(report.conformity.max_order_jump, 1);
  EXPECT_LE(report.conformity.max_gap, 1e-13 * report.conformity.model_size);
}

/// Every high-order node and every order, for comparing bits.
struct Bits {
  std::vector<std::uint8_t> orders;
  Points nodes;
  friend bool operator==(const Bits&, const Bits&) = default;
};

inline Bits bits_of(const CurveResult& result) {
  const CurvedMesh& curved = *result.curved;
  Bits bits{curved.orders().cell, {}};
  const auto add = [&](std::span<const Vec3> nodes) {
    bits.nodes.insert(bits.nodes.end(), nodes.begin(), nodes.end());
  };
  for (Index e = 0; at(e) < result.topology->edge_count(); ++e) add(curved.edge_nodes(e));
  for (Index f = 0; at(f) < result.topology->face_count(); ++f) add(curved.face_nodes(f));
  for (Index c = 0; at(c) < result.linear->cell_count(); ++c) add(curved.cell_nodes(c));
  return bits;
}

}  // namespace camber::testing
