#pragma once
// Meshes of formats that know patches by name only (CGNS, SU2, UGRID): no CAD tags, no numbers.
#include <camber/mesh/mesh_data.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace camber::io {

/// Collects what such a file holds. Every name gets an entity of its own: tags 1, 2, ... a
/// dimension in the order of first use, one physical group of the same tag and name.
class NamedMeshBuilder {
 public:
  /// A file with more has a number for each element, which is no patch; and entities take far more
  /// memory than their elements do in the file.
  static constexpr std::size_t k_most_entities = 65536;

  explicit NamedMeshBuilder(std::string source) { mesh_.source = std::move(source); }

  [[nodiscard]] Points& points() { return mesh_.points; }
  /// What was collected so far.
  [[nodiscard]] MeshData& mesh() { return mesh_; }
  [[nodiscard]] const MeshData& mesh() const { return mesh_; }
  /// Tag of the entity of that name. @throws FileError if there are too many
  [[nodiscard]] int entity(int dim, const std::string& name);
  /// The same with a tag of the caller's, for entities that none has yet.
  int entity(int dim, const std::string& name, int tag);
  /// Puts the entity into a further group, such as the family of a boundary condition.
  void add_to_group(int dim, int entity, const std::string& group);
  /// Appends an element with its nodes in canonical order.
  void add(Shape shape, int order, int entity, std::span<const Index> nodes);
  /// Entities without elements are dropped; nodes are classified on the lowest entity of their
  /// elements, boxes are those of the nodes.
  [[nodiscard]] MeshData finish();

 private:
  MeshData mesh_;
  std::map<std::pair<int, std::string>, int> entity_, group_;
  std::map<std::tuple<int, int, Shape, int>, std::size_t> block_;
  std::map<EntityKey, std::size_t> record_;  // index into mesh_.entities
  std::map<int, int> last_entity_, last_group_;
};

/// What a format with names can carry of a mesh.
struct NamedMesh {
  MeshData mesh;  // volumes, then surfaces; one block for each name, shape and order
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>>
      origin;  // [block][element] -> block and element of the source
  std::map<EntityKey, std::vector<int>> source_tags;  // entities that were joined under the name
};

struct NameRules {
  std::size_t longest = 255;
  std::string_view forbidden = {};  // these become '_', as do control characters
  bool keeps_volumes = true;        // false: all volume elements belong to one "volume"
};

/// Joins entities of the same name; entities without a name are "surface 7" and the like. Points
/// stay, elements of dimension 0 and 1 go.
[[nodiscard]] NamedMesh by_names(const MeshData& mesh, const NameRules& rules);

/// `name` cut to the length, made different from those in `used`, and noted there.
[[nodiscard]] std::string unique_name(const std::string& name, const NameRules& rules,
                                      std::vector<std::string>& used);

/// The source mesh with points and nodes as they were read back from the file.
/// @throws FileError if `read` does not hold the elements of `named`
[[nodiscard]] MeshData relabel(const MeshData& source, const NamedMesh& named,
                               const MeshData& read);

}  // namespace camber::io
