#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/metric/element_quality.hpp>
#include <camber/pipeline/detail/report_warnings.hpp>
#include <camber/pipeline/summary.hpp>
#include <camber/pipeline/volume_start.hpp>
#include <camber/smooth/polish.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sys/resource.h>

#include <fmt/format.h>

namespace camber {
namespace {

constexpr double k_spacing_limit = 0.01;
constexpr std::size_t k_certified_at_once = std::size_t{1} << 16;

Vec3 centre_of(const LinearMesh& mesh, Index c) {
  Vec3 centre = Vec3::Zero();
  for (Index v : mesh.cell(c)) centre += mesh.vertices[at(v)];
  return centre / static_cast<double>(mesh.cell(c).size());
}

void count_cells(const CurveResult& result, const CurveOptions& options, Report& report) {
  const LinearMesh& mesh = *result.linear;
  report.input.nodes = mesh.vertices.size();
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    ++report.input.cells[mesh.cell_shape[at(c)]];
    const int p = options.uniform ? options.orders.max_order : result.curved->cell_order(c);
    ++report.output.cells_by_order[p];
    ++report.output.cells_by_shape_and_order[mesh.cell_shape[at(c)]][p];
  }
}

void certify_cells(CurveResult& result, Report& report) {
  const LinearMesh& mesh = *result.linear;
  const CurvedMesh& curved = *result.curved;
  const std::size_t n = mesh.cell_count();
  result.cell_bound.resize(n);
  result.cell_cost = cell_costs(curved);
  double sum = 0.0;
  // Part by part: the bounds of all cells at once are as large as the curved mesh.
  std::vector<JacobianBounds> bounds;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % k_certified_at_once == 0) {
      bounds = certify_all(std::min(n - i, k_certified_at_once), [&](std::size_t k, Points& nodes) {
        const Index c = static_cast<Index>(i + k);
        curved.gather(c, curved.cell_order(c), nodes);
        return ElementKind{mesh.cell_shape[i + k], curved.cell_order(c)};
      });
    }
    const JacobianBounds& b = bounds[i % k_certified_at_once];
    result.cell_bound[i] = b.scaled_jacobian;
    report.validity.certified += b.verdict == Verdict::valid;
    report.validity.invalid += b.verdict == Verdict::invalid;
    report.validity.undecided += b.verdict == Verdict::undecided;
    report.validity.min_scaled_jacobian =
        std::min(report.validity.min_scaled_jacobian, b.scaled_jacobian);
    report.validity.min_jacobian_ratio =
        std::min(report.validity.min_jacobian_ratio, b.jacobian_ratio);
    count_in(report.quality.scaled_jacobian, b.scaled_jacobian);
    count_in(report.quality.cost, result.cell_cost[i]);
    report.quality.minimum = std::min(report.quality.minimum, result.cell_cost[i]);
    report.quality.below_target += result.cell_cost[i] < report.quality.target;
    sum += result.cell_cost[i];
  }
  report.quality.average = n ? sum / static_cast<double>(n) : 1.0;
  std::vector<Index> worst(n);
  std::iota(worst.begin(), worst.end(), 0);
  const std::size_t listed = std::min(n, k_worst_listed);
  std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(listed), worst.end(),
                    [&](Index a, Index b) {
                      const double x = result.cell_bound[at(a)], y = result.cell_bound[at(b)];
                      return x != y ? x < y : a < b;
                    });
  for (std::size_t i = 0; i < listed; ++i) {
    const Index c = worst[i];
    report.validity.worst.push_back({mesh.cell_tags[at(c)], mesh.cell_shape[at(c)],
                                     curved.cell_order(c), centre_of(mesh, c),
                                     result.cell_bound[at(c)]});
  }
}

void measure_conformity(const CurveResult& result, Report& report) {
  report.conformity.max_gap = largest_gap(*result.curved);
  report.conformity.max_order_jump = largest_order_jump(*result.topology, result.curved->orders());
  report.conformity.model_size = result.linear->size();
}

