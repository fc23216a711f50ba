#include <camber/base/error.hpp>
#include <camber/pipeline/mesh_link.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace camber {
namespace {

constexpr std::array<std::string_view, 3> k_prefix{"vertex_", "edge_", "face_"};

/// The entity of "face_3" and the like.
std::optional<GeomEntity> numbered(const std::string& ref, const GeometryModel& model) {
  for (int dim = 0; dim <= 2; ++dim) {
    const std::string_view prefix = k_prefix[static_cast<std::size_t>(dim)];
    if (!ref.starts_with(prefix)) continue;
    int tag = 0;
    const char* end = ref.data() + ref.size();
    const auto [stop, error] = std::from_chars(ref.data() + prefix.size(), end, tag);
    if (error == std::errc{} && stop == end && tag >= 1 && tag <= model.count(dim)) {
      return GeomEntity{dim, tag};
    }
  }
  return {};
}

using Groups = std::map<int, GeometryGroup>;

/// CAD entities by geometry id. References that the CAD does not know are refused only if the mesh
/// uses them: a file may describe more than one CAD.
class Resolver {
 public:
  Resolver(const io::MeshLink& link, const GeometryModel& model) {
    std::map<std::string, GeometryGroup> by_name;
    for (int dim = 0; dim <= 2; ++dim) {
      for (int tag = 1; tag <= model.count(dim); ++tag) {
        const std::string name = model.name({dim, tag});
        if (!name.empty()) by_name[name].push_back({dim, tag});
      }
    }
    for (const io::MeshLink::GeometryFile& file : link.geometry) {
      for (const io::MeshLink::Reference& reference : file.references) {
        names_[reference.id] = reference.ref;
        if (const auto entity = numbered(reference.ref, model)) {
          groups_[reference.id] = {*entity};
        } else if (const auto found = by_name.find(reference.ref); found != by_name.end()) {
          groups_[reference.id] = found->second;
        }
      }
    }
    for (const io::MeshLink::Group& group : link.geometry_groups) {
      for (int member : group.members) {
        const GeometryGroup own = entities(member);
        groups_[group.id].insert(groups_[group.id].end(), own.begin(), own.end());
      }
    }
  }

  /// Members of one dimension.
  [[nodiscard]] GeometryGroup of_dimension(int id, int dim) const {
    GeometryGroup group;
    for (const GeomEntity& entity : entities(id)) {
      if (entity.dim == dim) group.push_back(entity);
    }
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
    return group;
  }

 private:
  [[nodiscard]] GeometryGroup entities(int id) const {
    const auto found = groups_.find(id);
    if (found != groups_.end()) return found->second;
    const auto name = names_.find(id);
    throw GeometryError(fmt::format("the CAD has no entity '{}' that the link refers to",
                                    name == names_.end() ? std::to_string(id) : name->second),
                        "MeshLink",
                        "use face_N, edge_N, vertex_N (camber info CAD) or names of the CAD");
  }

  std::map<int, std::string> names_;
  Groups groups_;
};

std::size_t corners_of(const Topology& topology, Index f, const LinearMesh& mesh,
                       std::array<GlobalId, 4>& nodes) {
  const std::size_t n = static_cast<std::size_t>(topology.corners_of_face(f));
  for (std::size_t i = 0; i < n; ++i) {
    nodes[i] = mesh.vertex_tags[at(topology.face2vertex[at(f)][i])];
  }
  return n;
}

/// By topology face: geometry id.
std::vector<int> answers(const io::MeshLinkQuery& query, const LinearMesh& mesh,
                         const Topology& topology, std::size_t& known) {
  std::vector<int> ids(topology.face_count(), 0);
  known = 0;
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (!topology.is_boundary(f) && topology.face2patch_face[at(f)] == k_none) continue;
    std::array<GlobalId, 4> nodes{};
    const std::size_t n = corners_of(topology, f, mesh, nodes);
    ids[at(f)] = query.face(std::span(nodes).first(n));
    known += ids[at(f)] != 0;
  }
  return ids;
}

}  // namespace

