// Structured zones, and what connects zones.
#include <camber/base/error.hpp>
#include <camber/io/cgns/detail/zone_reader.hpp>

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace camber::io::cgns {
namespace {

using Ijk = std::array<std::int64_t, 3>;

Ijk moved(Ijk ijk, std::size_t direction, std::int64_t by) {
  ijk[direction] += by;
  return ijk;
}

/// Corner nodes of the quad at `ijk` in the plane across `fixed`, canonical order.
std::array<Index, 4> quad(const Zone& zone, const Ijk& ijk, std::size_t fixed) {
  const std::size_t a = (fixed + 1) % 3, b = (fixed + 2) % 3;
  return {zone.point(ijk), zone.point(moved(ijk, a, 1)), zone.point(moved(ijk, b, 1)),
          zone.point(moved(moved(ijk, a, 1), b, 1))};
}

/// Calls `visit` for each (i, j, k) from `first` to `last`, ends included.
template <class Visit>
void for_each(const Ijk& first, const Ijk& last, const Visit& visit) {
  for (std::int64_t k = first[2]; k <= last[2]; ++k) {
    for (std::int64_t j = first[1]; j <= last[1]; ++j) {
      for (std::int64_t i = first[0]; i <= last[0]; ++i) visit(Ijk{i, j, k});
    }
  }
}

[[noreturn]] void refuse(const File& file, const Zone& zone, const std::string& what) {
  throw FileError(what, fmt::format("{}, zone '{}'", file.display(), zone.name),
                  "the file is damaged: save it again");
}

void add_patch(const File& file, const Zone& zone, const Condition& condition,
               NamedMeshBuilder& builder) {
  if (!condition.is_range) return;  // lists of nodes of a structured zone are not faces
  Ijk first{}, last{};
  for (std::size_t d = 0; d < 3; ++d) {
    first[d] = std::min(condition.points[d], condition.points[d + 3]);
    last[d] = std::max(condition.points[d], condition.points[d + 3]);
  }
  std::size_t fixed = 3;
  for (std::size_t d = 0; d < 3; ++d) {
    if (first[d] == last[d]) fixed = d;
  }
  if (fixed == 3) return;
  if (condition.is_vertex) {  // ranges of nodes reach one further than ranges of faces
    for (std::size_t d = 0; d < 3; ++d) last[d] -= d == fixed ? 0 : 1;
  }
  Ijk furthest = last;
  for (std::size_t d = 0; d < 3; ++d) furthest[d] += d == fixed ? 0 : 1;
  if (!zone.holds(first) || !zone.holds(furthest)) {
    refuse(file, zone, fmt::format("boundary condition '{}' reaches out of it", condition.name));
  }
  const int entity = builder.entity(2, condition.name);
  if (!condition.family.empty()) builder.add_to_group(2, entity, condition.family);
  for_each(first, last, [&](const Ijk& ijk) {
    builder.add(Shape::quadrilateral, 1, entity, quad(zone, ijk, fixed));
  });
}

void add_structured(const File& file, int base, const Zone& zone, const std::vector<Zone>& all,
                    std::vector<std::pair<Index, Index>>& pairs) {
  int count = 0;
  file.require(cg_n1to1(file.number(), base, zone.number, &count), "connections cannot be read");
  for (int c = 1; c <= count; ++c) {
    char name[k_name_room] = {}, donor_name[k_name_room] = {};
    std::array<cgsize_t, 6> range{}, donor_range{};
    std::array<int, 3> transform{};
    file.require(cg_1to1_read(file.number(), base, zone.number, c, name, donor_name, range.data(),
                              donor_range.data(), transform.data()),
                 "a connection cannot be read");
    const auto donor =
        std::find_if(all.begin(), all.end(), [&](const Zone& z) { return z.name == donor_name; });
    Ijk first{}, last{};
    for (std::size_t d = 0; d < 3; ++d) {
      first[d] = std::min(range[d], range[d + 3]);
      last[d] = std::max(range[d], range[d + 3]);
      if (std::abs(transform[d]) > 3 || transform[d] == 0) {
        refuse(file, zone, fmt::format("connection '{}' has no sensible transform", name));
      }
    }
    if (donor == all.end() || !donor->is_structured || !zone.holds(first) || !zone.holds(last)) {
      refuse(file, zone, fmt::format("connection '{}' leads nowhere", name));
    }
    for_each(first, last, [&](const Ijk& ijk) {
      Ijk there{donor_range[0], donor_range[1], donor_range[2]};
      for (std::size_t d = 0; d < 3; ++d) {
        const auto row = static_cast<std::size_t>(std::abs(transform[d]) - 1);
        there[row] += (transform[d] > 0 ? 1 : -1) * (ijk[d] - range[d]);
      }
      if (!donor->holds(there)) {
        refuse(file, zone, fmt::format("connection '{}' reaches out of its donor", name));
      }
      pairs.emplace_back(zone.point(ijk), donor->point(there));
    });
  }
}

void add_unstructured(const File& file, int base, const Zone& zone, const std::vector<Zone>& all,
                      std::vector<std::pair<Index, Index>>& pairs) {
  int count = 0;
  file.require(cg_nconns(file.number(), base, zone.number, &count), "connections cannot be read");
  for (int c = 1; c <= count; ++c) {
    char name[k_name_room] = {}, donor_name[k_name_room] = {};
    auto location = CGNS_ENUMV(Vertex);
    auto type = CGNS_ENUMV(GridConnectivityTypeNull);
    auto set = CGNS_ENUMV(PointSetTypeNull), donor_set = CGNS_ENUMV(PointSetTypeNull);
    auto donor_type = CGNS_ENUMV(ZoneTypeNull);
    auto data_type = CGNS_ENUMV(DataTypeNull);
    cgsize_t points = 0, donor_points = 0;
    file.require(
        cg_conn_info(file.number(), base, zone.number, c, name, &location, &type, &set, &points,
                     donor_name, &donor_type, &donor_set, &data_type, &donor_points),
        "a connection cannot be read");
    const auto donor =
        std::find_if(all.begin(), all.end(), [&](const Zone& z) { return z.name == donor_name; });
    // Pairs of nodes are taken; whatever else (faces, overset) does not tell them.
    if (type != CGNS_ENUMV(Abutting1to1) || location != CGNS_ENUMV(Vertex) ||
        set != CGNS_ENUMV(PointList) || points != donor_points || donor == all.end() ||
        donor->is_structured || donor_type != CGNS_ENUMV(Unstructured)) {
      continue;
    }
    std::vector<cgsize_t> here(static_cast<std::size_t>(points)), there(here.size());
    file.require(
        cg_conn_read(file.number(), base, zone.number, c, here.data(), data_type, there.data()),
        "a connection cannot be read");
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (here[i] < 1 || here[i] > zone.point_count || there[i] < 1 ||
          there[i] > donor->point_count) {
        refuse(file, zone, fmt::format("connection '{}' names nodes that are not there", name));
      }
      pairs.emplace_back(zone.first_point + static_cast<Index>(here[i]) - 1,
                         donor->first_point + static_cast<Index>(there[i]) - 1);
    }
  }
}

}  // namespace

void make_hexes(const File& file, int base, const Zone& zone, NamedMeshBuilder& builder) {
  const int entity = builder.entity(3, zone.name);
  const Ijk last{zone.points_along[0] - 1, zone.points_along[1] - 1, zone.points_along[2] - 1};
  for_each({1, 1, 1}, last, [&](const Ijk& ijk) {
    std::array<Index, 8> nodes{};
    for (std::size_t n = 0; n < 8; ++n) {  // canonical: i fastest
      nodes[n] =
          zone.point({ijk[0] + static_cast<int>(n & 1U), ijk[1] + static_cast<int>(n >> 1U & 1U),
                      ijk[2] + static_cast<int>(n >> 2U)});
    }
    builder.add(Shape::hexahedron, 1, entity, nodes);
  });
  for (const Condition& condition : read_conditions(file, base, zone.number, 3)) {
    add_patch(file, zone, condition, builder);
  }
}

void add_connections(const File& file, int base, const Zone& zone, const std::vector<Zone>& all,
                     std::vector<std::pair<Index, Index>>& pairs) {
  if (zone.is_structured) {
    add_structured(file, base, zone, all, pairs);
  } else {
    add_unstructured(file, base, zone, all, pairs);
  }
}

}  // namespace camber::io::cgns