struct SurfaceSum {
  std::size_t faces = 0;
  double integral = 0.0, area = 0.0, maximum = 0.0;
  double linear_integral = 0.0, linear_area = 0.0, linear_maximum = 0.0;
  void add(const Deviation& curved, const Deviation& linear) {
    ++faces;
    integral += curved.integral;
    area += curved.area;
    maximum = std::max(maximum, curved.maximum);
    linear_integral += linear.integral;
    linear_area += linear.area;
    linear_maximum = std::max(linear_maximum, linear.maximum);
  }
  [[nodiscard]] double average() const { return area > 0.0 ? integral / area : 0.0; }
  [[nodiscard]] double linear_average() const {
    return linear_area > 0.0 ? linear_integral / linear_area : 0.0;
  }
  [[nodiscard]] SurfaceRow row() const {
    SurfaceRow row;
    row.faces = faces;
    row.area = area;
    row.average = average();
    row.maximum = maximum;
    row.linear_average = linear_average();
    row.linear_maximum = linear_maximum;
    return row;
  }
};

void measure_surface(CurveResult& result, const GeometryModel& geometry, const Wall& wall,
                     const Placement& placement, const CurveOptions& options, Report& report) {
  const Topology& topology = *result.topology;
  const CurvedMesh& curved = *result.curved;
  std::vector<Deviation> deviation(wall.face_count());
  parallel_for_with(
      wall.face_count(), 32, [&] { return geometry.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        std::array<Vec3, 49> nodes;
        for (std::size_t s = begin; s < end; ++s) {
          const Index f = wall.faces[s];
          const Shape shape = topology.face_shape[at(f)];
          const int q = curved.face_order(f);
          const std::span<Vec3> all(nodes.data(), static_cast<std::size_t>(node_count(shape, q)));
          curved.face_lattice(f, q, all);
          deviation[s] = measure_face(*projector, result.association.patch_of(f)->group, shape, q,
                                      all, &wall.corners[at(wall.face_corners[s][0])]);
        }
      });
  const std::vector<double> shortest = shortest_edges(*result.linear, topology);
  result.face_deviation.assign(topology.face_count(), std::numeric_limits<double>::quiet_NaN());
  std::map<Index, SurfaceSum> by_patch;
  std::map<int, SurfaceSum> by_order;
  SurfaceSum all;
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    const Index f = wall.faces[s];
    const Deviation& linear = placement.face_deviation(static_cast<Index>(s), 1);
    result.face_deviation[at(f)] = deviation[s].maximum;
    by_patch[result.association.face2patch[at(f)]].add(deviation[s], linear);
    by_order[curved.face_order(f)].add(deviation[s], linear);
    all.add(deviation[s], linear);
    const double length = deviation_length(*result.linear, topology, f, shortest, options.orders);
    report.surface.faces_over_deviation += deviation[s].maximum > options.orders.deviation * length;
  }
  report.surface.faces = all.faces;
  report.surface.average = all.average();
  report.surface.maximum = all.maximum;
  report.surface.linear_average = all.linear_average();
  report.surface.linear_maximum = all.linear_maximum;
  for (const auto& [patch, sum] : by_patch) {
    SurfaceRow row = sum.row();
    row.name = result.association.patches[at(patch)].name;
    for (const GeomEntity& face : result.association.patches[at(patch)].group) {
      row.cad.push_back(fmt::format("face_{}", face.tag));
    }
    report.surface.by_group.push_back(std::move(row));
  }
  for (const auto& [order, sum] : by_order) {
    SurfaceRow row = sum.row();
    row.name = fmt::format("Q{}", order);
    row.order = order;
    report.surface.by_order.push_back(std::move(row));
  }
  for (const Patch& patch : result.association.patches) {
    if (patch.group.empty()) report.surface.patches_without_cad.push_back(patch.name);
  }
}

