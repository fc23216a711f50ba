// Sections of version 2.2.
#include <camber/io/detail/hash.hpp>
#include <camber/io/gmsh/classification.hpp>
#include <camber/io/gmsh/reader_state.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace camber::io::gmsh {
namespace {

// Least bytes that one item takes; text with single-digit numbers and one blank each.
constexpr std::size_t k_node_text = 8, k_node_binary = 28;
constexpr std::size_t k_number_text = 2, k_number_binary = 4;

/// Count line that precedes the data; its line feed ends where binary data starts.
std::int64_t read_count_line(Cursor& in, const char* expected, std::size_t& place) {
  place = in.next_word();
  const std::int64_t count = in.text_integer(expected);
  in.end_line("the end of the line");
  return count;
}

/// Elements with equal type and tags.
struct Group {
  int physical = 0;
  ElementBlock block;          // entity: the elementary tag as in the file
  std::span<const int> order;  // file2canonical of the type
};

/// Sorts elements into groups as they come.
class Groups {
 public:
  Group& of(const ElementType& type, int physical, int elementary) {
    if (last_ && last_->physical == physical && last_->block.entity == elementary &&
        last_->block.shape == type.shape && last_->block.order == type.order) {
      return *last_;
    }
    const auto [place, is_new] =
        index_.try_emplace({type.shape, type.order, physical, elementary}, groups_.size());
    if (is_new) {
      Group group;
      group.physical = physical;
      group.block.shape = type.shape;
      group.block.order = type.order;
      group.block.entity = elementary;
      group.order = gmsh_to_canonical(type.shape, type.order);
      groups_.push_back(std::move(group));
    }
    last_ = &groups_[place->second];
    return *last_;
  }
  [[nodiscard]] std::vector<Group> take() { return std::move(groups_); }

 private:
  std::vector<Group> groups_;
  std::map<std::tuple<Shape, int, int, int>, std::size_t> index_;
  Group* last_ = nullptr;
};

/// Gives each (dimension, elementary, physical) its entity: the elementary tag for the first group
/// of it; a further group with other elements gets the tag of the group, or else the next free one.
class EntityTags {
 public:
  explicit EntityTags(const std::vector<Group>& groups) {
    for (const Group& g : groups) used_[at(g)].insert(g.block.entity);
  }
  int of(const Group& g) {
    const std::tuple key(dimension(g.block.shape), g.block.entity, g.physical);
    if (const auto known = tags_.find(key); known != tags_.end()) return known->second;
    int tag = g.block.entity;
    std::set<int>& used = used_[at(g)];
    const bool first = taken_.insert({dimension(g.block.shape), tag}).second;
    if (!first || (tag == 0 && g.physical > 0)) {
      tag = g.physical;
      if (tag <= 0 || used.contains(tag)) {
        int& candidate = candidate_[at(g)];
        while (used.contains(++candidate)) {
        }
        tag = candidate;
      }
      used.insert(tag);
    }
    return tags_[key] = tag;
  }

 private:
  static int at(const Group& g) { return dimension(g.block.shape); }

  std::map<int, std::set<int>> used_;  // by dimension
  std::map<int, int> candidate_;       // tags up to here are used
  std::set<std::pair<int, int>> taken_;
  std::map<std::tuple<int, int, int>, int> tags_;
};

std::uint64_t hash(const std::vector<Index>& nodes) {
  return fnv1a({reinterpret_cast<const char*>(nodes.data()), nodes.size() * sizeof(Index)});
}

/// Groups -> blocks and entities. A group whose elements repeat those of an earlier group of the
/// same elementary tag only adds a physical group.
void store(ReaderState& state, std::vector<Group> groups) {
  MeshData& mesh = state.mesh;
  EntityTags entity_tags(groups);
  std::map<EntityKey, std::vector<int>> physicals;
  // By type, elementary tag and hash of the nodes -> mesh.blocks.
  std::map<std::tuple<Shape, int, int, std::uint64_t>, std::vector<std::size_t>> kept;
  for (Group& group : groups) {
    const int dim = dimension(group.block.shape);
    std::vector<std::size_t>& earlier =
        kept[{group.block.shape, group.block.order, group.block.entity, hash(group.block.nodes)}];
    const auto twin = std::find_if(earlier.begin(), earlier.end(), [&](std::size_t b) {
      return mesh.blocks[b].nodes == group.block.nodes;
    });
    int tag = 0;
    if (twin != earlier.end()) {
      tag = mesh.blocks[*twin].entity;
    } else {
      tag = entity_tags.of(group);
      earlier.push_back(mesh.blocks.size());
      group.block.entity = tag;
      mesh.blocks.push_back(std::move(group.block));
    }
    std::vector<int>& of_entity = physicals[{dim, tag}];
    if (group.physical != 0 &&
        std::find(of_entity.begin(), of_entity.end(), group.physical) == of_entity.end()) {
      of_entity.push_back(group.physical);
    }
  }
  for (const auto& [key, tags] : physicals) {
    EntityRecord record;
    record.key = key;
    record.physical_tags = tags;
    mesh.entities.push_back(std::move(record));
  }
}

/// Classifies nodes that the file left open on the lowest entity of the elements that use them.
void classify_nodes(MeshData& mesh) {
  mesh.point_entity.resize(mesh.points.size());
  const std::vector<EntityKey> lowest = lowest_entities(mesh);
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    if (mesh.point_entity[i].dim < 0) mesh.point_entity[i] = lowest[i];
  }
}

