#pragma once
// Sharp edges, the chains they form, and the smooth regions between them, of a surface mesh.
#include <camber/base/ids.hpp>
#include <camber/base/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace camber {

/// A surface of triangles and quadrilaterals, each walked so that its normal points out of the
/// volume behind it.
struct FacetMesh {
  Points points;
  std::vector<std::array<Index, 4>> facets;  // [3] = -1 for triangles

  [[nodiscard]] std::size_t corner_count(Index f) const {
    return facets[at(f)][3] == k_none ? 3 : 4;
  }
  [[nodiscard]] std::span<const Index> corners(Index f) const {
    return {facets[at(f)].data(), corner_count(f)};
  }
  /// Half the vector area (Newell); its length is the area of a planar facet.
  [[nodiscard]] Vec3 area_vector(Index f) const;
};

struct FeatureOptions {
  /// An edge may be sharp where the normals of its facets differ by more [degrees]. It is for
  /// certain where they differ by more than twice as much; between the two only if the turn is not
  /// spread: if the parallel edges beside it turn by less than half as much. A nose of few facets
  /// is round, a crease between flat parts is sharp.
  double angle = 40.0;
  /// A chain has a corner where it turns by more [degrees].
  double corner_angle = 40.0;
};

struct FacetEdge {
  std::array<Index, 2> vertex;                 // smaller number first
  std::array<Index, 2> facet{k_none, k_none};  // the first two; [1] = -1 on a rim
  bool is_sharp = false;                       // by angle, or not between exactly two facets
};

/// Sharp edges one after the other, between corners or all the way round.
struct Chain {
  std::vector<Index> vertices;  // of a closed chain the first is not repeated
  std::vector<Index> edges;     // edge i joins vertices i and i + 1
  bool is_closed = false;
};

struct Features {
  std::vector<FacetEdge> edges;
  std::vector<std::array<Index, 4>> facet2edge;  // edge i joins corners i and i + 1
  std::vector<int> region;  // facet -> smooth region, from 0 in the order of their first facets
  int region_count = 0;
  std::vector<Chain> chains;
  std::vector<Index> corners;  // vertices, sorted, at which chains begin and end
};

/// Finds them: regions are connected across edges that are not sharp; a vertex is a corner if
/// other than two sharp edges meet there or the two turn by more than corner_angle.
[[nodiscard]] Features find_features(const FacetMesh& mesh, const FeatureOptions& options = {});

}  // namespace camber
