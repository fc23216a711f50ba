#include <camber/base/error.hpp>
#include <camber/io/gmsh/reader_state.hpp>

#include <limits>

#include <fmt/format.h>

namespace camber::io::gmsh {

void ReaderState::add_number(std::int64_t number, std::size_t place) {
  if (number < 1) in.fail(place, std::to_string(number), "a node number of 1 or more");
  if (mesh.point_tags.size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
    in.fail(place, "more than 2147483647 nodes", "a mesh that one process can index");
  }
  mesh.point_tags.push_back(number);
  node_place.push_back(place);
}

void ReaderState::add_coordinates() {
  const double x = in.real("a finite x coordinate");
  const double y = in.real("a finite y coordinate");
  const double z = in.real("a finite z coordinate");
  mesh.points.emplace_back(x, y, z);
}

void ReaderState::finish_nodes() {
  numbers = NodeNumbers(mesh.point_tags);
  if (const auto twin = numbers.duplicate()) {
    in.fail(node_place[at(*twin)], fmt::format("node number {} again", mesh.point_tags[at(*twin)]),
            "each node number once");
  }
  node_place = {};
  last_use.assign(mesh.points.size(), k_none);
}

GlobalId ReaderState::read_element_number(bool wide) {
  const char* const expected = "an element number of 1 or more";
  const std::size_t place = in.next();
  const std::int64_t number = wide ? in.size_value(expected) : in.int_value(expected);
  if (number < 1) in.fail(place, std::to_string(number), expected);
  return number;
}

void ReaderState::add_element_nodes(const ElementType& type, std::span<const int> file2canonical,
                                    bool wide, std::vector<Index>& nodes) {
  const auto count = static_cast<std::size_t>(type.node_count);
  const std::size_t base = nodes.size();
  nodes.resize(base + count);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t place = in.next();
    const std::int64_t number = wide ? in.size_value("a node number of the element")
                                     : in.int_value("a node number of the element");
    const Index point = numbers.find(number);
    if (point == k_none) in.fail(place, fmt::format("unknown node {}", number), "a node of $Nodes");
    if (last_use[at(point)] == element_count) {
      in.fail(
          place, fmt::format("node {} twice in one element", number),
          fmt::format("{} different nodes ({} of order {})", count, name(type.shape), type.order));
    }
    last_use[at(point)] = element_count;
    nodes[base + at(file2canonical[n])] = point;
  }
  if (element_count == std::numeric_limits<Index>::max()) {
    in.fail(in.offset(), "more than 2147483647 elements", "a mesh that one process can index");
  }
  ++element_count;
}

ElementType ReaderState::read_type() {
  const std::size_t place = in.next();
  const std::int64_t number = in.int_value("an element type");
  if (const auto type = element_type(number)) return *type;
  const Refusal refusal = explain_type(number);
  throw FileError(fmt::format("found {}, expected complete elements of order 1 to {}",
                              refusal.found, k_max_order),
                  in.where(place), refusal.remedy);
}

int ReaderState::read_dimension(const char* expected) {
  const std::size_t place = in.next();
  const std::int64_t dim = in.int_value(expected);
  if (dim < 0 || dim > 3)
    in.fail(place, std::to_string(dim), std::string(expected) + " from 0 to 3");
  return static_cast<int>(dim);
}

}  // namespace camber::io::gmsh
