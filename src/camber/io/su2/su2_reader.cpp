#include <camber/base/error.hpp>
#include <camber/base/log.hpp>
#include <camber/basis/node_order.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/detail/prism_direction.hpp>
#include <camber/io/gmsh/cursor.hpp>
#include <camber/io/su2/su2_reader.hpp>
#include <camber/io/su2/su2_types.hpp>

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace camber::io {
namespace su2 {
namespace {

/// Bytes that the shortest element ("3 0 1\n") and the shortest node ("0 0 0\n") take.
constexpr std::size_t k_shortest = 6;

class Reader {
 public:
  Reader(const std::string& path, std::string_view text)
      : path_(path), text_(text), in_(path, text), builder_(path) {}

  MeshData run() {
    while (!at_end()) read_key();
    if (!has_points_) fail_missing("NPOIN= (the nodes)");
    if (cells_ == 0) fail_missing("NELEM= (the cells)");
    check_nodes();
    face_prisms_up();
    return builder_.finish();
  }

 private:
  /// Moves over blanks and comments.
  bool at_end() {
    while (!in_.at_end() && text_[in_.next_word()] == '%') in_.skip_line();
    return in_.at_end();
  }
  [[noreturn]] void fail_missing(const char* expected) const {
    in_.fail(text_.size(), in_.found(text_.size()), expected);
  }

  void read_key() {
    const std::size_t start = in_.next_word();
    const std::size_t line_end = std::min(text_.find('\n', start), text_.size());
    const std::string_view line = text_.substr(start, line_end - start);
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos) {
      in_.fail(start, in_.found(start), "a key and '=', such as NELEM=");
    }
    std::string_view key = line.substr(0, sign);
    while (!key.empty() && (key.back() == ' ' || key.back() == '\t')) key.remove_suffix(1);
    static_cast<void>(in_.skip_past("="));
    if (key == "NDIME") {
      read_dimension();
    } else if (key == "NELEM") {
      read_cells();
    } else if (key == "NPOIN") {
      read_points();
    } else if (key == "MARKER_TAG") {
      read_marker();
    } else if (key == "NZONE" || key == "IZONE") {
      const std::size_t place = in_.next_word();
      if (in_.text_integer("a number of zones") != 1) {
        in_.fail(place, in_.found(place), "1: one zone a file");
      }
      in_.skip_line();
    } else {
      in_.skip_line();  // NMARK, NCHUNK, NPERIODIC and others say nothing about the mesh's shape
    }
  }

  void read_dimension() {
    const std::size_t place = in_.next_word();
    if (in_.text_integer("the dimension") != 3) {
      in_.fail(place, in_.found(place), "dimension 3: Camber curves volume meshes");
    }
    in_.skip_line();
  }

  std::size_t read_count(const char* what) {
    const std::size_t place = in_.next_word();
    const std::int64_t count = in_.text_integer(what);
    const std::size_t checked = in_.checked_count(count, place, k_shortest, k_shortest, what);
    in_.skip_line();
    return checked;
  }

  void read_cells() {
    if (cells_ > 0) in_.fail(in_.offset(), "a second NELEM=", "one zone a file");
    const std::size_t count = read_count("the number of cells");
    const int entity = builder_.entity(3, "volume");
    for (std::size_t e = 0; e < count; ++e) read_element(3, entity);
    cells_ = count;
  }

  void read_element(int dim, int entity) {
    if (at_end()) fail_missing("an element");
    const std::size_t place = in_.next_word();
    const std::int64_t code = in_.text_integer("the type of an element");
    const std::optional<ElementType> type = element_type(code);
    if (!type || dimension(type->shape) != dim) {
      in_.fail(place, in_.found(place),
               dim == 3 ? "a cell: VTK type 10, 12, 13 or 14, plus 100 (order - 1), order 1 to 4"
                        : "a face: VTK type 5 or 9, plus 100 (order - 1), order 1 to 4");
    }
    const std::span<const int> order =
        file_to_canonical(NodeConvention::su2, type->shape, type->order);
    nodes_.resize(order.size());
    for (const int n : order) {
      const std::size_t node_place = in_.next_word();
      const std::int64_t node = in_.text_integer("a node of an element");
      if (node < 0 || node > k_most_nodes) {
        in_.fail(node_place, in_.found(node_place), "a node number of 0 or more");
      }
      if (node > highest_node_) {
        highest_node_ = node;
        highest_place_ = node_place;
      }
      nodes_[static_cast<std::size_t>(n)] = static_cast<Index>(node);
    }
    builder_.add(type->shape, type->order, entity, nodes_);
    in_.skip_line();  // the element's number may follow
  }

  void read_points() {
    if (has_points_) in_.fail(in_.offset(), "a second NPOIN=", "one zone a file");
    const std::size_t count = read_count("the number of nodes");
    builder_.points().reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (at_end()) fail_missing("a node");
      const double x = in_.text_real("a finite x coordinate");
      const double y = in_.text_real("a finite y coordinate");
      const double z = in_.text_real("a finite z coordinate");
      builder_.points().emplace_back(x, y, z);
      in_.skip_line();
    }
    has_points_ = true;
  }

  void read_marker() {
    const std::string name(in_.word("the name of a marker"));
    in_.skip_line();
    if (at_end()) fail_missing("MARKER_ELEMS=");
    const std::size_t place = in_.next_word();
    if (text_.substr(place, 12) != "MARKER_ELEMS" || !in_.skip_past("=")) {
      in_.fail(place, in_.found(place), "MARKER_ELEMS=");
    }
    const std::size_t count = read_count("the number of faces of a marker");
    if (name == "SEND_RECEIVE") {
      in_.fail(place, "a partitioned mesh (SEND_RECEIVE)", "the whole mesh in one file");
    }
    const int entity = builder_.entity(2, name);
    for (std::size_t e = 0; e < count; ++e) read_element(2, entity);
  }

  void check_nodes() {
    if (highest_node_ < static_cast<std::int64_t>(builder_.points().size())) return;
    in_.fail(highest_place_, in_.found(highest_place_),
             fmt::format("a node below {}, the number of nodes", builder_.points().size()));
  }

  /// VTK's documentation and SU2's own meshes disagree on the direction of linear prisms, and SU2
  /// turns what it reads. If most are mirrored, that is how the file counts.
  void face_prisms_up() {
    constexpr std::size_t k_corners = 6;
    std::vector<std::span<Index>> prisms;
    std::size_t mirrored = 0;
    for (ElementBlock& block : builder_.mesh().blocks) {
      if (block.shape != Shape::prism || block.order != 1) continue;
      for (std::size_t e = 0; e < block.nodes.size(); e += k_corners) {
        prisms.push_back(std::span(block.nodes).subspan(e, k_corners));
        mirrored += is_mirrored_prism(builder_.points(), 1, prisms.back()) ? 1U : 0U;
      }
    }
    if (2 * mirrored <= prisms.size()) return;
    for (const std::span<Index> prism : prisms) mirror_prism(1, prism);
    log(LogLevel::info, fmt::format("{}: linear prisms were turned: most have their first triangle "
                                    "outwards",
                                    path_));
  }

  static constexpr std::int64_t k_most_nodes = std::numeric_limits<Index>::max();
  std::string path_;
  std::string_view text_;
  gmsh::Cursor in_;
  NamedMeshBuilder builder_;
  std::vector<Index> nodes_;
  std::size_t cells_ = 0;
  bool has_points_ = false;
  std::int64_t highest_node_ = -1;
  std::size_t highest_place_ = 0;
};

}  // namespace
}  // namespace su2

MeshData parse_su2(const std::string& path, std::string_view bytes) {
  return su2::Reader(path, bytes).run();
}

MeshData read_su2(const std::string& path) { return parse_su2(path, InputFile(path).text()); }

}  // namespace camber::io
