#include <camber/base/error.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/gmsh/reader_state.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

namespace camber::io {
namespace gmsh {
namespace {

constexpr const char* k_convert = "convert it: gmsh FILE -save -format msh41 -o NEW.msh";
constexpr double k_v4 = 4.1, k_v2_first = 2.0, k_v2_last = 2.2;
constexpr double k_version_slack = 1e-6;  // versions are decimal fractions

/// Behind $MeshFormat: version, text or binary, size of a number, byte order. @return 2 or 4
int read_format(Cursor& in) {
  const std::size_t version_place = in.next_word();
  const double version = in.text_real("a version (4.1 or 2.2)");
  const bool is_v4 = std::abs(version - k_v4) < k_version_slack;
  const bool is_v2 =
      version > k_v2_first - k_version_slack && version < k_v2_last + k_version_slack;
  if (!is_v4 && !is_v2) {
    throw FileError(fmt::format("found version {}, expected version 4.1 or 2.2", version),
                    in.where(version_place), k_convert);
  }
  const std::size_t flag_place = in.next_word();
  const std::int64_t flag = in.text_integer("0 (text) or 1 (binary)");
  if (flag != 0 && flag != 1) in.fail(flag_place, std::to_string(flag), "0 (text) or 1 (binary)");
  const std::size_t size_place = in.next_word();
  const std::int64_t size = in.text_integer("a data size of 8");
  if (size != 8) {
    throw FileError(fmt::format("found a data size of {}, expected 8", size), in.where(size_place),
                    k_convert);
  }
  if (flag == 1) {
    in.end_line("the end of the line");
    in.use_binary(false);
    const std::size_t one_place = in.offset();
    const std::int64_t one = in.int_value("the integer 1 in binary");
    if (one == 0x01000000) {
      in.use_binary(true);
    } else if (one != 1) {
      in.fail(one_place, fmt::format("the bytes of the integer {}", one),
              "the integer 1 in binary, as the header says the file is binary");
    }
  }
  return is_v4 ? 4 : 2;
}

/// Behind $PhysicalNames, always text.
void read_physical_names(ReaderState& state) {
  Cursor& in = state.in;
  const std::size_t place = in.next_word();
  const std::int64_t stated = in.text_integer("the number of physical names");
  // At least: dimension, tag, two quotes.
  const std::size_t count = in.checked_count(stated, place, 6, 6, "the number of physical names");
  for (std::size_t i = 0; i < count; ++i) {
    PhysicalName entry;
    const std::size_t dim_place = in.next_word();
    const std::int64_t dim = in.text_integer("the dimension of a physical group");
    if (dim < 0 || dim > 3) in.fail(dim_place, std::to_string(dim), "a dimension from 0 to 3");
    entry.dim = static_cast<int>(dim);
    const std::size_t tag_place = in.next_word();
    const std::int64_t tag = in.text_integer("the tag of a physical group");
    if (tag < -std::numeric_limits<int>::max() || tag > std::numeric_limits<int>::max()) {
      in.fail(tag_place, std::to_string(tag), "the tag of a physical group of at most 32 bits");
    }
    entry.tag = static_cast<int>(tag);
    entry.name = in.quoted("the name of a physical group in double quotes");
    state.mesh.physical_names.push_back(std::move(entry));
  }
}

/// Records for entities that elements or nodes name but the file does not list, and names from
/// groups.
void complete_entities(MeshData& mesh) {
  std::set<EntityKey> listed;
  for (const EntityRecord& e : mesh.entities) listed.insert(e.key);
  std::set<EntityKey> missing;
  const auto want = [&](const EntityKey& key) {
    if (key.dim >= 0 && !listed.contains(key)) missing.insert(key);
  };
  EntityKey last;
  for (const EntityKey& key : mesh.point_entity) {
    if (key != last) want(key);
    last = key;
  }
  for (const ElementBlock& b : mesh.blocks) want({dimension(b.shape), b.entity});
  for (const EntityKey& key : missing) {
    EntityRecord record;
    record.key = key;
    mesh.entities.push_back(std::move(record));
  }
  std::stable_sort(mesh.entities.begin(), mesh.entities.end(),
                   [](const EntityRecord& a, const EntityRecord& b) { return a.key < b.key; });

  std::map<std::pair<int, std::int64_t>, const std::string*> name_of;
  for (const PhysicalName& p : mesh.physical_names) name_of.try_emplace({p.dim, p.tag}, &p.name);
  for (EntityRecord& e : mesh.entities) {
    for (const int tag : e.physical_tags) {
      // A negative tag is the group with reversed orientation.
      const auto entry = name_of.find({e.key.dim, tag < 0 ? -static_cast<std::int64_t>(tag) : tag});
      if (entry == name_of.end()) continue;
      e.name = *entry->second;
      break;
    }
  }
}

/// Goes through the sections of the file.
class SectionReader {
 public:
  explicit SectionReader(ReaderState& state) : state_(state), in_(state.in) {}

