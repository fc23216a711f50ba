#include <camber/base/error.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/gmsh/cursor.hpp>
#include <camber/io/stl/stl_reader.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>

#include <fmt/format.h>

namespace camber::io {
namespace {

constexpr std::size_t k_head = 80, k_record = 50;

/// Collects triangles and joins equal corners.
class Triangles {
 public:
  explicit Triangles(const std::string& path) {
    data_.source = path;
    data_.blocks.push_back({Shape::triangle, 1, 1, {}, {}});
  }
  void add(const std::array<Vec3, 3>& corner) {
    std::array<Index, 3> node{};
    for (std::size_t i = 0; i < 3; ++i) node[i] = number_of(corner[i]);
    if (node[0] == node[1] || node[1] == node[2] || node[2] == node[0]) return;
    std::vector<Index>& nodes = data_.blocks.front().nodes;
    nodes.insert(nodes.end(), {node[0], node[1], node[2]});  // the lattice order of corners
  }
  MeshData take() {
    if (data_.blocks.front().nodes.empty()) {
      throw FileError("no triangles", data_.source, "give an STL file of a surface");
    }
    return std::move(data_);
  }

 private:
  Index number_of(const Vec3& x) {
    const auto [place, is_new] =
        numbers_.try_emplace({x.x(), x.y(), x.z()}, static_cast<Index>(data_.points.size()));
    if (is_new) data_.points.push_back(x);
    return place->second;
  }
  MeshData data_;
  std::map<std::array<double, 3>, Index> numbers_;
};

std::uint32_t little_endian(const char* bytes) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes, 4);
  return static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8 |
         static_cast<std::uint32_t>(b[2]) << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

MeshData read_binary(const std::string& path, std::string_view bytes, std::size_t count) {
  Triangles triangles(path);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t offset = k_head + 4 + k_record * t + 12 + 4 * i;  // the normal comes first
      const double value = std::bit_cast<float>(little_endian(bytes.data() + offset));
      if (!std::isfinite(value)) {
        throw FileError("a coordinate is not finite", fmt::format("{}, byte {}", path, offset),
                        "write the file again");
      }
      corner[i / 3][static_cast<Eigen::Index>(i % 3)] = value;
    }
    triangles.add(corner);
  }
  return triangles.take();
}

MeshData read_ascii(const std::string& path, std::string_view text) {
  gmsh::Cursor in(path, text);
  Triangles triangles(path);
  std::array<Vec3, 3> corner;
  std::size_t corners = 0;
  while (!in.at_end()) {
    const std::size_t place = in.next_word();
    const std::string_view word = in.word("a keyword of an STL file");
    if (word == "solid" || word == "endsolid" || word == "facet") {
      in.skip_line();  // a name may hold anything; a normal is not needed
    } else if (word == "vertex") {
      if (corners == 3) in.fail(place, "a fourth corner", "triangles only");
      for (Eigen::Index d = 0; d < 3; ++d) corner[corners][d] = in.text_real("a coordinate");
      ++corners;
    } else if (word == "endfacet") {
      if (corners != 3) in.fail(place, in.found(place), "three corners before it");
      triangles.add(corner);
      corners = 0;
    } else if (word != "outer" && word != "loop" && word != "endloop") {
      in.fail(place, in.found(place), "a keyword of an STL file");
    }
  }
  return triangles.take();
}

}  // namespace

MeshData read_stl(const std::string& path) {
  const InputFile file(path);
  return parse_stl(path, file.text());
}

MeshData parse_stl(const std::string& path, std::string_view bytes) {
  // Binary files may begin with "solid" as well: their length tells.
  if (bytes.size() >= k_head + 4) {
    const std::size_t count = little_endian(bytes.data() + k_head);
    if (bytes.size() == k_head + 4 + k_record * count) return read_binary(path, bytes, count);
  }
  if (bytes.starts_with("solid")) return read_ascii(path, bytes);
  throw FileError("not an STL file: it is neither as long as its count says nor begins with solid",
                  path, "give a complete binary or ASCII STL file");
}

}  // namespace camber::io
