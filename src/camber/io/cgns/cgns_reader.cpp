#include <camber/base/error.hpp>
#include <camber/io/cgns/cgns_reader.hpp>
#include <camber/io/cgns/detail/cgns_types.hpp>
#include <camber/io/cgns/detail/zone_join.hpp>
#include <camber/io/cgns/detail/zone_reader.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/detail/named_mesh.hpp>

#include <fmt/format.h>

namespace camber::io {
namespace cgns {
namespace {

/// The first base with cells of dimension 3.
int find_base(const File& file) {
  int bases = 0;
  file.require(cg_nbases(file.number(), &bases), "cannot be read");
  for (int base = 1; base <= bases; ++base) {
    char name[k_name_room] = {};
    int cell_dimension = 0, physical_dimension = 0;
    file.require(cg_base_read(file.number(), base, name, &cell_dimension, &physical_dimension),
                 "cannot be read");
    if (cell_dimension == 3 && physical_dimension == 3) return base;
  }
  throw FileError("found no CGNS base with volume cells in three dimensions", file.display(),
                  "export the volume mesh");
}

MeshData read(const std::string& path) {
  const ReadableFile readable(path);
  const File file(readable.short_name(), CG_MODE_READ, path);
  const int base = find_base(file);
  int zones = 0;
  file.require(cg_nzones(file.number(), base, &zones), "cannot be read");
  NamedMeshBuilder builder(path);
  std::vector<Zone> all;
  for (int zone = 1; zone <= zones; ++zone) all.push_back(read_zone(file, base, zone, builder));
  std::vector<std::pair<Index, Index>> pairs;
  for (const Zone& zone : all) add_connections(file, base, zone, all, pairs);
  join_nodes(builder.mesh(), pairs);
  MeshData mesh = builder.finish();
  if (mesh.blocks.empty()) {
    throw FileError("found no elements in the CGNS base", path, "export the volume mesh");
  }
  return mesh;
}

}  // namespace
}  // namespace cgns

MeshData read_cgns(const std::string& path) {
  require_regular_file(path);
  const std::lock_guard lock(cgns::library_mutex());
  return cgns::read(path);
}

}  // namespace camber::io
