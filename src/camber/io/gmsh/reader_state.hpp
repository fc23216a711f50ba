#pragma once
// What the parts of the .msh reader share.
#include <camber/io/gmsh/cursor.hpp>
#include <camber/io/gmsh/element_types.hpp>
#include <camber/io/gmsh/node_numbers.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace camber::io::gmsh {

/// The mesh while it is being read.
struct ReaderState {
  ReaderState(std::string path, std::string_view text) : in(std::move(path), text) {}

  Cursor in;
  MeshData mesh;
  NodeNumbers numbers;                  // valid after finish_nodes
  std::vector<std::size_t> node_place;  // offset of each node's number, until finish_nodes
  std::vector<Index> last_use;          // [point] last element that has it
  Index element_count = 0;

  /// Reads a node's number with `next_number` and notes it.
  void add_number(std::int64_t number, std::size_t place);
  void add_coordinates();
  /// Checks that the numbers differ and makes them ready for look-up.
  void finish_nodes();

  /// The number of an element, checked; `wide` as below.
  [[nodiscard]] GlobalId read_element_number(bool wide);
  /// Reads the nodes of one element and appends them in canonical order. `wide` tells that a binary
  /// file stores them in 8 bytes.
  void add_element_nodes(const ElementType& type, std::span<const int> file2canonical, bool wide,
                         std::vector<Index>& nodes);
  /// The number of an element type, checked. @throws FileError for types that Camber cannot take
  [[nodiscard]] ElementType read_type();
  [[nodiscard]] int read_dimension(const char* expected);
};

// Version 4.1; each starts behind "$Name" and ends before "$EndName".
void read_entities_v4(ReaderState& state);
void read_nodes_v4(ReaderState& state);
void read_elements_v4(ReaderState& state);

// Version 2.2.
void read_nodes_v2(ReaderState& state, bool parametric);
void read_elements_v2(ReaderState& state);

}  // namespace camber::io::gmsh
