// CGNS files as other programs make them, written here with the library itself: structured zones,
// zones that are joined, the older file format, families with geometry, and what is refused.
#include <camber/base/error.hpp>
#include <camber/io/cgns/cgns_families.hpp>
#include <camber/io/mesh_file.hpp>

#include <cgnslib.h>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Sizes = std::array<cgsize_t, 3>;

#define EXPECT_CGNS(call) EXPECT_EQ(call, CG_OK) << cg_get_error()

/// A file being written, with one base.
class Written {
 public:
  explicit Written(const std::string& path, int type = CG_FILE_HDF5) {
    EXPECT_CGNS(cg_set_file_type(type));
    EXPECT_CGNS(cg_open(path.c_str(), CG_MODE_WRITE, &file));
    EXPECT_CGNS(cg_base_write(file, "Base", 3, 3, &base));
  }
  ~Written() { EXPECT_CGNS(cg_close(file)); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;

  /// Nodes at map(i, j, k), i fastest, counted from 0.
  template <class Map>
  int structured_zone(const char* name, const Sizes& n, const Map& map) const {
    const std::array<cgsize_t, 9> size{n[0], n[1], n[2], n[0] - 1, n[1] - 1, n[2] - 1, 0, 0, 0};
    int zone = 0;
    EXPECT_CGNS(cg_zone_write(file, base, name, size.data(), CGNS_ENUMV(Structured), &zone));
    Points points;
    for (cgsize_t k = 0; k < n[2]; ++k) {
      for (cgsize_t j = 0; j < n[1]; ++j) {
        for (cgsize_t i = 0; i < n[0]; ++i) points.push_back(map(i, j, k));
      }
    }
    write_points(zone, points);
    return zone;
  }

  /// One cube of edge 1 at x.
  int cube_zone(const char* name, double x) const {
    const std::array<cgsize_t, 3> size{8, 1, 0};
    int zone = 0, section = 0;
    EXPECT_CGNS(cg_zone_write(file, base, name, size.data(), CGNS_ENUMV(Unstructured), &zone));
    write_points(zone, {{x, 0, 0},
                        {x + 1, 0, 0},
                        {x + 1, 1, 0},
                        {x, 1, 0},
                        {x, 0, 1},
                        {x + 1, 0, 1},
                        {x + 1, 1, 1},
                        {x, 1, 1}});
    std::array<cgsize_t, 8> nodes{};
    std::iota(nodes.begin(), nodes.end(), 1);
    EXPECT_CGNS(cg_section_write(file, base, zone, "cells", CGNS_ENUMV(HEXA_8), 1, 1, 0,
                                 nodes.data(), &section));
    return zone;
  }

  /// The face x = const of cube_zone() as element 2, with a condition of that family.
  void wall(int zone, const char* condition, const char* family) const {
    const std::array<cgsize_t, 4> quad{1, 5, 8, 4};
    const std::array<cgsize_t, 2> range{2, 2};
    int section = 0, number = 0;
    EXPECT_CGNS(cg_section_write(file, base, zone, "faces", CGNS_ENUMV(QUAD_4), 2, 2, 0,
                                 quad.data(), &section));
    EXPECT_CGNS(cg_boco_write(file, base, zone, condition, CGNS_ENUMV(FamilySpecified),
                              CGNS_ENUMV(PointRange), 2, range.data(), &number));
    EXPECT_CGNS(cg_boco_gridlocation_write(file, base, zone, number, CGNS_ENUMV(FaceCenter)));
    EXPECT_CGNS(cg_goto(file, base, "Zone_t", zone, "ZoneBC_t", 1, "BC_t", number, "end"));
    EXPECT_CGNS(cg_famname_write(family));
  }

  void condition(int zone, const char* name, const std::array<cgsize_t, 6>& range,
                 CGNS_ENUMT(GridLocation_t) location) const {
    int number = 0;
    EXPECT_CGNS(cg_boco_write(file, base, zone, name, CGNS_ENUMV(BCWall), CGNS_ENUMV(PointRange), 2,
                              range.data(), &number));
    EXPECT_CGNS(cg_boco_gridlocation_write(file, base, zone, number, location));
  }

  int file = 0, base = 0;

 private:
  void write_points(int zone, const Points& points) const {
    constexpr std::array<const char*, 3> k_names{"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (int d = 0; d < 3; ++d) {
      std::vector<double> x;
      for (const Vec3& point : points) x.push_back(point[d]);
      int number = 0;
      EXPECT_CGNS(cg_coord_write(file, base, zone, CGNS_ENUMV(RealDouble),
                                 k_names[static_cast<std::size_t>(d)], x.data(), &number));
    }
  }
};

/// Elements of that dimension by the name of their entity.
std::map<std::string, std::size_t> counts(const MeshData& mesh, int dim) {
  std::map<std::string, std::size_t> all;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) != dim) continue;
    for (const EntityRecord& entity : mesh.entities) {
      if (entity.key == EntityKey{dim, block.entity}) all[entity.name] += block.size();
    }
  }
  return all;
}

