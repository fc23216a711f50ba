#pragma once
// What is in a mesh file, format-neutral: readers give it, writers take it. Elements may be curved
// and of different orders. No topology, no CAD, no decisions.
#include <camber/base/ids.hpp>
#include <camber/base/vec.hpp>
#include <camber/basis/lattice.hpp>

#include <string>
#include <vector>

namespace camber {

/// A geometric or discrete entity that nodes and elements are classified on (Gmsh's dim and tag).
struct EntityKey {
  int dim = -1;  // 0 vertex, 1 curve, 2 surface, 3 volume, -1 unknown
  int tag = 0;
  friend bool operator==(const EntityKey&, const EntityKey&) = default;
  friend auto operator<=>(const EntityKey&, const EntityKey&) = default;
};

/// Elements of one shape, one order and one entity.
struct ElementBlock {
  Shape shape = Shape::point;
  int order = 1;
  int entity = 0;              // tag of the entity of dimension(shape)
  std::vector<Index> nodes;    // element after element, node_count(shape, order) each, CANONICAL
                               // lattice order (node_order.hpp), indices into MeshData::points
  std::vector<GlobalId> tags;  // element numbers of the file; may be empty

  [[nodiscard]] std::size_t size() const {
    return nodes.size() /
           static_cast<std::size_t>(shape == Shape::point ? 1 : node_count(shape, order));
  }
};

struct EntityRecord {
  EntityKey key;
  std::string name;  // first physical name, "" if none
  std::vector<int> physical_tags;
  Box box;  // as stated by the file; may be empty
};

struct PhysicalName {
  int dim = 0;
  int tag = 0;
  std::string name;
};

/// One value per element, over all blocks in order (see element_count), or per point.
struct Field {
  std::string name;
  std::vector<double> values;
};

struct MeshData {
  std::string source;  // path it came from, for messages
  Points points;
  std::vector<GlobalId> point_tags;     // numbers of the file; empty means i + 1
  std::vector<EntityKey> point_entity;  // classification, one per point; may be empty
  std::vector<Vec2> point_parameters;   // (t,0) or (u,v); NaN where absent; may be empty
  std::vector<ElementBlock> blocks;
  std::vector<EntityRecord> entities;
  std::vector<PhysicalName> physical_names;
  std::vector<Field> element_fields;

  [[nodiscard]] std::size_t element_count() const {
    std::size_t n = 0;
    for (const ElementBlock& b : blocks) n += b.size();
    return n;
  }
};

}  // namespace camber