GivenLink given_link(const io::MeshLink& link, const LinearMesh& mesh, const Topology& topology,
                     const GeometryModel& model) {
  std::vector<int> ids;
  std::optional<io::MeshLinkQuery> query;
  std::size_t most = 0;
  for (const io::MeshLink::MeshFile& file : link.meshes) {
    for (const io::MeshLink::Model& part : file.models) {
      io::MeshLinkQuery candidate(part);
      std::size_t known = 0;
      std::vector<int> found = answers(candidate, mesh, topology, known);
      if (known <= most) continue;
      most = known;
      ids = std::move(found);
      query = std::move(candidate);
    }
  }
  if (!query) {
    throw GeometryError("the link knows no boundary face of the mesh", "MeshLink",
                        "it was made for another mesh, or for other node numbers");
  }
  const Resolver resolver(link, model);
  GivenLink given;
  given.face_group.resize(topology.face_count());
  given.edge_group.resize(topology.edge_count());
  for (std::size_t f = 0; f < ids.size(); ++f) {
    if (ids[f] != 0) given.face_group[f] = resolver.of_dimension(ids[f], 2);
  }
  for (std::size_t e = 0; e < topology.edge_count(); ++e) {
    const std::array<Index, 2>& ends = topology.edge2vertex[e];
    const int id = query->string_edge(mesh.vertex_tags[at(ends[0])], mesh.vertex_tags[at(ends[1])]);
    if (id != 0) given.edge_group[e] = resolver.of_dimension(id, 1);
  }
  return given;
}

io::MeshLink mesh_link_of(const LinearMesh& mesh, const Topology& topology,
                          const Association& association, const GeometryModel& model,
                          const std::string& mesh_path, const std::string& cad_path) {
  io::MeshLink link;
  link.attributes.push_back({1, "model size", fmt::format("{}", model.box().diagonal())});
  std::map<GeomEntity, int> id_of;
  for (const Patch& patch : association.patches) {
    for (const GeomEntity& face : patch.group) id_of[face] = 0;
  }
  for (const GeomEntity& curve : association.edge2curve) {
    if (curve.dim == 1) id_of[curve] = 0;
  }
  for (const GeomEntity& entity : association.vertex2entity) {
    if (entity.dim == 0) id_of[entity] = 0;
  }
  io::MeshLink::GeometryFile cad{cad_path, 1, {}};
  int next = 0;
  for (auto& [entity, id] : id_of) {
    id = ++next;
    cad.references.push_back(
        {id, fmt::format("{}{}", k_prefix[static_cast<std::size_t>(entity.dim)], entity.tag),
         model.name(entity), 0});
  }
  link.geometry.push_back(std::move(cad));

  io::MeshLink::Model part;
  part.ref = "volume";
  std::map<GeometryGroup, int> groups;
  std::vector<std::array<io::MeshLink::Elements, 2>> faces(association.patches.size());
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Index p = association.face2patch[at(f)];
    if (p == k_none) continue;
    std::array<GlobalId, 4> nodes{};
    const std::size_t n = corners_of(topology, f, mesh, nodes);
    std::vector<GlobalId>& list = faces[at(p)][n - 3].numbers;
    list.insert(list.end(), nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(n));
  }
  std::set<std::string> used;
  for (std::size_t p = 0; p < association.patches.size(); ++p) {
    const Patch& patch = association.patches[p];
    io::MeshLink::Part sheet;
    sheet.name = patch.name;
    for (int copy = 2; !used.insert(sheet.name).second; ++copy) {
      sheet.name = fmt::format("{} ({})", patch.name, copy);
    }
    if (patch.group.size() == 1) sheet.geometry = id_of[patch.group.front()];
    if (patch.group.size() > 1) {
      int& id = groups[patch.group];
      if (id == 0) {
        id = ++next;
        io::MeshLink::Group group{id, fmt::format("group {}", groups.size()), 0, {}};
        for (const GeomEntity& face : patch.group) group.members.push_back(id_of[face]);
        link.geometry_groups.push_back(std::move(group));
      }
      sheet.geometry = id;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      faces[p][k].corners = static_cast<int>(k) + 3;
      if (!faces[p][k].numbers.empty()) sheet.elements.push_back(std::move(faces[p][k]));
    }
    part.sheets.push_back(std::move(sheet));
  }
  std::map<int, std::vector<GlobalId>> edges;
  for (std::size_t e = 0; e < topology.edge_count(); ++e) {
    if (association.edge2curve[e].dim != 1) continue;
    for (Index v : topology.edge2vertex[e]) {
      edges[association.edge2curve[e].tag].push_back(mesh.vertex_tags[at(v)]);
    }
  }
  for (auto& [curve, nodes] : edges) {
    const GeomEntity entity{1, curve};
    io::MeshLink::Part string{fmt::format("edge_{}", curve), "", id_of[entity], 0, {}, {}};
    string.elements.push_back({2, false, 0, "", 0, std::move(nodes)});
    part.strings.push_back(std::move(string));
  }
  for (std::size_t v = 0; v < association.vertex2entity.size(); ++v) {
    const GeomEntity entity = association.vertex2entity[v];
    if (entity.dim != 0) continue;
    part.points.push_back({1, false, id_of[entity], "", 0, {mesh.vertex_tags[v]}});
  }
  link.meshes.push_back({mesh_path, 0, {std::move(part)}});
  return link;
}

}  // namespace camber
