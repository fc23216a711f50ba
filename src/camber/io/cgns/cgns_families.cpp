#include <camber/io/cgns/cgns_families.hpp>
#include <camber/io/cgns/detail/cgns_types.hpp>
#include <camber/io/cgns/detail/zone_reader.hpp>
#include <camber/io/detail/input_file.hpp>

#include <map>

namespace camber::io {
namespace cgns {
namespace {

/// The first reference of a family that names entities; without names if there is none.
PatchGeometry reference_of(const File& file, int base, int family, int references) {
  PatchGeometry found;
  for (int reference = 1; reference <= references; ++reference) {
    char name[k_name_room] = {}, system[k_name_room] = {};
    char* path = nullptr;
    int parts = 0;
    file.require(cg_geo_read(file.number(), base, family, reference, name, &path, system, &parts),
                 "a geometry reference cannot be read");
    found.file = path ? path : "";
    cg_free(path);
    for (int part = 1; part <= parts; ++part) {
      char entity[k_name_room] = {};
      file.require(cg_part_read(file.number(), base, family, reference, part, entity),
                   "a geometry entity cannot be read");
      found.names.emplace_back(entity);
    }
    if (!found.names.empty()) return found;
  }
  return {};
}

std::map<std::string, PatchGeometry> read_families(const File& file, int base) {
  std::map<std::string, PatchGeometry> families;
  int count = 0;
  file.require(cg_nfamilies(file.number(), base, &count), "families cannot be read");
  for (int family = 1; family <= count; ++family) {
    char name[k_name_room] = {};
    int conditions = 0, references = 0;
    file.require(cg_family_read(file.number(), base, family, name, &conditions, &references),
                 "a family cannot be read");
    PatchGeometry found = reference_of(file, base, family, references);
    if (found.names.empty()) continue;
    found.patch = found.family = name;
    families.emplace(name, std::move(found));
  }
  return families;
}

void add_base(const File& file, int base, std::map<std::string, PatchGeometry>& patches) {
  const std::map<std::string, PatchGeometry> families = read_families(file, base);
  if (families.empty()) return;
  int zones = 0;
  file.require(cg_nzones(file.number(), base, &zones), "cannot be read");
  for (int zone = 1; zone <= zones; ++zone) {
    int index_dimension = 0;
    file.require(cg_index_dim(file.number(), base, zone, &index_dimension),
                 "a zone cannot be read");
    for (const Condition& condition : read_conditions(file, base, zone, index_dimension)) {
      const auto family = families.find(condition.family);
      if (family == families.end()) continue;
      PatchGeometry patch = family->second;
      patch.patch = condition.name;
      patches.try_emplace(condition.name, std::move(patch));
    }
  }
  for (const auto& [name, family] : families) patches.try_emplace(name, family);
}

}  // namespace
}  // namespace cgns

std::vector<PatchGeometry> read_cgns_geometry(const std::string& path) {
  require_regular_file(path);
  const std::lock_guard lock(cgns::library_mutex());
  const cgns::ReadableFile readable(path);
  const cgns::File file(readable.short_name(), CG_MODE_READ, path);
  int bases = 0;
  file.require(cg_nbases(file.number(), &bases), "cannot be read");
  std::map<std::string, PatchGeometry> patches;
  for (int base = 1; base <= bases; ++base) cgns::add_base(file, base, patches);
  std::vector<PatchGeometry> list;
  for (auto& entry : patches) list.push_back(std::move(entry.second));
  return list;
}

}  // namespace camber::io
