#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/metric/element_quality.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/detail/gaps.hpp>
#include <camber/pipeline/detail/surface_error.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <chrono>
#include <numeric>

#include <fmt/format.h>

namespace camber {
namespace {

/// Cost under which a cell counts as below the quality target (the paper's convergence threshold).
constexpr int k_highest_certified = 8;  // order that certify() takes

void count_cells(const MeshData& data, const ElementList& cells, Report& report) {
  report.input.mesh = data.source;
  std::vector<std::uint8_t> is_used(data.points.size(), 0);
  Box box;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ++report.input.cells[cells.shape(i)];
    ++report.output.cells_by_order[cells.order(i)];
    ++report.output.cells_by_shape_and_order[cells.shape(i)][cells.order(i)];
    for (Index n : cells.nodes(i)) {
      is_used[at(n)] = 1;
      box.add(data.points[at(n)]);
    }
  }
  report.input.nodes = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), 1));
  report.output.nodes = report.input.nodes;
  report.conformity.model_size = box.diagonal();
}

void refuse_what_cannot_be_judged(const MeshData& data, const ElementList& cells) {
  if (cells.size() == 0) {
    throw MeshError("the mesh has no volume cells (tet, pyramid, prism, hex)", data.source,
                    "export the volume mesh; in Gmsh put it in a physical group or set "
                    "Mesh.SaveAll=1");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells.order(i) <= k_highest_certified) continue;
    throw MeshError(
        fmt::format("{} {} has order {}, over the highest that can be certified, {}",
                    name(cells.shape(i)), cells.tag(i), cells.order(i), k_highest_certified),
        data.source, "write it at a lower order");
  }
}

void certify_cells(const ElementList& cells, Report& report, CellFindings* findings) {
  const std::size_t n = cells.size();
  const std::vector<JacobianBounds> bounds = certify_all(n, [&](std::size_t i, Points& nodes) {
    cells.gather(i, nodes);
    return ElementKind{cells.shape(i), cells.order(i)};
  });
  auto& validity = report.validity;
  for (const JacobianBounds& b : bounds) {
    validity.certified += b.verdict == Verdict::valid;
    validity.invalid += b.verdict == Verdict::invalid;
    validity.undecided += b.verdict == Verdict::undecided;
    validity.min_scaled_jacobian = std::min(validity.min_scaled_jacobian, b.scaled_jacobian);
    validity.min_jacobian_ratio = std::min(validity.min_jacobian_ratio, b.jacobian_ratio);
    count_in(report.quality.scaled_jacobian, b.scaled_jacobian);
  }
  std::vector<std::size_t> worst(n);
  std::iota(worst.begin(), worst.end(), std::size_t{0});
  worst.resize(std::min(n, k_worst_listed));
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::partial_sort_copy(all.begin(), all.end(), worst.begin(), worst.end(),
                         [&](std::size_t a, std::size_t b) {
                           const double x = bounds[a].scaled_jacobian;
                           const double y = bounds[b].scaled_jacobian;
                           return x != y ? x < y : a < b;
                         });
  if (findings) {
    findings->bound.resize(n);
    for (std::size_t i = 0; i < n; ++i) findings->bound[i] = bounds[i].scaled_jacobian;
  }
  for (std::size_t i : worst) {
    validity.worst.push_back(
        {cells.tag(i), cells.shape(i), cells.order(i), cells.centre(i), bounds[i].scaled_jacobian});
  }
}

/// A linear cell is its own straight copy: C = 1.
void measure_quality(const ElementList& cells, Report& report, CellFindings* findings) {
  const std::size_t n = cells.size();
  std::vector<double> cost = lowest_costs(n, [&](std::size_t i, Points& nodes) {
    if (cells.order(i) > 1) cells.gather(i, nodes);
    return std::pair(cells.shape(i), cells.order(i));
  });
  auto& quality = report.quality;
  for (double c : cost) {
    count_in(quality.cost, c);
    quality.minimum = std::min(quality.minimum, c);
    quality.below_target += c < quality.target;
  }
  quality.average = ordered_sum(n, [&](std::size_t i) { return cost[i]; }) / static_cast<double>(n);
  if (findings) findings->cost = std::move(cost);
}

std::string place(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
}

/// @return true if the cells fit together
bool judge_faces(const MeshData& data, const ElementList& cells, const ElementList& surfaces,
                 Report& report) {
  const FaceFindings found = examine_faces(data, cells, surfaces);
  report.conformity.max_gap = found.max_gap;
  report.conformity.max_order_jump = found.max_order_jump;
  bool fits = true;
  const auto warn = [&](bool is_failure, std::string text) {
    report.warnings.push_back(std::move(text));
    fits = fits && !is_failure;
  };
  if (found.max_gap > k_gap_tolerance * report.conformity.model_size) {
    warn(true, fmt::format("the two sides of a face near {} are {:.3g} apart",
                           place(found.max_gap_at), found.max_gap));
  }
  if (found.crowded > 0) {
    warn(true, fmt::format("{} faces have more than two cells, the first near {}", found.crowded,
                           place(found.crowded_at)));
  }
  if (found.twisted > 0) {
    warn(true, fmt::format("{} quadrilateral faces have corners that their two sides walk in "
                           "different orders",
                           found.twisted));
  }
  if (found.bare > 0) {
    warn(false, fmt::format("{} of {} boundary faces have no surface element", found.bare,
                            found.boundary_faces));
  }
  if (found.loose > 0) {
    warn(false, fmt::format("{} surface elements are no face of any cell", found.loose));
  }
  return fits;
}

}  // namespace

Report check(const MeshData& data, const GeometryModel* geometry, const CheckOptions& options,
             CellFindings* findings) {
  using Clock = std::chrono::steady_clock;
  Report report;
  report.command = "check";
  report.threads = thread_count();
  const ElementList cells(data, 3), surfaces(data, 2);
  refuse_what_cannot_be_judged(data, cells);
  count_cells(data, cells, report);
  const auto timed = [&](const char* stage, const auto& work) {
    const Clock::time_point start = Clock::now();
    work();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    report.stages_s.emplace_back(stage, seconds);
    report.total_s += seconds;
  };
  bool fits = true;
  timed("certify", [&] { certify_cells(cells, report, findings); });
  if (options.with_quality) timed("quality", [&] { measure_quality(cells, report, findings); });
  timed("conformity", [&] { fits = judge_faces(data, cells, surfaces, report); });
  if (geometry) {
    timed("surface",
          [&] { measure_surfaces(data, surfaces, *geometry, options.deviation, report); });
  }
  if (report.validity.invalid + report.validity.undecided > 0) {
    report.status = "not_certified";
  } else if (!fits) {
    report.status = "not_watertight";
  } else if (options.strict && report.surface.faces_over_deviation > 0) {
    report.status = "over_deviation";
  }
  report.exit_code = report.status == "ok" ? 0 : 3;
  return report;
}

}  // namespace camber
