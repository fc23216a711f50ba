#include <camber/base/error.hpp>
#include <camber/base/log.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/gmsh/cursor.hpp>
#include <camber/io/meshb/meshb_keywords.hpp>
#include <camber/io/meshb/meshb_reader.hpp>

#include <algorithm>
#include <bit>
#include <limits>

#include <fmt/format.h>

namespace camber::io {
namespace meshb {
namespace {

constexpr std::int64_t k_dimension = 3;   // the keyword's number, and the one value that is taken
constexpr std::size_t k_most_named = 12;  // keywords that were read past, in the log

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_binary(std::string_view bytes) {
  return bytes.size() >= 4 && (bytes.substr(0, 4) == std::string_view("\0\0\0\1", 4) ||
                               bytes.substr(0, 4) == std::string_view("\1\0\0\0", 4));
}

class Reader {
 public:
  Reader(const std::string& path, std::string_view bytes)
      : bytes_(bytes), in_(path, bytes), builder_(path) {}

  MeshData run() {
    if (is_binary(bytes_)) {
      read_binary();
    } else {
      read_text();
    }
    check();
    name_skipped();
    settle_references();
    MeshData mesh = builder_.finish();
    classify(mesh);
    return mesh;
  }

 private:
  // Binary: a chain of keywords, each with the place of the next.

  void read_binary() {
    const bool is_swapped = bytes_[0] == (std::endian::native == std::endian::big ? '\1' : '\0');
    in_.use_binary(is_swapped);
    static_cast<void>(in_.int_value("1"));
    read_version();
    std::size_t place = in_.offset();
    if (in_.int_value("the keyword Dimension (3)") != k_dimension) {
      in_.fail(place, in_.found(place), "the keyword Dimension (3)");
    }
    std::size_t next = read_place();
    read_dimension();
    while (next != 0) {
      in_.move_to(next);
      place = next;
      const std::int64_t code = in_.int_value("the number of a keyword");
      const std::optional<Keyword> known = keyword(code);
      if (known && known->task == Task::end) return;
      next = read_place();
      if (!known || known->task == Task::skipped) {
        skipped_.emplace_back(known ? std::string(known->name) : fmt::format("keyword {}", code));
        continue;
      }
      read_keyword(*known, place);
      if (next != 0 && in_.offset() != next) {
        in_.fail(place, fmt::format("{} that end at byte {}", known->name, in_.offset()),
                 fmt::format("byte {}, where the next keyword stands", next));
      }
    }
  }

  /// Place of the next keyword: behind this one, so that every chain ends.
  std::size_t read_place() {
    const std::size_t place = in_.offset();
    constexpr const char* k_what = "the place of the next keyword";
    const std::int64_t next = version_ >= 3 ? in_.long_value(k_what) : in_.int_value(k_what);
    const bool is_ahead = next > static_cast<std::int64_t>(in_.offset()) &&
                          next <= static_cast<std::int64_t>(bytes_.size());
    if (next != 0 && !is_ahead) {
      in_.fail(place, std::to_string(next),
               fmt::format("{}, from {} to {}, or 0", k_what, in_.offset() + 1, bytes_.size()));
    }
    return static_cast<std::size_t>(next);
  }

  // Text: words and numbers; '#' begins a comment.

  void read_text() {
    bool has_dimension = false;
    while (!at_end()) {
      const std::size_t place = in_.next_word();
      const std::string_view word = in_.word("a keyword");
      if (version_ == 0 && word != "MeshVersionFormatted") {
        in_.fail(place, in_.found(place), "MeshVersionFormatted, or a binary .meshb file");
      }
      if (word == "MeshVersionFormatted") {
        read_version();
      } else if (word == "Dimension") {
        read_dimension();
        has_dimension = true;
      } else if (!is_letter(word.front())) {
        continue;  // a line of a keyword that is read past
      } else {
        const std::optional<Keyword> known = keyword(word);
        if (known && known->task == Task::end) break;
        if (!known || known->task == Task::skipped) {
          if (skipped_.size() < k_most_named) skipped_.emplace_back(word.substr(0, 40));
          continue;
        }
        if (!has_dimension) in_.fail(place, in_.found(place), "Dimension before it");
        read_keyword(*known, place);
      }
    }
    if (version_ == 0) in_.fail(bytes_.size(), in_.found(bytes_.size()), "MeshVersionFormatted");
  }

