#include <camber/base/error.hpp>
#include <camber/basis/node_order.hpp>
#include <camber/io/cgns/cgns_writer.hpp>
#include <camber/io/cgns/detail/cgns_types.hpp>
#include <camber/io/detail/mesh_check.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <limits>
#include <map>

#include <fmt/format.h>

namespace camber::io {
namespace cgns {
namespace {

/// Room in a section's name for "_PYRA_55" and the like and for a number that makes it unique.
constexpr std::size_t k_type_room = 9, k_number_room = 4;

std::string format_of_cad(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (extension == ".STP" || extension == ".STEP") return "STEP";
  if (extension == ".IGS" || extension == ".IGES") return "IGES";
  return extension.empty() ? "unknown" : extension.substr(1, k_longest_name);
}

class Writer {
 public:
  Writer(const NamedMesh& named, const std::string& path, const std::string& geometry,
         const std::string& display)
      : named_(named),
        mesh_(named.mesh),
        geometry_(geometry),
        file_(path, CG_MODE_WRITE, display) {}

  void run() {
    file_.require(cg_base_write(file_.number(), "Base", 3, 3, &base_), "cannot be written");
    write_zone();
    write_coordinates();
    for (const ElementBlock& block : mesh_.blocks) write_section(block);
    for (const auto& [tag, range] : patch_range_) write_patch(tag, range);
    file_.close();
  }

 private:
  [[nodiscard]] const std::string& name_of(EntityKey key) const {
    return std::find_if(mesh_.entities.begin(), mesh_.entities.end(),
                        [&](const EntityRecord& e) { return e.key == key; })
        ->name;
  }

  void write_zone() {
    std::size_t cells = 0, elements = 0, volumes = 0;
    for (const ElementBlock& b : mesh_.blocks) {
      elements += b.size();
      if (dimension(b.shape) == 3) cells += b.size();
    }
    for (const EntityRecord& e : mesh_.entities) volumes += e.key.dim == 3 ? 1 : 0;
    const auto most = static_cast<std::size_t>(std::numeric_limits<cgsize_t>::max());
    if (std::max(mesh_.points.size(), elements) > most) {
      throw FileError("the mesh has more nodes or elements than this CGNS library can count",
                      file_.display(), "use a library built for 64 bits, or write .msh");
    }
    const std::array<cgsize_t, 3> size{static_cast<cgsize_t>(mesh_.points.size()),
                                       static_cast<cgsize_t>(cells), 0};
    const std::string name = volumes == 1 ? name_of({3, 1}) : "Zone";
    file_.require(cg_zone_write(file_.number(), base_, name.c_str(), size.data(),
                                CGNS_ENUMV(Unstructured), &zone_),
                  "cannot be written");
  }

  void write_coordinates() {
    constexpr std::array<const char*, 3> k_names{"CoordinateX", "CoordinateY", "CoordinateZ"};
    std::vector<double> x(mesh_.points.size());
    for (int d = 0; d < 3; ++d) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = mesh_.points[i][d];
      int coordinate = 0;
      file_.require(cg_coord_write(file_.number(), base_, zone_, CGNS_ENUMV(RealDouble),
                                   k_names[static_cast<std::size_t>(d)], x.data(), &coordinate),
                    "cannot be written");
    }
  }

  void write_section(const ElementBlock& block) {
    const auto type = cgns_type(block.shape, block.order);
    const EntityKey key{dimension(block.shape), block.entity};
    NameRules rules = cgns_name_rules();
    const std::string stem = name_of(key).substr(0, k_longest_name - k_type_room - k_number_room);
    const std::string name =
        unique_name(stem + "_" + cg_ElementTypeName(type), rules, section_names_);
    const std::span<const int> order =
        file_to_canonical(NodeConvention::cgns, block.shape, block.order);
    if (block.nodes.size() > static_cast<std::size_t>(std::numeric_limits<cgsize_t>::max())) {
      throw FileError("a section has more entries than this CGNS library can count",
                      file_.display(), "use a library built for 64 bits, or write .msh");
    }
    std::vector<cgsize_t> nodes(block.nodes.size());
    for (std::size_t e = 0; e < block.nodes.size(); e += order.size()) {
      for (std::size_t n = 0; n < order.size(); ++n) {
        nodes[e + n] =
            static_cast<cgsize_t>(block.nodes[e + static_cast<std::size_t>(order[n])] + 1);
      }
    }
    const cgsize_t first = next_, last = next_ + static_cast<cgsize_t>(block.size()) - 1;
    int section = 0;
    file_.require(cg_section_write(file_.number(), base_, zone_, name.c_str(), type, first, last, 0,
                                   nodes.data(), &section),
                  "cannot be written");
    if (key.dim == 3) {
      file_.require(cg_goto(file_.number(), base_, "Zone_t", zone_, "Elements_t", section, "end"),
                    "cannot be written");
      file_.require(cg_descriptor_write("Region", name_of(key).c_str()), "cannot be written");
    } else {
      const auto place = patch_range_.try_emplace(block.entity, first, last).first;
      place->second.second = last;
    }
    next_ = last + 1;
  }

  void write_patch(int tag, const std::pair<cgsize_t, cgsize_t>& range) {
    const std::string& name = name_of({2, tag});
    const std::array<cgsize_t, 2> points{range.first, range.second};
    const int file = file_.number();
    int condition = 0, family = 0, family_condition = 0;
    file_.require(cg_boco_write(file, base_, zone_, name.c_str(), CGNS_ENUMV(FamilySpecified),
                                CGNS_ENUMV(PointRange), 2, points.data(), &condition),
                  "cannot be written");
    file_.require(cg_boco_gridlocation_write(file, base_, zone_, condition, CGNS_ENUMV(FaceCenter)),
                  "cannot be written");
    file_.require(cg_goto(file, base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", condition, "end"),
                  "cannot be written");
    file_.require(cg_famname_write(name.c_str()), "cannot be written");
    file_.require(cg_family_write(file, base_, name.c_str(), &family), "cannot be written");
    file_.require(cg_fambc_write(file, base_, family, "FamBC", CGNS_ENUMV(BCTypeUserDefined),
                                 &family_condition),
                  "cannot be written");
    if (geometry_.empty()) return;
    int geometry = 0;
    file_.require(cg_geo_write(file, base_, family, "Geometry", geometry_.c_str(),
                               format_of_cad(geometry_).c_str(), &geometry),
                  "cannot be written");
    for (const int face : named_.source_tags.at({2, tag})) {
      int part = 0;
      file_.require(
          cg_part_write(file, base_, family, geometry, fmt::format("face_{}", face).c_str(), &part),
          "cannot be written");
    }
  }

  const NamedMesh& named_;
  const MeshData& mesh_;
  const std::string& geometry_;
  File file_;
  int base_ = 0, zone_ = 0;
  cgsize_t next_ = 1;
  std::vector<std::string> section_names_;
  std::map<int, std::pair<cgsize_t, cgsize_t>> patch_range_;  // blocks of a patch follow each other
};

}  // namespace
}  // namespace cgns

NameRules cgns_name_rules() { return {.longest = cgns::k_longest_name, .forbidden = "/"}; }

void write_cgns(const NamedMesh& named, const std::string& path, const std::string& geometry,
                const std::string& display) {
  check_mesh(named.mesh, display);
  const std::lock_guard lock(cgns::library_mutex());
  if (cg_set_file_type(CG_FILE_HDF5) != CG_OK) {
    throw FileError("this CGNS library cannot write HDF5", display, "install one that can");
  }
  cgns::Writer(named, path, geometry, display).run();
}

}  // namespace camber::io
