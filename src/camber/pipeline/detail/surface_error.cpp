#include <camber/base/parallel.hpp>
#include <camber/elevate/placement.hpp>
#include <camber/pipeline/detail/surface_error.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

namespace camber {
namespace {

struct FaceError {
  Deviation curved, linear;
  double shortest_edge = std::numeric_limits<double>::infinity();
};

/// Sums over faces, in their order.
struct SurfaceSum {
  std::set<int> entities;
  int order = 0;
  std::size_t faces = 0;
  Deviation curved, linear;

  void add(const FaceError& error) {
    ++faces;
    for (auto [sum, term] :
         {std::pair(&curved, &error.curved), std::pair(&linear, &error.linear)}) {
      sum->maximum = std::max(sum->maximum, term->maximum);
      sum->integral += term->integral;
      sum->area += term->area;
    }
  }
  [[nodiscard]] static double average(const Deviation& d) {
    return d.area > 0.0 ? d.integral / d.area : 0.0;
  }
  [[nodiscard]] SurfaceRow row(std::string name) const {
    SurfaceRow row;
    row.name = std::move(name);
    for (int entity : entities) row.cad.push_back(fmt::format("face_{}", entity));
    row.order = order;
    row.faces = faces;
    row.area = curved.area;
    row.average = average(curved);
    row.maximum = curved.maximum;
    row.linear_average = average(linear);
    row.linear_maximum = linear.maximum;
    return row;
  }
};

std::string patch_name(const MeshData& data, const GeometryModel& geometry, int entity) {
  for (const EntityRecord& record : data.entities) {
    if (record.key == EntityKey{2, entity} && !record.name.empty()) return record.name;
  }
  if (entity >= 1 && entity <= geometry.count(2)) {
    std::string name = geometry.name({2, entity});
    if (!name.empty()) return name;
  }
  return fmt::format("surface {}", entity);
}

FaceError measure(Projector& projector, const ElementList& surfaces, std::size_t i, Points& nodes) {
  const Shape shape = surfaces.shape(i);
  const int p = surfaces.order(i);
  const GeometryGroup group{{2, surfaces.entity(i)}};
  surfaces.gather(i, nodes);
  FaceError error;
  error.curved = measure_face(projector, group, shape, p, nodes, nullptr);
  error.linear = error.curved;
  const std::vector<int>& corner = lattice_map(shape, p).corner;
  const std::vector<int>& place = lattice_map(shape, 1).corner;
  Points straight(corner.size());
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const Vec3& x = nodes[static_cast<std::size_t>(corner[c])];
    const Vec3& next = nodes[static_cast<std::size_t>(corner[(c + 1) % corner.size()])];
    straight[static_cast<std::size_t>(place[c])] = x;
    error.shortest_edge = std::min(error.shortest_edge, (next - x).norm());
  }
  if (p > 1) error.linear = measure_face(projector, group, shape, 1, straight, nullptr);
  return error;
}

}  // namespace

void measure_surfaces(const MeshData& data, const ElementList& surfaces,
                      const GeometryModel& geometry, double deviation, Report& report) {
  std::vector<std::size_t> on_cad;
  std::set<std::string> without;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const int entity = surfaces.entity(i);
    if (entity < 1 || entity > geometry.count(2)) {
      without.insert(patch_name(data, geometry, entity));
    } else if (!geometry.is_planar(entity)) {
      on_cad.push_back(i);
    }
  }
  report.surface.patches_without_cad.assign(without.begin(), without.end());

  std::vector<FaceError> errors(on_cad.size());
  parallel_for_with(
      on_cad.size(), 32, [&] { return geometry.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        Points nodes;
        for (std::size_t k = begin; k < end; ++k) {
          errors[k] = measure(*projector, surfaces, on_cad[k], nodes);
        }
      });

  std::map<int, std::string> names;
  std::map<std::string, SurfaceSum> by_group;
  std::map<int, SurfaceSum> by_order;
  SurfaceSum all;
  for (std::size_t k = 0; k < on_cad.size(); ++k) {
    const int entity = surfaces.entity(on_cad[k]), p = surfaces.order(on_cad[k]);
    if (!names.contains(entity)) names[entity] = patch_name(data, geometry, entity);
    SurfaceSum& group = by_group[names[entity]];
    group.entities.insert(entity);
    group.add(errors[k]);
    by_order[p].order = p;
    by_order[p].add(errors[k]);
    all.add(errors[k]);
    report.surface.faces_over_deviation +=
        errors[k].curved.maximum > deviation * errors[k].shortest_edge;
  }
  const SurfaceRow total = all.row("");
  report.surface.faces = total.faces;
  report.surface.average = total.average;
  report.surface.maximum = total.maximum;
  report.surface.linear_average = total.linear_average;
  report.surface.linear_maximum = total.linear_maximum;
  for (const auto& [name, sum] : by_group) report.surface.by_group.push_back(sum.row(name));
  for (const auto& [p, sum] : by_order) {
    report.surface.by_order.push_back(sum.row(fmt::format("Q{}", p)));
  }
}

}  // namespace camber