  /// Moves over blanks and comments.
  bool at_end() {
    while (!in_.at_end() && bytes_[in_.next_word()] == '#') in_.skip_line();
    return in_.at_end();
  }

  // Both.

  void read_version() {
    const std::size_t place = in_.next();
    const std::int64_t version = in_.int_value("a version");
    if (version < 1 || version > 4) in_.fail(place, std::to_string(version), "version 1 to 4");
    version_ = static_cast<int>(version);
  }
  void read_dimension() {
    const std::size_t place = in_.next();
    const std::int64_t dimension = in_.int_value("the dimension");
    if (dimension != k_dimension) {
      in_.fail(place, std::to_string(dimension), "dimension 3: Camber curves volume meshes");
    }
  }
  std::int64_t integer(const char* expected) {
    return version_ == 4 ? in_.long_value(expected) : in_.int_value(expected);
  }
  double real(const char* expected) {
    return version_ == 1 ? in_.short_real(expected) : in_.real(expected);
  }

  /// @param reals, integers  numbers on one line
  std::size_t read_count(std::size_t integers, std::size_t reals, const char* expected) {
    if (!in_.is_binary()) static_cast<void>(at_end());
    const std::size_t place = in_.next();
    const std::size_t line =
        integers * (version_ == 4 ? 8U : 4U) + reals * (version_ == 1 ? 4U : 8U);
    return in_.checked_count(integer(expected), place, 2 * (integers + reals), line, expected);
  }
  void start_line() {
    if (!in_.is_binary()) static_cast<void>(at_end());
  }

  void read_keyword(const Keyword& keyword, std::size_t place) {
    if (keyword.task == Task::vertices) read_vertices(place);
    if (keyword.task == Task::elements) read_elements(keyword);
    if (keyword.task == Task::on_geometry) read_on_geometry(keyword);
    if (keyword.task == Task::refused) {
      throw FileError(fmt::format("found {}, expected linear elements", keyword.name),
                      in_.where(place), "save the linear mesh: Camber makes the curved one");
    }
  }

  void read_vertices(std::size_t place) {
    if (has_vertices_) in_.fail(place, "a second Vertices", "one mesh a file");
    has_vertices_ = true;
    const std::size_t count = read_count(1, 3, "the number of vertices");
    builder_.points().reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      start_line();
      const double x = real("a finite x coordinate");
      const double y = real("a finite y coordinate");
      const double z = real("a finite z coordinate");
      builder_.points().emplace_back(x, y, z);
      static_cast<void>(integer("the reference of a vertex"));
    }
  }

  void read_elements(const Keyword& keyword) {
    const std::vector<int>& corner = lattice_map(keyword.shape, 1).corner;
    const std::size_t count = read_count(corner.size() + 1, 0, "the number of elements");
    std::vector<Index> nodes(corner.size());
    for (std::size_t e = 0; e < count; ++e) {
      start_line();
      for (const int at_corner : corner) {
        nodes[static_cast<std::size_t>(at_corner)] = read_vertex("a vertex of an element");
      }
      const int entity = read_reference(dimension(keyword.shape));
      builder_.add(keyword.shape, 1, entity, nodes);
    }
  }

  /// Number of a vertex, 0-based.
  Index read_vertex(const char* expected) {
    const std::size_t place = in_.next();
    const std::int64_t vertex = integer(expected);
    if (vertex < 1 || vertex > std::numeric_limits<Index>::max()) {
      in_.fail(place, std::to_string(vertex), fmt::format("{}, 1 or more", expected));
    }
    if (vertex > highest_vertex_) {
      highest_vertex_ = vertex;
      highest_place_ = place;
    }
    return static_cast<Index>(vertex - 1);
  }

  static constexpr std::int64_t k_highest = std::numeric_limits<int>::max() - k_meshb_curves;
  static int tag_of(int dim, std::int64_t number) {
    return static_cast<int>(number > 0 && dim < 2 ? number + k_meshb_curves : number);
  }

  /// A reference as the tag of its entity.
  int read_reference(int dim) {
    const std::size_t place = in_.next();
    const std::int64_t reference = integer("the reference of an element");
    if (reference < std::numeric_limits<int>::min() || reference > k_highest) {
      in_.fail(place, std::to_string(reference), fmt::format("a reference up to {}", k_highest));
    }
    const int tag = tag_of(dim, reference);
    if (last_ == EntityKey{dim, tag}) return tag;  // most elements: no name is made
    last_ = {dim, tag};
    static constexpr std::array k_stems{"vertex", "curve", "surface", "volume"};
    return builder_.entity(
        dim, fmt::format("{}_{}", k_stems[static_cast<std::size_t>(dim)], reference), tag);
  }

