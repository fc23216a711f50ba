#include <camber/base/sorted_set.hpp>
#include <camber/pipeline/detail/wall_patch.hpp>
#include <camber/pipeline/wall_repair.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace camber {
namespace {

/// Share of the distance wanted that --fit does not bother with, on faces that need the order.
constexpr double k_unnoticed = 0.1;

/// Faces that share a vertex with a face, of the same patch.
class Neighbourhoods {
 public:
  Neighbourhoods(const Topology& topology, const Association& association, const Wall& wall)
      : topology_(topology), association_(association), wall_(wall) {
    for (std::size_t s = 0; s < wall.face_count(); ++s) {
      for (Index v : corners(static_cast<Index>(s))) {
        vertex_faces_[v].push_back(static_cast<Index>(s));
      }
    }
  }

  [[nodiscard]] std::vector<Index> around(Index slot) const {
    std::vector<Index> core;
    for (Index v : corners(slot)) {
      for (Index other : vertex_faces_.at(v)) {
        if (patch_of(other) == patch_of(slot)) core.push_back(other);
      }
    }
    make_sorted_set(core);
    return core;
  }

 private:
  [[nodiscard]] std::span<const Index> corners(Index slot) const {
    const Index f = wall_.faces[at(slot)];
    return {topology_.face2vertex[at(f)].data(),
            static_cast<std::size_t>(topology_.corners_of_face(f))};
  }
  [[nodiscard]] Index patch_of(Index slot) const {
    return association_.face2patch[at(wall_.faces[at(slot)])];
  }

  const Topology& topology_;
  const Association& association_;
  const Wall& wall_;
  std::map<Index, std::vector<Index>> vertex_faces_;
};

}  // namespace

std::vector<Index> smooth_wall_faces(const LinearMesh& mesh, const Topology& topology,
                                     const Association& association, const GeometryModel& model,
                                     const Wall& wall, Placement& placement,
                                     const std::vector<Index>& slots) {
  std::vector<Index> changed;
  if (slots.empty()) return changed;
  const Neighbourhoods neighbourhoods(topology, association, wall);
  // A lowered face, and so its edges, keeps the shape that it was given.
  const auto is_lowered = [&](Index slot) {
    return placement.face_cap(slot) < placement.max_order();
  };
  for (Index slot : slots) {
    if (is_lowered(slot)) continue;
    if (std::find(changed.begin(), changed.end(), slot) != changed.end()) continue;
    std::vector<Index> around = neighbourhoods.around(slot);
    std::erase_if(around, is_lowered);
    detail::WallPatch faces(mesh, topology, association, model, wall, placement, std::move(around),
                            placement.max_order());
    if (!smooth_surface(faces.patch(), faces.on_surface())) continue;
    faces.store(placement);
    for (int q = placement.max_order() - 1; q >= 2; --q) faces.store_sampled(placement, q);
    changed.insert(changed.end(), faces.faces().begin(), faces.faces().end());
  }
  make_sorted_set(changed);
  return changed;
}

void fit_wall(const LinearMesh& mesh, const Topology& topology, const Association& association,
              const GeometryModel& model, const Wall& wall,
              const std::vector<double>& wanted_distance, Placement& placement) {
  std::map<Index, std::vector<Index>> by_patch;
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    by_patch[association.face2patch[at(wall.faces[s])]].push_back(static_cast<Index>(s));
  }
  for (int q = 2; q <= placement.max_order(); ++q) {
    for (const auto& [patch, faces] : by_patch) {
      detail::WallPatch sliding(mesh, topology, association, model, wall, placement, faces, q);
      for (std::size_t i = 0; i < faces.size(); ++i) {
        const double wanted = wanted_distance[at(faces[i])];
        const bool needs_order = placement.face_deviation(faces[i], q - 1).maximum > wanted;
        sliding.patch().faces[i].good_enough = needs_order ? k_unnoticed * wanted : wanted;
      }
      const SurfaceFit fit =
          fit_surface(sliding.patch(), sliding.on_surface(), sliding.nearest_points());
      if (fit.after < fit.before) sliding.store(placement);
    }
  }
  placement.measure();
}

}  // namespace camber
