// One mesh, linked in three ways: the curved results are the same.
#include <camber/associate/by_tags.hpp>
#include <camber/base/error.hpp>
#include <camber/pipeline/mesh_link.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "curve_cases.hpp"

namespace camber {
namespace {

using testing::bits_of;
using testing::case_geometry;
using testing::case_mesh;
using testing::expect_promises;
using testing::order;

/// Cells and nothing else.
MeshData stripped(MeshData data) {
  std::erase_if(data.blocks, [](const ElementBlock& block) { return dimension(block.shape) < 3; });
  data.point_entity.clear();
  data.entities.clear();
  return data;
}

double largest_difference(const CurveResult& a, const CurveResult& b) {
  const Points &x = bits_of(a).nodes, &y = bits_of(b).nodes;
  if (x.size() != y.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, (x[i] - y[i]).norm());
  return largest;
}

TEST(CurveWithoutTags, GivesTheCurvedMeshOfTheTags) {
  const CurveResult tagged = curve(case_mesh("wing"), *case_geometry("wing"), order(3));
  const CurveResult bare = curve(stripped(case_mesh("wing")), *case_geometry("wing"), order(3));

  EXPECT_EQ(tagged.report.link.method, "tags");
  EXPECT_EQ(bare.report.link.method, "shape");
  EXPECT_FALSE(bare.report.link.reason.empty());
  EXPECT_LE(largest_difference(tagged, bare), 1e-10 * tagged.linear->size());
}

TEST(CurveWithoutTags, KeepsItsPromisesAndFindsTheUnit) {
  for (const char* name : {"ball", "elbow"}) {
    MeshData data = stripped(case_mesh(name));
    for (Vec3& x : data.points) x *= 1e-3;
    const CurveResult result = curve(data, *case_geometry(name), order(3));
    EXPECT_DOUBLE_EQ(result.association.scale, 1e-3) << name;
    EXPECT_EQ(result.report.link.method, "shape") << name;
    EXPECT_TRUE(result.report.link.cad_without_mesh.empty()) << name;
    expect_promises(result);
  }
}

TEST(CurveWithMeshLink, GivesTheSameBitsAsTheAssociationThatWasWritten) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "camber_curve_link.xml").string();
  for (const char* name : {"ball", "wing", "elbow"}) {
    CurveOptions options = order(3);
    options.link_by = LinkBy::shape;
    const auto geometry = case_geometry(name);
    const CurveResult found = curve(case_mesh(name), *geometry, options);
    io::write_meshlink(mesh_link_of(*found.linear, *found.topology, found.association, *geometry,
                                    "linear.msh", "body.step"),
                       path);
    options.link_by = LinkBy::file;
    options.mesh_link = io::read_meshlink(path);
    const CurveResult read = curve(case_mesh(name), *case_geometry(name), options);

    EXPECT_EQ(read.report.link.method, "file") << name;
    EXPECT_EQ(bits_of(read), bits_of(found)) << name;
  }
  std::filesystem::remove(path);
}

TEST(CurveWithMeshLink, RefusesALinkForAnotherMeshOrAnotherCad) {
  const auto geometry = case_geometry("wing");
  const LinearMesh mesh = build_linear_mesh(case_mesh("wing"));
  const Topology topology = build_topology(mesh);
  const io::MeshLink link = mesh_link_of(
      mesh, topology, associate_by_tags(mesh, topology, *geometry), *geometry, "mesh", "cad");
  io::MeshLink elsewhere = link;
  for (io::MeshLink::Part& sheet : elsewhere.meshes[0].models[0].sheets) {
    for (io::MeshLink::Elements& list : sheet.elements) {
      for (GlobalId& n : list.numbers) n += 10000000;
    }
  }
  EXPECT_THROW(static_cast<void>(given_link(elsewhere, mesh, topology, *geometry)), GeometryError);
  io::MeshLink unknown = link;
  for (io::MeshLink::Reference& r : unknown.geometry[0].references) r.ref = "face_999";
  EXPECT_THROW(static_cast<void>(given_link(unknown, mesh, topology, *geometry)), GeometryError);
}

}  // namespace
}  // namespace camber