  void read_on_geometry(const Keyword& keyword) {
    const std::size_t reals = keyword.dim == 0 ? 0 : static_cast<std::size_t>(keyword.dim) + 1;
    const std::size_t count = read_count(2, reals, "the number of vertices on geometry");
    for (std::size_t i = 0; i < count; ++i) {
      start_line();
      const Index vertex = read_vertex("a vertex on geometry");
      const std::size_t place = in_.next();
      const std::int64_t number = integer("the number of a CAD entity");
      if (number < 1 || number > k_highest) {
        in_.fail(place, std::to_string(number),
                 fmt::format("the number of a CAD entity, 1 to {}", k_highest));
      }
      for (std::size_t r = 0; r < reals; ++r) static_cast<void>(real("a finite parameter"));
      on_geometry_.emplace_back(vertex, EntityKey{keyword.dim, tag_of(keyword.dim, number)});
    }
  }

  void check() const {
    const auto count = static_cast<std::int64_t>(points());
    if (highest_vertex_ > count) {
      in_.fail(highest_place_, std::to_string(highest_vertex_),
               fmt::format("a vertex from 1 to {}", count));
    }
    const std::vector<ElementBlock>& blocks = builder_.mesh().blocks;
    if (std::none_of(blocks.begin(), blocks.end(),
                     [](const ElementBlock& b) { return dimension(b.shape) == 3; })) {
      in_.fail(bytes_.size(), "no cells", "a volume mesh");
    }
  }

  void name_skipped() const {
    std::string names;
    for (std::size_t i = 0; i < std::min(skipped_.size(), k_most_named); ++i) {
      names += (names.empty() ? "" : ", ") + skipped_[i];
    }
    if (!names.empty()) {
      log(LogLevel::info, fmt::format("{}: read past {}", builder_.mesh().source, names));
    }
  }

  /// Tags below 1 mean "no entity" elsewhere.
  void settle_references() {
    std::map<EntityKey, int> tag;
    std::array<int, 4> last{0, k_meshb_curves, 0, 0};
    std::vector<EntityRecord>& entities = builder_.mesh().entities;
    for (const EntityRecord& e : entities) {
      int& highest = last[static_cast<std::size_t>(e.key.dim)];
      highest = std::max(highest, e.key.tag);
    }
    for (EntityRecord& e : entities) {
      if (e.key.tag > 0) continue;
      int& highest = last[static_cast<std::size_t>(e.key.dim)];
      if (highest == std::numeric_limits<int>::max()) {
        throw FileError("more references than there are numbers", builder_.mesh().source,
                        "renumber the references");
      }
      tag[e.key] = ++highest;
      e.key.tag = highest;
    }
    for (ElementBlock& block : builder_.mesh().blocks) {
      const auto renamed = tag.find({dimension(block.shape), block.entity});
      if (renamed != tag.end()) block.entity = renamed->second;
    }
  }

  void classify(MeshData& mesh) const {
    for (const auto& [vertex, key] : on_geometry_) {
      EntityKey& entity = mesh.point_entity[at(vertex)];
      if (entity.dim < 0 || key.dim < entity.dim) entity = key;
    }
  }

  [[nodiscard]] std::size_t points() const { return builder_.mesh().points.size(); }

  std::string_view bytes_;
  gmsh::Cursor in_;
  NamedMeshBuilder builder_;
  int version_ = 0;
  bool has_vertices_ = false;
  EntityKey last_{-1, 0};
  std::int64_t highest_vertex_ = 0;
  std::size_t highest_place_ = 0;
  std::vector<std::pair<Index, EntityKey>> on_geometry_;
  std::vector<std::string> skipped_;
};

}  // namespace
}  // namespace meshb

MeshData parse_meshb(const std::string& path, std::string_view bytes) {
  if (bytes.starts_with("MFEM")) {
    throw FileError("MFEM 1.0 files can only be written", path, "read the .msh file of the mesh");
  }
  return meshb::Reader(path, bytes).run();
}

MeshData read_meshb(const std::string& path) { return parse_meshb(path, InputFile(path).text()); }

}  // namespace camber::io