  void read_all() {
    if (!in_.at_end() && in_.found(in_.offset())[1] != '$') {
      in_.fail(in_.offset(), in_.found(in_.offset()), "a Gmsh mesh that starts with $MeshFormat");
    }
    while (!in_.at_end()) read_section();
    if (version_ == 0) in_.fail(in_.offset(), "no $MeshFormat section", "one");
    if (!has("Nodes")) in_.fail(in_.offset(), found_end(), "a $Nodes section");
    if (!has("Elements")) in_.fail(in_.offset(), found_end(), "a $Elements section");
  }

 private:
  std::string found_end() const { return "the end of the file"; }
  bool has(const std::string& section) const { return seen_.contains(section); }

  void read_section() {
    const std::size_t start = in_.offset();
    const std::string_view title = in_.word("a section");
    if (title.size() < 2 || title.front() != '$' || title.starts_with("$End")) {
      in_.fail(start, in_.found(start), "the $Name of a section");
    }
    const std::string section(title.substr(1));
    // The same data under a name that tells that each node has its entity.
    const std::string kind = section == "ParametricNodes" ? "Nodes" : section;
    if (!is_known(kind)) {
      if (!in_.skip_past("$End" + section)) {
        in_.fail(start, "$" + section + " without its end", "$End" + section);
      }
      return;
    }
    in_.end_line("the end of the line");
    if (!seen_.insert(kind).second) in_.fail(start, "a second $" + kind + " section", "one");
    if (kind == "MeshFormat") {
      version_ = read_format(in_);
    } else {
      read_content(kind, section, start);
    }
    const std::size_t end = in_.next_word();
    if (in_.word(("$End" + section).c_str()) != "$End" + section) {
      in_.fail(end, in_.found(end), "$End" + section);
    }
  }

  static bool is_known(const std::string& kind) {
    return kind == "MeshFormat" || kind == "PhysicalNames" || kind == "Entities" ||
           kind == "PartitionedEntities" || kind == "Nodes" || kind == "Elements";
  }

  void read_content(const std::string& kind, const std::string& section, std::size_t start) {
    if (version_ == 0) in_.fail(start, "$" + section, "$MeshFormat before any other section");
    if (kind == "PhysicalNames") {
      read_physical_names(state_);
    } else if (kind == "PartitionedEntities") {
      throw FileError("found a partitioned mesh, expected a mesh in one piece", in_.where(start),
                      "save it without partitions (UnpartitionMesh in Gmsh)");
    } else if (kind == "Entities") {
      if (version_ == 4) return read_entities_v4(state_);
      in_.fail(start, "$Entities in a file of version 2", "version 4.1");
    } else if (kind == "Nodes") {
      const bool parametric = section == "ParametricNodes";
      if (version_ == 2) return read_nodes_v2(state_, parametric);
      if (parametric) in_.fail(start, "$ParametricNodes in a file of version 4.1", "$Nodes");
      read_nodes_v4(state_);
    } else {
      if (!has("Nodes")) in_.fail(start, "$Elements before any $Nodes", "$Nodes first");
      if (version_ == 4) return read_elements_v4(state_);
      read_elements_v2(state_);
    }
  }

  ReaderState& state_;
  Cursor& in_;
  int version_ = 0;
  std::set<std::string> seen_;
};

}  // namespace
}  // namespace gmsh

MeshData parse_gmsh(const std::string& path, std::string_view bytes) {
  gmsh::ReaderState state(path, bytes);
  state.mesh.source = path;
  gmsh::SectionReader(state).read_all();
  gmsh::complete_entities(state.mesh);
  return std::move(state.mesh);
}

MeshData read_gmsh(const std::string& path) {
  const InputFile file(path);
  return parse_gmsh(path, file.text());
}

}  // namespace camber::io