double volume(MeshData mesh) {
  std::erase_if(mesh.blocks, [](const ElementBlock& b) { return dimension(b.shape) != 3; });
  const std::vector<double> all = measures(mesh);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

using Counts = std::map<std::string, std::size_t>;

TEST(CgnsZones, ABentStructuredBlockIsHexesWithPatchesByRanges) {
  const std::string path = scratch("bent.cgns");
  constexpr double k_step = std::numbers::pi / 8.0;
  {
    const Written out(path);
    // 2 cells along the radius from 1 to 3, 4 around a quarter circle, 3 along the axis, to 3.
    const int zone = out.structured_zone("bend", {3, 5, 4}, [](auto i, auto j, auto k) {
      const double radius = 1.0 + static_cast<double>(i), angle = k_step * static_cast<double>(j);
      return Vec3(radius * std::cos(angle), radius * std::sin(angle), static_cast<double>(k));
    });
    out.condition(zone, "inner", {1, 1, 1, 1, 5, 4}, CGNS_ENUMV(Vertex));
    out.condition(zone, "half_of_outer", {3, 1, 1, 3, 2, 3}, CGNS_ENUMV(IFaceCenter));
    out.condition(zone, "end", {1, 5, 1, 3, 5, 4}, CGNS_ENUMV(Vertex));
  }

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(mesh.points.size(), 60U);
  EXPECT_EQ(counts(mesh, 3), (Counts{{"bend", 24}}));
  EXPECT_EQ(counts(mesh, 2), (Counts{{"inner", 12}, {"half_of_outer", 6}, {"end", 6}}));
  // Four straight-sided sectors: 4 * sin(step) (3^2 - 1^2) / 2 * 3.
  EXPECT_NEAR(volume(mesh), 4.0 * std::sin(k_step) * 8.0 / 2.0 * 3.0, 1e-12);
}

TEST(CgnsZones, StructuredZonesWithTurnedAxesAreJoined) {
  const std::string path = scratch("turned.cgns");
  {
    const Written out(path);
    const auto half = [](auto i) { return 0.5 * static_cast<double>(i); };
    const int a = out.structured_zone(
        "a", {3, 3, 3}, [&](auto i, auto j, auto k) { return Vec3(half(i), half(j), half(k)); });
    // Its i runs along y, j along z, k along x.
    const int b = out.structured_zone("b", {3, 3, 4}, [&](auto i, auto j, auto k) {
      return Vec3(1.0 + half(k), half(i), half(j));
    });
    const std::array<cgsize_t, 6> of_a{3, 1, 1, 3, 3, 3}, of_b{1, 1, 1, 3, 3, 1};
    const std::array<int, 3> a2b{3, 1, 2}, b2a{2, 3, 1};
    int number = 0;
    EXPECT_CGNS(cg_1to1_write(out.file, out.base, a, "a2b", "b", of_a.data(), of_b.data(),
                              a2b.data(), &number));
    EXPECT_CGNS(cg_1to1_write(out.file, out.base, b, "b2a", "a", of_b.data(), of_a.data(),
                              b2a.data(), &number));
  }

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(mesh.points.size(), 27U + 36U - 9U);
  EXPECT_EQ(counts(mesh, 3), (Counts{{"a", 8}, {"b", 12}}));
  EXPECT_NEAR(volume(mesh), 2.5, 1e-12);
}

TEST(CgnsZones, UnstructuredZonesWithMatchingNodesAreJoined) {
  const std::string path = scratch("pair.cgns");
  {
    const Written out(path);
    const int left = out.cube_zone("left", 0.0);
    static_cast<void>(out.cube_zone("right", 1.0));
    const std::array<cgsize_t, 4> here{2, 3, 6, 7}, there{1, 4, 5, 8};
    int number = 0;
    EXPECT_CGNS(cg_conn_write(out.file, out.base, left, "to_right", CGNS_ENUMV(Vertex),
                              CGNS_ENUMV(Abutting1to1), CGNS_ENUMV(PointList), 4, here.data(),
                              "right", CGNS_ENUMV(Unstructured), CGNS_ENUMV(PointListDonor),
                              CGNS_ENUMV(DataTypeNull), 4, there.data(), &number));
  }

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(mesh.points.size(), 12U);
  EXPECT_NEAR(volume(mesh), 2.0, 1e-12);
}

TEST(CgnsZones, AnAdfFileIsReadLikeAnHdf5One) {
  const std::string path = scratch("old.cgns");
  {
    const Written out(path, CG_FILE_ADF);
    out.wall(out.cube_zone("cube", 0.0), "wall", "skin");
  }
  EXPECT_THAT(slurp(path).substr(0, 32), HasSubstr("ADF Database"));

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(counts(mesh, 3), (Counts{{"cube", 1}}));
  EXPECT_EQ(counts(mesh, 2), (Counts{{"wall", 1}}));
}

TEST(CgnsZones, PolyhedraAreRefusedWithAdvice) {
  const std::string path = scratch("ngon.cgns");
  {
    const Written out(path);
    const int zone = out.cube_zone("cube", 0.0);
    const std::array<cgsize_t, 4> quad{1, 4, 3, 2};
    const std::array<cgsize_t, 2> offsets{0, 4};
    int section = 0;
    EXPECT_CGNS(cg_poly_section_write(out.file, out.base, zone, "polygons", CGNS_ENUMV(NGON_n), 2,
                                      2, 0, quad.data(), offsets.data(), &section));
  }

  try {
    static_cast<void>(read_mesh(path));
    ADD_FAILURE() << "was taken";
  } catch (const FileError& error) {
    EXPECT_THAT(error.message(), HasSubstr("polyhedra"));
    EXPECT_THAT(error.where(), HasSubstr("section 'polygons'"));
    EXPECT_THAT(error.remedy(), HasSubstr("standard elements"));
  }
}

TEST(CgnsFamilies, NameTheCadFacesOfTheirPatches) {
  const std::string path = scratch("families.cgns");
  {
    const Written out(path);
    out.wall(out.cube_zone("cube", 0.0), "condition_1", "skin");
    int family = 0, reference = 0, part = 0;
    EXPECT_CGNS(cg_family_write(out.file, out.base, "skin", &family));
    EXPECT_CGNS(
        cg_geo_write(out.file, out.base, family, "Geometry", "body.step", "STEP", &reference));
    for (const char* name : {"face_3", "upper side"}) {
      EXPECT_CGNS(cg_part_write(out.file, out.base, family, reference, name, &part));
    }
    EXPECT_CGNS(cg_family_write(out.file, out.base, "without", &family));
  }

  const std::vector<PatchGeometry> found = read_cgns_geometry(path);

  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].patch, "condition_1");
  EXPECT_EQ(found[0].family, "skin");
  EXPECT_EQ(found[0].file, "body.step");
  EXPECT_THAT(found[0].names, ElementsAre("face_3", "upper side"));
  EXPECT_EQ(found[1].patch, "skin");  // for readers that name patches by family
}

}  // namespace
}  // namespace camber::io
