#include <camber/base/error.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/gmsh/cursor.hpp>
#include <camber/io/ugrid/ugrid_layout.hpp>
#include <camber/io/ugrid/ugrid_reader.hpp>

#include <bit>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace camber::io {
namespace ugrid {
namespace {

class Reader {
 public:
  Reader(const std::string& path, std::string_view bytes, std::map<std::int64_t, std::string> names)
      : layout_(layout_of(path)), in_(path, bytes), builder_(path), names_(std::move(names)) {
    const bool is_native_big = std::endian::native == std::endian::big;
    if (layout_.is_binary) in_.use_binary(layout_.is_big_endian != is_native_big);
  }

  MeshData run() {
    const std::optional<std::int64_t> head = open_record();
    read_counts();
    close_record(head);
    const std::optional<std::int64_t> body = open_record();
    read_points();
    read_faces();
    for (std::size_t k = 0; k < k_cells.size(); ++k) read_cells(k_cells[k], counts_[k + 3]);
    if (body) close_record(body);
    return builder_.finish();
  }

 private:
  /// Length of the Fortran record that starts here.
  std::optional<std::int64_t> open_record() {
    if (!layout_.has_records) return std::nullopt;
    return in_.int_value("the length of a record");
  }
  void close_record(const std::optional<std::int64_t>& length) {
    if (!length) return;
    const std::size_t place = in_.offset();
    const std::int64_t again = in_.int_value("the length of a record");
    if (again != *length) {
      in_.fail(place, std::to_string(again), fmt::format("{}, the length of the record", *length));
    }
  }

  void read_counts() {
    constexpr std::array<const char*, 7> k_what{"the number of nodes",    "the number of triangles",
                                                "the number of quads",    "the number of tets",
                                                "the number of pyramids", "the number of prisms",
                                                "the number of hexes"};
    // Bytes that an item takes at least: text "0 0 0\n" and so on.
    constexpr std::array<std::size_t, 7> k_text{6, 6, 8, 8, 10, 12, 16};
    constexpr std::array<std::size_t, 7> k_binary{24, 12, 16, 16, 20, 24, 32};
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const std::size_t place = in_.next();
      counts_[i] =
          in_.checked_count(in_.int_value(k_what[i]), place, k_text[i], k_binary[i], k_what[i]);
    }
    if (counts_[3] + counts_[4] + counts_[5] + counts_[6] == 0) {
      in_.fail(in_.offset(), "no cells", "a volume mesh");
    }
  }

  void read_points() {
    builder_.points().reserve(counts_[0]);
    for (std::size_t i = 0; i < counts_[0]; ++i) {
      const double x = in_.real("a finite x coordinate");
      const double y = in_.real("a finite y coordinate");
      const double z = in_.real("a finite z coordinate");
      builder_.points().emplace_back(x, y, z);
    }
  }

  /// Nodes of one element in canonical order, appended.
  void read_nodes(const Kind& kind, std::vector<Index>& nodes) {
    const std::vector<int>& corner = lattice_map(kind.shape, 1).corner;
    const std::size_t start = nodes.size();
    nodes.resize(start + corner.size());
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const std::size_t place = in_.next();
      const std::int64_t node = in_.int_value("a node of an element");
      if (node < 1 || static_cast<std::uint64_t>(node) > counts_[0]) {
        in_.fail(place, std::to_string(node), fmt::format("a node from 1 to {}", counts_[0]));
      }
      const auto c = static_cast<std::size_t>(kind.corner_of_file[i]);
      nodes[start + static_cast<std::size_t>(corner[c])] = static_cast<Index>(node - 1);
    }
  }

  void read_faces() {
    std::array<std::vector<Index>, 2> nodes;
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t f = 0; f < counts_[k + 1]; ++f) read_nodes(k_faces[k], nodes[k]);
    }
    std::map<std::int64_t, int> entity;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto per = static_cast<std::size_t>(corner_count(k_faces[k].shape));
      for (std::size_t f = 0; f < counts_[k + 1]; ++f) {
        const std::int64_t tag = in_.int_value("the tag of a boundary face");
        const auto [place, is_new] = entity.try_emplace(tag, 0);
        if (is_new) place->second = builder_.entity(2, name_of(tag));
        builder_.add(k_faces[k].shape, 1, place->second, {nodes[k].data() + f * per, per});
      }
    }
  }

  void read_cells(const Kind& kind, std::size_t count) {
    const int entity = builder_.entity(3, "volume");
    for (std::size_t e = 0; e < count; ++e) {
      nodes_.clear();
      read_nodes(kind, nodes_);
      builder_.add(kind.shape, 1, entity, nodes_);
    }
  }

  [[nodiscard]] std::string name_of(std::int64_t tag) const {
    const auto known = names_.find(tag);
    return known == names_.end() ? fmt::format("surface_{}", tag) : known->second;
  }

  Layout layout_;
  gmsh::Cursor in_;
  NamedMeshBuilder builder_;
  std::map<std::int64_t, std::string> names_;
  std::array<std::size_t, 7> counts_{};
  std::vector<Index> nodes_;
};

}  // namespace
}  // namespace ugrid

std::map<std::int64_t, std::string> parse_mapbc(const std::string& path, std::string_view text) {
  std::map<std::int64_t, std::string> names;
  gmsh::Cursor in(path, text);
  if (in.at_end()) return names;
  const std::size_t place = in.next_word();
  const std::size_t count = in.checked_count(in.text_integer("the number of patches"), place, 4, 4,
                                             "a number of patches");
  in.skip_line();
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t tag = in.text_integer("the tag of a patch");
    static_cast<void>(in.word("a boundary condition"));
    const std::string_view line = text.substr(in.offset());
    const std::size_t end = std::min(line.find('\n'), line.size());
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first < end) names[tag] = std::string(in.word("a name"));
    in.skip_line();
  }
  return names;
}

MeshData parse_ugrid(const std::string& path, std::string_view bytes, std::string_view mapbc) {
  return ugrid::Reader(path, bytes, parse_mapbc(ugrid::mapbc_path(path), mapbc)).run();
}

MeshData read_ugrid(const std::string& path) {
  const InputFile file(path);
  const std::string names = ugrid::mapbc_path(path);
  std::error_code failed;
  if (!std::filesystem::is_regular_file(names, failed)) return parse_ugrid(path, file.text(), "");
  return parse_ugrid(path, file.text(), InputFile(names).text());
}

}  // namespace camber::io
