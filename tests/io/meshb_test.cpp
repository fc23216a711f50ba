// libMeshb files from a writer of the test's own, byte by byte as the format's library lays them
// out, and those of refine where the shared cases are.
#include <camber/base/error.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/meshb/meshb_reader.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

/// A line of a keyword: whole numbers, reals, whole numbers, in the order they stand.
struct Line {
  std::vector<long> before;
  std::vector<double> reals;
  std::vector<long> after;
};
struct Section {
  int code;
  const char* name;
  std::vector<Line> lines;
};

/// A hex with a pyramid on its top, a prism at its side and a tet at its front, all of unit size.
/// Volumes 1, 1/3, 1/2 and 1/6. Numbers of the file's own corner order: base, then top.
std::vector<Section> small_mesh() {
  std::vector<Line> points;
  for (const auto& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 1),
                        Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1), Vec3(0.5, 0.5, 2),
                        Vec3(2, 0, 0), Vec3(2, 0, 1), Vec3(0.25, -1, 0.125)}) {
    points.push_back({{}, {x.x(), x.y(), x.z()}, {7}});
  }
  return {{4, "Vertices", points},
          {5, "Edges", {{{1, 2, 12}, {}, {}}}},
          {6, "Triangles", {{{1, 2, 12, 5}, {}, {}}, {{2, 12, 6, -3}, {}, {}}}},
          {7, "Quadrilaterals", {{{1, 4, 3, 2, 5}, {}, {}}, {{10, 3, 7, 11, 0}, {}, {}}}},
          {8, "Tetrahedra", {{{1, 2, 6, 12, 1}, {}, {}}}},
          {9, "Prisms", {{{2, 10, 3, 6, 11, 7, 2}, {}, {}}}},
          {49, "Pyramids", {{{5, 6, 7, 8, 9, 1}, {}, {}}}},
          {10, "Hexahedra", {{{1, 2, 3, 4, 5, 6, 7, 8, 1}, {}, {}}}},
          {15, "RequiredVertices", {{{1}, {}, {}}}},
          {40, "VerticesOnGeometricVertices", {{{1, 3}, {}, {}}}},
          {41, "VerticesOnGeometricEdges", {{{1, 12}, {0.5, 0}, {}}, {{2, 12}, {0.75, 0}, {}}}},
          {42,
           "VerticesOnGeometricTriangles",
           {{{2, 5}, {0.5, 0.5, 0}, {}}, {{9, 6}, {0.5, 0.25, 0}, {}}}}};
}

class Bytes {
 public:
  Bytes(int version, bool is_swapped) : version_(version), is_swapped_(is_swapped) {}
  std::string write(const std::vector<Section>& sections, int dimension = 3) {
    put<std::int32_t>(1);
    put<std::int32_t>(version_);
    begin(3);
    put<std::int32_t>(dimension);
    end();
    for (const Section& section : sections) {
      begin(section.code);
      integer(static_cast<long>(section.lines.size()));
      for (const Line& line : section.lines) {
        for (const long i : line.before) integer(i);
        for (const double r : line.reals) real(r);
        for (const long i : line.after) integer(i);
      }
      end();
    }
    begin(54);
    return bytes_;
  }

 private:
  template <class T>
  void put(T value) {
    put_at(bytes_.size(), value);
  }
  template <class T>
  void put_at(std::size_t place, T value) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (is_swapped_ == (std::endian::native == std::endian::little)) {
      std::reverse(raw.begin(), raw.end());
    }
    bytes_.resize(std::max(bytes_.size(), place + sizeof(T)));
    std::memcpy(bytes_.data() + place, raw.data(), sizeof(T));
  }
  void place(std::size_t at, std::size_t value) {
    if (version_ >= 3) {
      put_at(at, static_cast<std::int64_t>(value));
    } else {
      put_at(at, static_cast<std::int32_t>(value));
    }
  }
  void begin(int code) {
    put<std::int32_t>(code);
    next_ = bytes_.size();
    place(next_, 0);
  }
  void end() { place(next_, bytes_.size()); }
  void integer(long value) {
    if (version_ == 4) {
      put(static_cast<std::int64_t>(value));
    } else {
      put(static_cast<std::int32_t>(value));
    }
  }
  void real(double value) {
    if (version_ == 1) {
      put(static_cast<float>(value));
    } else {
      put(value);
    }
  }
  int version_;
  bool is_swapped_;
  std::string bytes_;
  std::size_t next_ = 0;
};

