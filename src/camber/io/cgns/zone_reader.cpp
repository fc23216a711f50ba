#include <camber/base/error.hpp>
#include <camber/io/cgns/detail/zone_reader.hpp>

#include <limits>

#include <fmt/format.h>

namespace camber::io::cgns {
namespace {

void read_coordinates(const File& file, int base, const Zone& zone,
                      const std::array<cgsize_t, 3>& last, Points& points) {
  constexpr std::array<const char*, 3> k_names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  const std::array<cgsize_t, 3> first{1, 1, 1};
  std::vector<double> x(static_cast<std::size_t>(zone.point_count));
  points.resize(points.size() + x.size());
  for (int d = 0; d < 3; ++d) {
    file.require(
        cg_coord_read(file.number(), base, zone.number, k_names[static_cast<std::size_t>(d)],
                      CGNS_ENUMV(RealDouble), first.data(), last.data(), x.data()),
        fmt::format("the coordinates of zone '{}' cannot be read", zone.name));
    for (std::size_t i = 0; i < x.size(); ++i) points[at(zone.first_point) + i][d] = x[i];
  }
  for (std::size_t i = at(zone.first_point); i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    throw FileError(fmt::format("node {} of zone '{}' has a coordinate that is not finite",
                                i - at(zone.first_point) + 1, zone.name),
                    file.display(), "the file is damaged: save it again");
  }
}

}  // namespace

Zone read_zone(const File& file, int base, int number, NamedMeshBuilder& builder) {
  Zone zone;
  zone.number = number;
  auto type = CGNS_ENUMV(ZoneTypeNull);
  file.require(cg_zone_type(file.number(), base, number, &type), "a zone cannot be read");
  char name[k_name_room] = {};
  std::array<cgsize_t, 9> size{};
  file.require(cg_zone_read(file.number(), base, number, name, size.data()),
               "a zone cannot be read");
  zone.name = name;
  zone.is_structured = type == CGNS_ENUMV(Structured);
  if (!zone.is_structured && type != CGNS_ENUMV(Unstructured)) {
    throw FileError(fmt::format("zone '{}' is neither structured nor unstructured", zone.name),
                    file.display(), "save the mesh again");
  }
  zone.first_point = static_cast<Index>(builder.points().size());
  std::array<cgsize_t, 3> last{size[0], 1, 1};
  if (zone.is_structured) last = {size[0], size[1], size[2]};
  std::uint64_t total = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    // A zone without nodes means nothing; the product is checked before anything is allocated.
    const std::uint64_t most = static_cast<std::uint64_t>(std::numeric_limits<Index>::max());
    const bool fits = last[d] > 0 && static_cast<std::uint64_t>(last[d]) <= most / total;
    if (!fits || total * static_cast<std::uint64_t>(last[d]) + builder.points().size() > most) {
      throw FileError(fmt::format("zone '{}' has an impossible number of nodes", zone.name),
                      file.display(), "the file is damaged: save it again");
    }
    total *= static_cast<std::uint64_t>(last[d]);
    zone.points_along[d] = static_cast<Index>(last[d]);
  }
  zone.point_count = static_cast<Index>(total);
  read_coordinates(file, base, zone, last, builder.points());
  if (zone.is_structured) {
    make_hexes(file, base, zone, builder);
  } else {
    read_sections(file, base, zone, builder);
  }
  return zone;
}

std::vector<Condition> read_conditions(const File& file, int base, int zone, int index_dimension) {
  int count = 0;
  file.require(cg_nbocos(file.number(), base, zone, &count), "boundary conditions cannot be read");
  std::vector<Condition> conditions;
  for (int c = 1; c <= count; ++c) {
    char name[k_name_room] = {};
    auto type = CGNS_ENUMV(BCTypeNull);
    auto set = CGNS_ENUMV(PointSetTypeNull);
    auto normal_type = CGNS_ENUMV(DataTypeNull);
    auto location = CGNS_ENUMV(Vertex);
    cgsize_t points = 0, normals = 0;
    int normal_index[3] = {}, data_sets = 0;
    file.require(cg_boco_info(file.number(), base, zone, c, name, &type, &set, &points,
                              normal_index, &normals, &normal_type, &data_sets),
                 "a boundary condition cannot be read");
    Condition condition;
    condition.name = name;
    const bool is_list = set == CGNS_ENUMV(PointList) || set == CGNS_ENUMV(ElementList);
    condition.is_range = set == CGNS_ENUMV(PointRange) || set == CGNS_ENUMV(ElementRange);
    if ((!is_list && !condition.is_range) || points < 1 || (condition.is_range && points != 2)) {
      continue;  // names no faces
    }
    file.require(cg_boco_gridlocation_read(file.number(), base, zone, c, &location),
                 "a boundary condition cannot be read");
    condition.is_vertex = location == CGNS_ENUMV(Vertex) && set != CGNS_ENUMV(ElementList) &&
                          set != CGNS_ENUMV(ElementRange);
    condition.points.resize(static_cast<std::size_t>(points) *
                            static_cast<std::size_t>(index_dimension));
    file.require(cg_boco_read(file.number(), base, zone, c, condition.points.data(), nullptr),
                 "a boundary condition cannot be read");
    char family[k_name_room * 20] = {};  // families of families are paths
    const bool is_there =
        cg_goto(file.number(), base, "Zone_t", zone, "ZoneBC_t", 1, "BC_t", c, "end") == CG_OK &&
        cg_famname_read(family) == CG_OK;
    if (is_there) condition.family = family;
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

}  // namespace camber::io::cgns