/// Height of the first cell over every wall node of its order: distance to the node above it,
/// linear and curved.
void measure_wall_spacing(const CurveResult& result, const Wall& wall, const Columns& columns,
                          Report& report) {
  const CurvedMesh& curved = *result.curved;
  const Topology& topology = *result.topology;
  report.wall_spacing.columns = columns.column_count;
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    const Index f = wall.faces[s], c = topology.face2cell[at(f)][0];
    if (columns.cell_face_slot[at(c)] != static_cast<Index>(s)) continue;
    const int p = curved.cell_order(c);
    const Shape shape = curved.linear().cell_shape[at(c)];
    if (shape == Shape::tetrahedron) continue;  // no lattice line of a tet follows the column
    Points x, straight;
    curved.gather(c, p, x);
    curved.gather_straight(c, p, straight);
    const std::span<const Index> cell_faces = topology.faces_of_cell(c);
    std::size_t local = 0;
    while (cell_faces[local] != f) ++local;
    const LatticeMap& map = lattice_map(shape, p);
    // The column direction of the lattice: along k in prisms, across the wall face in hexahedra.
    const std::span<const LatticePoint> points = lattice(shape, p);
    int axis = 2;
    bool from_high = false;
    for (int d = 0; d < 3; ++d) {
      const auto level = [&](int value) {
        return std::all_of(map.face[local].begin(), map.face[local].end(), [&](int n) {
          return points[static_cast<std::size_t>(n)][static_cast<std::size_t>(d)] == value;
        });
      };
      if (level(0) || level(p)) {
        axis = d;
        from_high = level(p);
      }
    }
    for (int n : map.face[local]) {
      LatticePoint above = points[static_cast<std::size_t>(n)];
      above[static_cast<std::size_t>(axis)] = from_high ? 0 : p;
      const std::size_t low = static_cast<std::size_t>(n);
      const std::size_t high = static_cast<std::size_t>(lattice_index(shape, p, above));
      const double before = (straight[high] - straight[low]).norm();
      const double change = std::abs((x[high] - x[low]).norm() - before) / before;
      ++report.wall_spacing.wall_nodes;
      report.wall_spacing.first_cell_changed_over_1_percent += change > k_spacing_limit;
      report.wall_spacing.max_change = std::max(report.wall_spacing.max_change, change);
    }
  }
}

/// Share of the displacement a cell kept, 1 if it was not scaled back.
double share_kept(const RescueResult& scaled, Index c) {
  const auto place = std::lower_bound(scaled.scaled_back.begin(), scaled.scaled_back.end(), c);
  if (place == scaled.scaled_back.end() || *place != c) return 1.0;
  return scaled.kept[static_cast<std::size_t>(place - scaled.scaled_back.begin())];
}

void list_rescue(const CurveResult& result, const Wall& wall, const Placement& placement,
                 const LadderResult& ladder, Report& report) {
  const LinearMesh& mesh = *result.linear;
  const Topology& topology = *result.topology;
  report.rescue.pinched = ladder.pinched.size();
  report.rescue.patches = ladder.mended.size();
  report.rescue.load_steps = ladder.load_steps;
  report.rescue.elastic_patches = ladder.elastic_patches;
  for (Index c : ladder.mended) {
    report.rescue.mended.push_back({mesh.cell_tags[at(c)], mesh.cell_shape[at(c)],
                                    centre_of(mesh, c), 0.0,
                                    "volume nodes around moved until certified"});
  }
  report.rescue.faces_smoothed = ladder.wall_faces_smoothed;
  report.rescue.orders_lowered = ladder.lowered_faces.size();
  report.rescue.scaled_back = ladder.scaled.scaled_back.size();
  std::map<Index, std::string> reasons;  // by cell
  const auto add = [&](Index c, const std::string& reason) {
    std::string& all = reasons[c];
    all += (all.empty() ? "" : "; ") + reason;
  };
  for (Index c : ladder.pinched) {
    if (result.curved->cell_order(c) > 1)
      add(c, "three edges of a corner lie on one smooth CAD face");
  }
  for (Index slot : ladder.lowered_faces) {
    const Index f = wall.faces[at(slot)];
    add(topology.face2cell[at(f)][0],
        fmt::format("wall face lowered from order {} to the shape of order {}",
                    result.curved->face_order(f), placement.face_cap(slot)));
  }
  for (Index c : ladder.scaled.scaled_back) {
    add(c, fmt::format("scaled back to {:.3g} of its displacement", share_kept(ladder.scaled, c)));
  }
  for (const auto& [c, reason] : reasons) {
    double distance = 0.0;
    for (Index f : topology.faces_of_cell(c)) {
      const double d = result.face_deviation[at(f)];
      if (d > distance) distance = d;
    }
    report.rescue.places.push_back(
        {mesh.cell_tags[at(c)], mesh.cell_shape[at(c)], centre_of(mesh, c), distance, reason});
  }
}

