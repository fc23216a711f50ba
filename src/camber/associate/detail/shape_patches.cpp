#include <camber/associate/detail/shape_patches.hpp>
#include <camber/base/error.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

namespace camber {
namespace {

/// A patch is planar if its vertices lie this near one plane, relative to the mesh size.
constexpr double k_flat_share = 1e-9;
/// Pieces without CAD end where facets turn by more than 30 degrees (cosine).
constexpr double k_smooth_cosine = 0.866;

/// What makes one patch of faces: first the surface entity of the file, then the CAD faces; faces
/// on no CAD go by their piece.
struct Key {
  int entity = 0;
  GeometryGroup group;
  Index piece = k_none;
  friend auto operator<=>(const Key&, const Key&) = default;
};

/// By face slot: number of the smooth connected piece of faces on no CAD and of one entity.
std::vector<Index> pieces_without_cad(const Topology& topology, const Boundary& boundary,
                                      const FaceMatch& match) {
  std::vector<Index> piece(boundary.faces.size(), k_none);
  Index count = 0;
  std::vector<Index> pending;
  for (std::size_t first = 0; first < piece.size(); ++first) {
    if (!match.group[first].empty() || piece[first] != k_none) continue;
    piece[first] = count;
    pending.assign(1, static_cast<Index>(first));
    while (!pending.empty()) {
      const Boundary::Face& face = boundary.faces[at(pending.back())];
      pending.pop_back();
      for (int i = 0; i < face.corners; ++i) {
        const Index e = topology.face2edge[at(face.face)][static_cast<std::size_t>(i)];
        for (Index s : boundary.edge_faces[at(e)]) {
          if (s == k_none || piece[at(s)] != k_none || !match.group[at(s)].empty()) continue;
          const Boundary::Face& other = boundary.faces[at(s)];
          if (other.entity != face.entity || other.normal.dot(face.normal) < k_smooth_cosine)
            continue;
          piece[at(s)] = count;
          pending.push_back(s);
        }
      }
    }
    ++count;
  }
  return piece;
}

std::string faces_text(const GeometryGroup& group) {
  std::string text;
  for (const GeomEntity& face : group)
    text += fmt::format("{}{}", text.empty() ? "" : "+", face.tag);
  return "face " + text;
}

/// Names of the file first; a second part where the file's patch was cut.
std::string patch_name(const LinearMesh& mesh, const GeometryModel& model, const Key& key,
                       bool is_only, std::size_t piece) {
  std::string own = key.group.size() == 1 ? model.name(key.group.front()) : std::string();
  const std::string cad = key.group.empty() ? std::string() : faces_text(key.group);
  if (key.entity == 0) {
    if (key.group.empty()) return fmt::format("boundary {}", piece);
    return own.empty() ? cad : own;
  }
  const std::string of_file = mesh.entity_name({2, key.entity});
  if (is_only) {
    const bool is_unnamed = of_file == fmt::format("surface {}", key.entity);
    return is_unnamed && !own.empty() ? own : of_file;
  }
  return fmt::format("{}/{}", of_file, cad.empty() ? fmt::format("off CAD {}", piece) : cad);
}

bool all_planar(const GeometryModel& model, const GeometryGroup& group) {
  return std::all_of(group.begin(), group.end(),
                     [&](const GeomEntity& face) { return model.is_planar(face.tag); });
}

/// A patch of the file off the CAD that falls into more pieces than this, of a few faces each, is
/// the ragged top of a layer mesh or the like: no planes to be kept, one patch.
constexpr std::size_t k_most_pieces = 64;
constexpr std::size_t k_ragged = 4;

void join_jagged(const Boundary& boundary, const FaceMatch& match, std::vector<Index>& piece) {
  std::map<int, std::set<Index>> pieces;
  std::map<int, std::size_t> faces;
  for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
    if (!match.group[s].empty()) continue;
    pieces[boundary.faces[s].entity].insert(piece[s]);
    ++faces[boundary.faces[s].entity];
  }
  for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
    if (!match.group[s].empty()) continue;
    const std::set<Index>& all = pieces[boundary.faces[s].entity];
    if (all.size() > k_most_pieces && faces[boundary.faces[s].entity] < k_ragged * all.size()) {
      piece[s] = *all.begin();
    }
  }
}

}  // namespace

void make_shape_patches(const LinearMesh& mesh, const Topology& topology, const Boundary& boundary,
                        const GeometryModel& model, const FaceMatch& match,
                        const std::vector<PatchRule>& rules, Association& association,
                        std::vector<double>& confidence) {
  std::vector<Index> piece = pieces_without_cad(topology, boundary, match);
  join_jagged(boundary, match, piece);
  std::map<Key, std::vector<Index>> slots;
  for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
    slots[{boundary.faces[s].entity, match.group[s], piece[s]}].push_back(static_cast<Index>(s));
  }
  std::map<int, std::size_t> patches_of_entity;
  for (const auto& [key, list] : slots) ++patches_of_entity[key.entity];
  std::map<int, std::size_t> off_cad;
  association.face2patch.assign(topology.face_count(), k_none);
  for (const auto& [key, list] : slots) {
    Patch patch;
    patch.entity = key.entity != 0 || key.group.empty() ? key.entity : key.group.front().tag;
    const std::size_t number = key.group.empty() ? ++off_cad[key.entity] : 0;
    patch.name = patch_name(mesh, model, key, patches_of_entity[key.entity] == 1, number);
    patch.group = key.group;
    patch.faces = list.size();
    std::vector<Index> faces;
    double sure = 0.0;
    for (Index s : list) {
      faces.push_back(boundary.faces[at(s)].face);
      association.face2patch[at(faces.back())] = static_cast<Index>(association.patches.size());
      sure += match.confidence[at(s)];
    }
    const bool is_flat =
        fit_plane(mesh, topology, faces, k_flat_share * mesh.size(), patch.origin, patch.normal);
    const PatchRule rule = rules[at(list.front())];
    if (rule == PatchRule::plane && !is_flat) {
      throw OptionError(fmt::format("patch {} is not planar", patch.name), "--patch",
                        "only patches whose vertices lie in one plane can be kept in it");
    }
    if (patch.group.empty()) {
      patch.kind = is_flat && rule != PatchRule::fixed ? PatchKind::plane : PatchKind::straight;
    } else {
      const bool is_plane = is_flat && (rule == PatchRule::plane || all_planar(model, patch.group));
      patch.kind = is_plane ? PatchKind::plane : PatchKind::cad;
    }
    confidence.push_back(sure / static_cast<double>(list.size()));
    association.patches.push_back(std::move(patch));
  }
}

}  // namespace camber
