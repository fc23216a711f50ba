// Sections of version 4.1.
#include <camber/io/gmsh/reader_state.hpp>

#include <array>
#include <limits>

#include <fmt/format.h>

namespace camber::io::gmsh {
namespace {

// Least bytes that one item takes, with single-digit numbers and one blank each in text.
constexpr std::size_t k_point_entity_text = 10, k_point_entity_binary = 36;
constexpr std::size_t k_entity_text = 16, k_entity_binary = 60;
constexpr std::size_t k_tag_text = 2, k_tag_binary = 4;
constexpr std::size_t k_block_text = 8, k_block_binary = 20;
constexpr std::size_t k_v4_node_text = 8, k_v4_node_binary = 32;
constexpr std::size_t k_v4_number_text = 2, k_v4_number_binary = 8;

std::size_t read_count(Cursor& in, std::size_t text_bytes, std::size_t binary_bytes,
                       const char* expected) {
  const std::size_t place = in.next();
  const std::int64_t count = in.size_value(expected);
  return in.checked_count(count, place, text_bytes, binary_bytes, expected);
}

EntityRecord read_entity(Cursor& in, int dim) {
  EntityRecord entity;
  entity.key = {dim, in.tag("an entity tag")};
  for (int corner = 0; corner < (dim == 0 ? 1 : 2); ++corner) {
    Vec3& x = corner == 0 ? entity.box.lower : entity.box.upper;
    for (int c = 0; c < 3; ++c) x[c] = in.real("a finite coordinate of an entity");
  }
  if (dim == 0) entity.box.upper = entity.box.lower;
  const std::size_t groups =
      read_count(in, k_tag_text, k_tag_binary, "the number of physical groups of an entity");
  for (std::size_t i = 0; i < groups; ++i) {
    entity.physical_tags.push_back(in.tag("the tag of a physical group"));
  }
  if (dim == 0) return entity;
  const std::size_t bounds =
      read_count(in, k_tag_text, k_tag_binary, "the number of bounding entities");
  for (std::size_t i = 0; i < bounds; ++i) static_cast<void>(in.tag("a bounding entity"));
  return entity;
}

/// Header of $Nodes and $Elements: blocks, items, lowest and highest number (of no use here).
struct Totals {
  std::size_t blocks = 0, items = 0, items_place = 0;
};

Totals read_totals(Cursor& in, std::size_t item_text, std::size_t item_binary, const char* items) {
  Totals totals;
  totals.blocks = read_count(in, k_block_text, k_block_binary, "the number of blocks");
  totals.items_place = in.next();
  totals.items = read_count(in, item_text, item_binary, items);
  static_cast<void>(in.size_value("the lowest number"));
  static_cast<void>(in.size_value("the highest number"));
  return totals;
}

void read_node_block(ReaderState& state) {
  Cursor& in = state.in;
  MeshData& mesh = state.mesh;
  const int dim = state.read_dimension("the dimension of a node block");
  const int tag = in.tag("the entity tag of a node block");
  const std::size_t flag_place = in.next();
  const std::int64_t parametric = in.int_value("0 or 1 (parametric)");
  if (parametric != 0 && parametric != 1) {
    in.fail(flag_place, std::to_string(parametric), "0 or 1 (parametric)");
  }
  const std::size_t count = read_count(in, k_v4_node_text, k_v4_node_binary, "the number of nodes");
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = in.next();
    state.add_number(in.size_value("a node number"), place);
  }
  if (parametric == 1 && mesh.point_parameters.empty()) {
    mesh.point_parameters.assign(mesh.points.size(),
                                 Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  for (std::size_t i = 0; i < count; ++i) {
    state.add_coordinates();
    mesh.point_entity.push_back({dim, tag});
    std::array<double, 3> uvw{0.0, 0.0, 0.0};
    for (int c = 0; parametric == 1 && c < dim; ++c) {
      uvw[static_cast<std::size_t>(c)] = in.real("a finite parameter of a node");
    }
    if (parametric == 1 && (dim == 1 || dim == 2)) {
      mesh.point_parameters.emplace_back(uvw[0], uvw[1]);
    } else if (!mesh.point_parameters.empty()) {
      mesh.point_parameters.emplace_back(Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
  }
}

void read_element_block(ReaderState& state) {
  Cursor& in = state.in;
  const std::size_t place = in.next();
  const int dim = state.read_dimension("the dimension of an element block");
  ElementBlock block;
  block.entity = in.tag("the entity tag of an element block");
  const ElementType type = state.read_type();
  if (dimension(type.shape) != dim) {
    in.fail(place,
            fmt::format("elements of shape {} on an entity of dimension {}", name(type.shape), dim),
            fmt::format("an entity of dimension {}", dimension(type.shape)));
  }
  block.shape = type.shape;
  block.order = type.order;
  const auto nodes = static_cast<std::size_t>(type.node_count);
  const std::size_t count = read_count(in, k_v4_number_text * (1 + nodes),
                                       k_v4_number_binary * (1 + nodes), "the number of elements");
  if (count == 0) return;
  const std::span<const int> order = gmsh_to_canonical(type.shape, type.order);
  block.tags.reserve(count);
  block.nodes.reserve(count * nodes);
  for (std::size_t i = 0; i < count; ++i) {
    block.tags.push_back(state.read_element_number(true));
    state.add_element_nodes(type, order, true, block.nodes);
  }
  state.mesh.blocks.push_back(std::move(block));
}

}  // namespace

void read_entities_v4(ReaderState& state) {
  Cursor& in = state.in;
  std::array<std::size_t, 4> counts{};
  for (std::size_t dim = 0; dim < 4; ++dim) {
    counts[dim] =
        read_count(in, dim == 0 ? k_point_entity_text : k_entity_text,
                   dim == 0 ? k_point_entity_binary : k_entity_binary, "the number of entities");
  }
  for (int dim = 0; dim < 4; ++dim) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dim)]; ++i) {
      state.mesh.entities.push_back(read_entity(in, dim));
    }
  }
}

void read_nodes_v4(ReaderState& state) {
  Cursor& in = state.in;
  const Totals totals = read_totals(in, k_v4_node_text, k_v4_node_binary, "the number of nodes");
  state.mesh.points.reserve(totals.items);
  state.mesh.point_tags.reserve(totals.items);
  for (std::size_t b = 0; b < totals.blocks; ++b) read_node_block(state);
  if (state.mesh.points.size() != totals.items) {
    in.fail(totals.items_place, fmt::format("a total of {} nodes", totals.items),
            fmt::format("{} as in the blocks that follow", state.mesh.points.size()));
  }
  state.finish_nodes();
}

void read_elements_v4(ReaderState& state) {
  Cursor& in = state.in;
  const Totals totals =
      read_totals(in, 2 * k_v4_number_text, 2 * k_v4_number_binary, "the number of elements");
  for (std::size_t b = 0; b < totals.blocks; ++b) read_element_block(state);
  if (static_cast<std::size_t>(state.element_count) != totals.items) {
    in.fail(totals.items_place, fmt::format("a total of {} elements", totals.items),
            fmt::format("{} as in the blocks that follow", state.element_count));
  }
}

}  // namespace camber::io::gmsh