/// Tags and nodes of one element whose type and number of tags are known.
void read_element(ReaderState& state, Groups& groups, const ElementType& type,
                  std::int64_t tag_count, GlobalId number) {
  Cursor& in = state.in;
  int physical = 0;
  int elementary = 0;
  for (std::int64_t t = 0; t < tag_count; ++t) {
    const int tag = in.tag("a tag of an element");
    if (t == 0) physical = tag;
    if (t == 1) elementary = tag;
  }
  Group& group = groups.of(type, physical, elementary);
  group.block.tags.push_back(number);
  state.add_element_nodes(type, group.order, false, group.block.nodes);
}

std::int64_t read_tag_count(Cursor& in) {
  const std::size_t place = in.next();
  const std::int64_t count = in.int_value("the number of tags");
  return static_cast<std::int64_t>(
      in.checked_count(count, place, k_number_text, k_number_binary, "the number of tags"));
}

void read_binary_elements(ReaderState& state, Groups& groups, std::size_t total) {
  Cursor& in = state.in;
  for (std::size_t done = 0; done < total;) {
    const ElementType type = state.read_type();
    const std::size_t place = in.offset();
    const std::int64_t following = in.int_value("the number of elements that follow");
    if (following < 1 || static_cast<std::uint64_t>(following) > total - done) {
      in.fail(place, std::to_string(following),
              fmt::format("1 to {} elements that follow", total - done));
    }
    const std::int64_t tags = read_tag_count(in);
    for (std::int64_t i = 0; i < following; ++i) {
      const GlobalId number = state.read_element_number(false);
      read_element(state, groups, type, tags, number);
    }
    done += static_cast<std::size_t>(following);
  }
}

}  // namespace

void read_nodes_v2(ReaderState& state, bool parametric) {
  Cursor& in = state.in;
  MeshData& mesh = state.mesh;
  std::size_t place = 0;
  const std::int64_t stated = read_count_line(in, "the number of nodes", place);
  const std::size_t count =
      in.checked_count(stated, place, k_node_text, k_node_binary, "the number of nodes");
  mesh.points.reserve(count);
  mesh.point_tags.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    place = in.next();
    state.add_number(in.int_value("a node number"), place);
    state.add_coordinates();
    if (!parametric) continue;
    const int dim = state.read_dimension("the dimension of the node's entity");
    mesh.point_entity.push_back({dim, in.tag("the tag of the node's entity")});
    Vec2 uv = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    if (dim == 1 || dim == 2) {
      uv.x() = in.real("a finite parameter of a node");
      uv.y() = dim == 2 ? in.real("a finite parameter of a node") : 0.0;
    }
    mesh.point_parameters.push_back(uv);
  }
  state.finish_nodes();
}

void read_elements_v2(ReaderState& state) {
  Cursor& in = state.in;
  std::size_t place = 0;
  const std::int64_t stated = read_count_line(in, "the number of elements", place);
  // A point in text has at least number, type, number of tags and node.
  const std::size_t count = in.checked_count(stated, place, 4 * k_number_text, 2 * k_number_binary,
                                             "the number of elements");
  Groups groups;
  if (in.is_binary()) {
    read_binary_elements(state, groups, count);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      const GlobalId number = state.read_element_number(false);
      const ElementType type = state.read_type();
      const std::int64_t tags = read_tag_count(in);
      read_element(state, groups, type, tags, number);
    }
  }
  store(state, groups.take());
  classify_nodes(state.mesh);
}

}  // namespace camber::io::gmsh
