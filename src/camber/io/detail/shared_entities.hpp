#pragma once
// Edges and faces of a mesh of one order, each once, for formats that list them.
#include <camber/base/by_key.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <array>
#include <string>
#include <unordered_map>
#include <vector>

namespace camber::io {

struct SharedEdge {
  std::array<Index, 2> v{};  // from the lower to the higher number
  Points points;             // order + 1, along it
};
struct SharedFace {
  Shape shape = Shape::triangle;
  std::array<Index, 4> v{k_none, k_none, k_none, k_none};      // its frame, see below
  Points points;                                               // lattice points in that frame
  std::array<Index, 4> edges{k_none, k_none, k_none, k_none};  // joins corners i and i + 1
};

/// Numbered in the order in which the cells of the mesh name them first. The frame of a triangle is
/// its corners from the lowest number to the highest; that of a quadrilateral starts at the lowest
/// and goes round towards the lower of its two neighbours.
class SharedEntities {
 public:
  /// @param number  point -> number of the vertex, for all corners of cells
  /// @throws FileError if elements are of different orders, neighbours make different shapes of
  ///         what they share, or a surface element is no face of any cell
  SharedEntities(const MeshData& mesh, const std::vector<Index>& number, std::string display);

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] const std::vector<SharedEdge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<SharedFace>& faces() const { return faces_; }
  /// By the numbers of the corners, in any order; k_none if there is none.
  [[nodiscard]] Index edge(Index a, Index b) const;
  [[nodiscard]] Index face(const std::vector<Index>& corners) const;

 private:
  void take(const MeshData& mesh, const ElementBlock& block, const std::vector<Index>& number);
  void take_edge(std::array<Index, 2> v, Points points, bool is_cell);
  void take_face(Shape shape, const std::vector<Index>& v, const Points& points, bool is_cell);
  void require_same(const Points& a, const Points& b, const char* what) const;

  std::string display_;
  int order_ = 0;
  double tolerance_ = 0.0;  // of the current element [length]
  std::vector<SharedEdge> edges_;
  std::vector<SharedFace> faces_;
  std::unordered_map<CornerKey, Index, CornerKeyHash> edge_of_, face_of_;
};

}  // namespace camber::io
