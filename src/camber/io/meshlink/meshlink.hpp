#pragma once
// MeshLink XML: which CAD entities the faces, edges and points of a mesh belong to, as plain data.
#include <camber/base/ids.hpp>

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace camber::io {

/// One file. Ids count from 1, each kind in a space of its own (attributes; geometry; transforms);
/// 0 means none.
struct MeshLink {
  struct Attribute {
    int id = 0;
    std::string name, text;
  };
  /// Attributes or geometry references under one id.
  struct Group {
    int id = 0;
    std::string name;
    int attributes = 0;
    std::vector<int> members;
  };
  struct Reference {
    int id = 0;
    std::string ref, name;  // name inside the CAD file; name to show
    int attributes = 0;
  };
  struct GeometryFile {
    std::string path;
    int attributes = 0;
    std::vector<Reference> references;
  };
  /// Parameters of a mesh vertex on a CAD entity.
  struct ParamVertex {
    GlobalId vertex = 0;
    int geometry = 0;
    int dimension = 0;  // 1: u; 2: u and v
    double u = 0.0, v = 0.0;
  };
  /// Elements of one kind: corners node numbers each (1 points, 2 edges, 3 or 4 faces), or, if
  /// `is_opaque`, one number each that only the mesh file understands.
  struct Elements {
    int corners = 0;
    bool is_opaque = false;
    int geometry = 0;  // 0: that of the sheet or string
    std::string name;
    int attributes = 0;
    std::vector<GlobalId> numbers;
  };
  /// A sheet of faces, a string of edges.
  struct Part {
    std::string name, ref;
    int geometry = 0, attributes = 0;
    std::vector<ParamVertex> parameters;
    std::vector<Elements> elements;
  };
  struct Model {
    std::string ref, name;
    int geometry = 0, attributes = 0;
    std::vector<Part> sheets, strings;
    std::vector<Elements> points;
    std::vector<ParamVertex> parameters;
  };
  struct MeshFile {
    std::string path;
    int attributes = 0;
    std::vector<Model> models;
  };
  /// Row-vector form: (x y z 1) times the matrix, rows one after the other.
  struct Transform {
    int id = 0;
    std::string name;
    int attributes = 0;
    std::array<double, 16> matrix{};
  };
  /// Two sheets or strings whose elements correspond (periodic pairs).
  struct Linkage {
    std::string source, target, name;
    int transform = 0, attributes = 0;
  };

  std::vector<Attribute> attributes;
  std::vector<Group> attribute_groups, geometry_groups;
  std::vector<GeometryFile> geometry;
  std::vector<MeshFile> meshes;
  std::vector<Transform> transforms;
  std::vector<Linkage> linkages;
};

/// Namespaces are ignored (files in use carry different ones).
/// @throws FileError naming path, line and element: no XML, unknown or missing attributes, numbers
/// that are none, counts that do not fit, references to ids that do not exist, ids given twice.
[[nodiscard]] MeshLink read_meshlink(const std::string& path);

/// The same for the text of such a file. @param path for messages @throws FileError
[[nodiscard]] MeshLink parse_meshlink(const std::string& path, std::string_view text);

/// Replaces `path` in one step. Tri3 and Quad4 faces and Edge2 edges as text.
/// @throws FileError
void write_meshlink(const MeshLink& link, const std::string& path);

/// Geometry of faces, edges and points of one model by their forming nodes, in any order and
/// orientation. The first that names an element wins; faces of two sizes are told apart.
class MeshLinkQuery {
 public:
  explicit MeshLinkQuery(const MeshLink::Model& model);

  /// The id of a geometry reference or group, 0 if there is none. 3 or 4 nodes.
  [[nodiscard]] int face(std::span<const GlobalId> nodes) const;
  /// That of the edge's string, else of a face with that edge.
  [[nodiscard]] int edge(GlobalId a, GlobalId b) const;
  /// That of a string's edge only.
  [[nodiscard]] int string_edge(GlobalId a, GlobalId b) const;
  /// That of a string through the node, else of a sheet, else of a point.
  [[nodiscard]] int point(GlobalId node) const;

 private:
  using Edges = std::map<std::array<GlobalId, 2>, int>;
  std::map<std::array<GlobalId, 4>, int> faces_;
  Edges string_edges_, sheet_edges_;
  std::map<GlobalId, int> points_;
};

}  // namespace camber::io
