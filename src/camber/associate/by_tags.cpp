#include <camber/associate/by_tags.hpp>
#include <camber/base/error.hpp>
#include <camber/base/log.hpp>
#include <camber/base/parallel.hpp>

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace camber {
namespace {

/// A patch is planar if its vertices lie this near one plane, relative to the mesh size.
constexpr double k_planarity = 1e-9;

class TagAssociator {
 public:
  TagAssociator(const LinearMesh& mesh, const Topology& topology, const GeometryModel& model,
                const TagOptions& options)
      : mesh_(mesh), topology_(topology), model_(model), options_(options) {}

  Association run() {
    by_entity_ = boundary_faces_by_entity(mesh_, topology_);
    classify_loose_faces();
    result_.scale = model_.scale();
    make_patches();
    link_vertices();
    check_distances();
    link_edges();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_cad_surface(int entity) const {
    return entity >= 1 && entity <= model_.count(2);
  }

  /// Boundary faces that the file lists no surface element for: by the classification of their
  /// vertices.
  void classify_loose_faces() {
    const auto loose = by_entity_.find(0);
    if (loose == by_entity_.end()) return;
    std::vector<Index> left;
    for (Index f : loose->second) {
      std::set<int> surfaces;
      for (int i = 0; i < topology_.corners_of_face(f); ++i) {
        const EntityKey key =
            mesh_.vertex_entity[at(topology_.face2vertex[at(f)][static_cast<std::size_t>(i)])];
        if (key.dim == 2) surfaces.insert(key.tag);
        if (key.dim > 2 || key.dim < 0) surfaces.insert(-1);
      }
      if (surfaces.size() == 1 && *surfaces.begin() > 0) {
        by_entity_[*surfaces.begin()].push_back(f);
      } else {
        left.push_back(f);
      }
    }
    if (left.empty()) {
      by_entity_.erase(0);
    } else {
      by_entity_[0] = std::move(left);
    }
  }

  void make_patches() {
    result_.face2patch.assign(topology_.face_count(), k_none);
    const double tolerance = k_planarity * mesh_.size();
    for (const auto& [entity, faces] : by_entity_) {
      Patch patch;
      patch.entity = entity;
      patch.name = entity == 0 ? "unclassified" : mesh_.entity_name({2, entity});
      patch.faces = faces.size();
      const bool is_flat =
          fit_plane(mesh_, topology_, faces, tolerance, patch.origin, patch.normal);
      const PatchRule rule = rule_of(patch);
      if (is_cad_surface(entity) && rule != PatchRule::free && rule != PatchRule::fixed) {
        patch.group = {{2, entity}};
        const std::string cad_name = model_.name({2, entity});
        if (patch.name == fmt::format("surface {}", entity) && !cad_name.empty())
          patch.name = cad_name;
        const bool is_plane = rule == PatchRule::plane || (model_.is_planar(entity) && is_flat);
        patch.kind = is_plane ? PatchKind::plane : PatchKind::cad;
      } else {
        patch.kind = is_flat && rule != PatchRule::fixed ? PatchKind::plane : PatchKind::straight;
      }
      if (rule == PatchRule::plane && !is_flat) {
        throw OptionError(fmt::format("patch {} is not planar", patch.name), "--patch",
                          "only patches whose vertices lie in one plane can be kept in it");
      }
      for (Index f : faces) result_.face2patch[at(f)] = static_cast<Index>(result_.patches.size());
      result_.patches.push_back(std::move(patch));
    }
    for (const auto& [name, rule] : options_.patches) {
      if (!named_.contains(name)) {
        std::string known;
        for (const Patch& p : result_.patches) known += (known.empty() ? "" : ", ") + p.name;
        throw OptionError("no patch is named " + name, "--patch", "patches: " + known);
      }
      static_cast<void>(rule);
    }
  }

  PatchRule rule_of(const Patch& patch) {
    const std::array<std::string, 3> names{patch.name, std::to_string(patch.entity),
                                           fmt::format("surface {}", patch.entity)};
    for (const std::string& name : names) {
      const auto found = options_.patches.find(name);
      if (found == options_.patches.end()) continue;
      named_.insert(name);
      return found->second;
    }
    return PatchRule::automatic;
  }

  /// A vertex refers to the CAD if its tag exists there and it belongs to a patch on the CAD;
  /// without a classification of its own it refers to a face of that patch.
  void link_vertices() {
    std::vector<GeomEntity> face_at(mesh_.vertices.size());
    for (Index f = 0; at(f) < topology_.face_count(); ++f) {
      const Patch* patch = result_.patch_of(f);
      if (!patch || patch->group.empty()) continue;
      for (int i = 0; i < topology_.corners_of_face(f); ++i) {
        face_at[at(topology_.face2vertex[at(f)][static_cast<std::size_t>(i)])] =
            patch->group.front();
      }
    }
    result_.vertex2entity = face_at;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const EntityKey key = mesh_.vertex_entity[v];
      if (face_at[v].dim == 2 && key.dim >= 0 && key.dim <= 2 && key.tag >= 1 &&
          key.tag <= model_.count(key.dim)) {
        result_.vertex2entity[v] = {key.dim, key.tag};
      }
    }
  }

  void check_distances() {
    const std::size_t n = mesh_.vertices.size();
    std::vector<double> distance(n, 0.0);
    parallel_for_with(
        n, 512, [&] { return model_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t v = begin; v < end; ++v) {
            const GeomEntity entity = result_.vertex2entity[v];
            if (entity.dim < 0) continue;
            distance[v] = projector->closest(entity, mesh_.vertices[v]).distance;
          }
        });
    const double allowed = options_.distance_tolerance * mesh_size_of_walls();
    std::map<GeomEntity, std::pair<double, std::size_t>> worst;
    for (std::size_t v = 0; v < n; ++v) {
      if (result_.vertex2entity[v].dim < 0) continue;
      const GeomEntity entity = result_.vertex2entity[v];
      // A tag may name a vertex of a patch without CAD too; only distances count.
      auto& [far, which] = worst[entity];
      if (distance[v] > far) {
        far = distance[v];
        which = v;
      }
      result_.largest_distance = std::max(result_.largest_distance, distance[v]);
    }
    GeomEntity bad;
    double excess = 0.0;
    std::size_t count = 0;
    for (const auto& [entity, found] : worst) {
      const double limit = std::max(allowed, 2.0 * model_.tolerance(entity));
      if (found.first <= limit) continue;
      ++count;
      if (found.first > excess) {
        excess = found.first;
        bad = entity;
      }
    }
    if (count == 0) return;
    const std::size_t v = worst[bad].second;
    constexpr std::array<const char*, 3> kind{"vertex", "curve", "surface"};
    const Vec3& x = mesh_.vertices[v];
    throw GeometryError(
        fmt::format(
            "mesh and CAD do not fit: vertex {} of {} {} lies {:.3g} away from that CAD entity "
            "(allowed {:.3g}); {} entities do not fit",
            mesh_.vertex_tags[v], kind[static_cast<std::size_t>(bad.dim)], bad.tag, excess, allowed,
            count),
        fmt::format("at ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
        "the mesh was made from another CAD file, or its tags were renumbered");
  }

  [[nodiscard]] double mesh_size_of_walls() const {
    Box box;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (result_.vertex2entity[v].dim >= 0) box.add(mesh_.vertices[v]);
    }
    return box.diagonal();
  }

  void link_edges() {
    result_.edge2curve.resize(topology_.edge_count());
    std::vector<std::array<Index, 2>> patches_of_edge(topology_.edge_count(), {k_none, k_none});
    for (Index f = 0; at(f) < topology_.face_count(); ++f) {
      if (result_.face2patch[at(f)] == k_none) continue;
      for (int i = 0; i < topology_.corners_of_face(f); ++i) {
        std::array<Index, 2>& p =
            patches_of_edge[at(topology_.face2edge[at(f)][static_cast<std::size_t>(i)])];
        (p[0] == k_none ? p[0] : p[1]) = result_.face2patch[at(f)];
      }
    }
    for (const LinearMesh::Line& line : mesh_.lines) {
      if (line.curve < 1 || line.curve > model_.count(1) || model_.is_degenerate(line.curve))
        continue;
      const Index e = topology_.find_edge(line.a, line.b);
      if (e != k_none && touches_cad(patches_of_edge[at(e)]))
        result_.edge2curve[at(e)] = {1, line.curve};
    }
    // Edges between two CAD patches for which the file lists no line element.
    const std::unique_ptr<Projector> projector = model_.projector();
    for (Index e = 0; at(e) < topology_.edge_count(); ++e) {
      const std::array<Index, 2>& p = patches_of_edge[at(e)];
      if (p[0] == k_none || p[1] == k_none || p[0] == p[1] || result_.edge2curve[at(e)].dim == 1)
        continue;
      const GeometryGroup &a = result_.patches[at(p[0])].group,
                          &b = result_.patches[at(p[1])].group;
      if (a.empty() || b.empty()) continue;
      result_.edge2curve[at(e)] = common_curve(*projector, e, a, b);
    }
  }

  [[nodiscard]] bool touches_cad(const std::array<Index, 2>& patches) const {
    for (Index p : patches) {
      if (p != k_none && !result_.patches[at(p)].group.empty()) return true;
    }
    return false;
  }

  [[nodiscard]] GeomEntity common_curve(Projector& projector, Index e, const GeometryGroup& a,
                                        const GeometryGroup& b) const {
    const Vec3& from = mesh_.vertices[at(topology_.edge2vertex[at(e)][0])];
    const Vec3& to = mesh_.vertices[at(topology_.edge2vertex[at(e)][1])];
    GeomEntity best;
    double nearest =
        std::max(options_.distance_tolerance * mesh_.size(), 1e-3 * (to - from).norm());
    for (const GeomEntity& face_a : a) {
      for (int curve : model_.curves_of_face(face_a.tag)) {
        if (model_.is_degenerate(curve)) continue;
        const std::vector<int> faces = model_.faces_of_curve(curve);
        const bool is_common = std::any_of(b.begin(), b.end(), [&](const GeomEntity& face_b) {
          return std::find(faces.begin(), faces.end(), face_b.tag) != faces.end();
        });
        if (!is_common) continue;
        const double distance = std::max(projector.closest({1, curve}, from).distance,
                                         projector.closest({1, curve}, to).distance);
        if (distance < nearest) {
          nearest = distance;
          best = {1, curve};
        }
      }
    }
    return best;
  }

  const LinearMesh& mesh_;
  const Topology& topology_;
  const GeometryModel& model_;
  const TagOptions& options_;
  std::map<int, std::vector<Index>> by_entity_;
  std::set<std::string> named_;
  Association result_;
};

}  // namespace

Association associate_by_tags(const LinearMesh& mesh, const Topology& topology,
                              const GeometryModel& model, const TagOptions& options) {
  return TagAssociator(mesh, topology, model, options).run();
}

}  // namespace camber