std::string text_of(const std::vector<Section>& sections) {
  std::string text = "# made by a test\nMeshVersionFormatted 2\n\nDimension\n3\n";
  for (const Section& section : sections) {
    text += fmt::format("\n{}\n# lines\n{}\n", section.name, section.lines.size());
    for (const Line& line : section.lines) {
      for (const long i : line.before) text += fmt::format("{} ", i);
      for (const double r : line.reals) text += fmt::format("{} ", r);
      for (const long i : line.after) text += fmt::format("{} ", i);
      text += '\n';
    }
  }
  return text + "\nEnd\n";
}

std::string name_of(const MeshData& mesh, EntityKey key) {
  for (const EntityRecord& e : mesh.entities) {
    if (e.key == key) return e.name;
  }
  return "no such entity";
}

void expect_small_mesh(const MeshData& mesh) {
  ASSERT_EQ(mesh.points.size(), 12U);
  EXPECT_EQ(mesh.points[8], Vec3(0.5, 0.5, 2));
  EXPECT_EQ(mesh.points[11], Vec3(0.25, -1, 0.125));
  const std::vector<double> measure = measures(mesh);
  std::map<Shape, double> sum;
  std::map<Shape, std::vector<int>> tags;
  std::size_t e = 0;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t i = 0; i < block.size(); ++i) sum[block.shape] += measure[e++];
    tags[block.shape].push_back(block.entity);
  }
  EXPECT_NEAR(sum[Shape::tetrahedron], 1.0 / 6.0, 1e-14);
  EXPECT_NEAR(sum[Shape::pyramid], 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(sum[Shape::prism], 0.5, 1e-14);
  EXPECT_NEAR(sum[Shape::hexahedron], 1.0, 1e-14);
  EXPECT_NEAR(sum[Shape::quadrilateral], 1.0 + std::sqrt(2.0), 1e-14);
  EXPECT_EQ(tags[Shape::line], std::vector<int>{k_meshb_curves + 12});
  EXPECT_EQ(tags[Shape::prism], std::vector<int>{2});
  // 5 is a tag; 0 and -3 get the ones above it.
  EXPECT_EQ(name_of(mesh, {2, 5}), "surface_5");
  std::vector<std::string> others{name_of(mesh, {2, 6}), name_of(mesh, {2, 7})};
  std::sort(others.begin(), others.end());
  EXPECT_EQ(others, (std::vector<std::string>{"surface_-3", "surface_0"}));
  EXPECT_EQ(name_of(mesh, {3, 1}), "volume_1");
  ASSERT_EQ(mesh.point_entity.size(), 12U);
  EXPECT_EQ(mesh.point_entity[0], (EntityKey{0, k_meshb_curves + 3}));  // and on an edge
  EXPECT_EQ(mesh.point_entity[1], (EntityKey{1, k_meshb_curves + 12}));
  EXPECT_EQ(mesh.point_entity[8], (EntityKey{2, 6}));  // by what the file says only
  EXPECT_EQ(mesh.point_entity[3], (EntityKey{2, 5}));  // by its face
}

TEST(Meshb, ReadsEveryVersionInEitherByteOrder) {
  for (const int version : {1, 2, 3, 4}) {
    for (const bool is_swapped : {false, true}) {
      SCOPED_TRACE(fmt::format("version {}, {}", version, is_swapped ? "big" : "little"));
      expect_small_mesh(parse_meshb("a.meshb", Bytes(version, is_swapped).write(small_mesh())));
    }
  }
}

TEST(Meshb, ReadsText) { expect_small_mesh(parse_meshb("a.mesh", text_of(small_mesh()))); }

TEST(Meshb, KeepsEveryBitOfCoordinates) {
  std::vector<Section> sections = small_mesh();
  sections[0].lines[11].reals = {1.0 / 3.0, std::nextafter(0.1, 1.0), -1e-300};
  const Vec3 expected(1.0 / 3.0, std::nextafter(0.1, 1.0), -1e-300);

  EXPECT_EQ(parse_meshb("a", Bytes(2, true).write(sections)).points[11], expected);
  EXPECT_EQ(parse_meshb("a", text_of(sections)).points[11], expected);
}

