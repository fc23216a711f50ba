#pragma once
// One zone of a CGNS base.
#include <camber/io/cgns/detail/cgns_types.hpp>
#include <camber/io/detail/named_mesh.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace camber::io::cgns {

struct Zone {
  int number = 0;
  std::string name;
  bool is_structured = false;
  Index first_point = 0;
  Index point_count = 0;
  std::array<Index, 3> points_along{1, 1, 1};  // structured: nodes in i, j, k

  /// Structured: node at 1-based (i, j, k), which must lie inside.
  [[nodiscard]] Index point(const std::array<std::int64_t, 3>& ijk) const {
    return first_point + static_cast<Index>(ijk[0] - 1) +
           points_along[0] *
               (static_cast<Index>(ijk[1] - 1) + points_along[1] * static_cast<Index>(ijk[2] - 1));
  }
  [[nodiscard]] bool holds(const std::array<std::int64_t, 3>& ijk) const {
    for (std::size_t d = 0; d < 3; ++d) {
      if (ijk[d] < 1 || ijk[d] > points_along[d]) return false;
    }
    return true;
  }
};

/// Reads nodes, cells and boundary of a zone into the builder. @throws FileError
[[nodiscard]] Zone read_zone(const File& file, int base, int number, NamedMeshBuilder& builder);

/// A boundary condition: what it is called and where it is.
struct Condition {
  std::string name, family;
  bool is_range = false, is_vertex = false;
  std::vector<cgsize_t> points;
};
[[nodiscard]] std::vector<Condition> read_conditions(const File& file, int base, int zone,
                                                     int index_dimension);

void read_sections(const File& file, int base, const Zone& zone, NamedMeshBuilder& builder);
void make_hexes(const File& file, int base, const Zone& zone, NamedMeshBuilder& builder);

/// Appends the pairs of nodes that the zone's one-to-one connections name.
void add_connections(const File& file, int base, const Zone& zone, const std::vector<Zone>& all,
                     std::vector<std::pair<Index, Index>>& pairs);

}  // namespace camber::io::cgns