void list_start(const StartReport& start, const LadderResult& ladder, Report& report) {
  report.start = start;
  add_work(ladder.elastic, report.start.elastic);
}

/// Lowered wall faces that are over the deviation.
std::size_t missed_by_lowering(const CurveResult& result, const Wall& wall,
                               const LadderResult& ladder, const CurveOptions& options) {
  const std::vector<double> shortest = shortest_edges(*result.linear, *result.topology);
  std::size_t missed = 0;
  for (Index slot : ladder.lowered_faces) {
    const Index f = wall.faces[at(slot)];
    const double length =
        deviation_length(*result.linear, *result.topology, f, shortest, options.orders);
    missed += result.face_deviation[at(f)] > options.orders.deviation * length;
  }
  return missed;
}

void decide(const CurveResult& result, const Placement& placement, const Wall& wall,
            const LadderResult& ladder, const CurveOptions& options, Report& report) {
  const Association& association = result.association;
  std::size_t unplaced = 0;
  for (std::size_t s = 0; s < wall.edge_count(); ++s)
    unplaced += placement.is_edge_unplaced(static_cast<Index>(s));
  for (std::size_t s = 0; s < wall.face_count(); ++s)
    unplaced += placement.is_face_unplaced(static_cast<Index>(s));
  if (unplaced > 0) {
    report.warnings.push_back(
        fmt::format("{} wall edges or faces have a node that could not be put on its CAD entity; "
                    "it stays straight",
                    unplaced));
  }
  if (association.scale != 1.0) {
    report.warnings.push_back(
        fmt::format("CAD lengths were multiplied by {:g} to fit the mesh", association.scale));
  }
  if (report.validity.invalid + report.validity.undecided > 0) {
    report.status = "not_certified";
  } else if (report.rescue.scaled_back > 0) {
    report.status = "scaled_back";
  } else if (unplaced > 0 || missed_by_lowering(result, wall, ladder, options) > 0) {
    report.status = "not_on_geometry";
  } else if (std::any_of(report.periodic.begin(), report.periodic.end(),
                         [](const PeriodicRow& row) { return row.refused > 0; })) {
    report.status = "not_periodic";
  } else if (options.strict && report.surface.faces_over_deviation > 0) {
    report.status = "over_deviation";
  }
  report.exit_code = report.status == "ok" ? 0 : 3;
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace

void summarise(CurveResult& result, const GeometryModel& geometry, const Made& made,
               const CurveOptions& options) {
  const auto& [wall, placement, columns, start, ladder] = made;
  Report& report = result.report;
  report.command = "curve";
  report.threads = thread_count();
  report.quality.target = options.quality;
  count_cells(result, options, report);
  certify_cells(result, report);
  measure_conformity(result, report);
  measure_surface(result, geometry, wall, placement, options, report);
  measure_wall_spacing(result, wall, columns, report);
  list_start(start, ladder, report);
  list_rescue(result, wall, placement, ladder, report);
  detail::warn(result, report);
  decide(result, placement, wall, ladder, options, report);
  report.peak_bytes = peak_memory();
}

}  // namespace camber