TEST(Meshb, IsReadByItsExtensionsAndNeverWritten) {
  spill(scratch("a.meshb"), Bytes(3, false).write(small_mesh()));
  spill(scratch("a.mesh"), text_of(small_mesh()));

  expect_small_mesh(read_mesh(scratch("a.meshb")));
  expect_small_mesh(read_mesh(scratch("a.mesh")));
  EXPECT_THROW(write_mesh(read_mesh(scratch("a.mesh")), scratch("b.meshb")), FileError);
  EXPECT_FALSE(std::filesystem::exists(scratch("b.meshb")));
}

/// The bytes must give one FileError whose place and message hold these.
void expect_refused(const std::string& bytes, const std::string& where, const std::string& what) {
  try {
    static_cast<void>(parse_meshb("a.meshb", bytes));
    ADD_FAILURE() << "read without an error, expected " << what;
  } catch (const FileError& error) {
    EXPECT_NE(error.where().find(where), std::string::npos) << error.what();
    EXPECT_NE(error.message().find(what), std::string::npos) << error.what();
  }
}

TEST(Meshb, RefusesDamageAndSaysWhere) {
  const std::string good = Bytes(2, false).write(small_mesh());
  std::string absurd = good;
  absurd.replace(28, 4, "\xff\xff\xff\x7f");  // the number of vertices
  expect_refused(absurd, "byte 28", "the number of vertices that fits");
  std::string negative = good;
  negative.replace(28, 4, "\xff\xff\xff\xff");
  expect_refused(negative, "byte 28", "found -1");
  std::string loop = good;
  loop.replace(24, 4, std::string("\x08\0\0\0", 4));  // back to Dimension
  expect_refused(loop, "byte 24", "the place of the next keyword");
  std::string fewer = good;
  fewer.replace(28, 4, std::string("\x0b\0\0\0", 4));  // 11 of 12 vertices
  expect_refused(fewer, "byte 20", "where the next keyword stands");
  expect_refused(std::string("\1\0\0\0\5\0\0\0", 8), "byte 4", "version 1 to 4");
  expect_refused(Bytes(2, false).write(small_mesh(), 2), "byte 16", "dimension 3");
  for (std::size_t length = 0; length < good.size() - 8; ++length) {
    EXPECT_THROW(static_cast<void>(parse_meshb("a", good.substr(0, length))), FileError) << length;
  }
}

TEST(Meshb, RefusesWhatItCannotRepresent) {
  std::vector<Section> curved = small_mesh();
  curved.push_back({30, "TetrahedraP2", {{{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1}, {}, {}}}});
  expect_refused(Bytes(2, false).write(curved), "byte", "found TetrahedraP2");
  expect_refused(text_of(curved), "line", "found TetrahedraP2");
  expect_refused("MFEM mesh v1.0\n", "a.meshb", "can only be written");
  expect_refused("Dimension 3\n", "line 1", "MeshVersionFormatted");
  std::vector<Section> far = small_mesh();
  far[4].lines[0].before[2] = 13;
  expect_refused(text_of(far), "line 43", "a vertex from 1 to 12");
  std::vector<Section> flat = small_mesh();
  std::erase_if(flat, [](const Section& s) { return s.code >= 8 && s.code < 50 && s.code != 15; });
  expect_refused(Bytes(2, false).write(flat), "byte", "a volume mesh");
}

TEST(Meshb, FilesOfRefineHaveTheirCountsAndCadNumbers) {
  const std::string path = std::string(CAMBER_SHARED_CASES) + "/foreign/onera-m6/onera01.meshb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";

  const MeshData mesh = read_mesh(path);

  std::map<Shape, std::size_t> count;
  for (const ElementBlock& b : mesh.blocks) count[b.shape] += b.size();
  EXPECT_EQ(mesh.points.size(), 1544U);
  EXPECT_EQ(count[Shape::tetrahedron], 6495U);
  EXPECT_EQ(count[Shape::triangle], 1670U);
  EXPECT_EQ(count[Shape::line], 189U);
  EXPECT_EQ(std::count_if(mesh.point_entity.begin(), mesh.point_entity.end(),
                          [](EntityKey key) { return key.dim == 0; }),
            14);
}

}  // namespace
}  // namespace camber::io
