#include <camber/base/error.hpp>
#include <camber/elevate/pinched.hpp>
#include <camber/pipeline/cad_link.hpp>
#include <camber/pipeline/curve.hpp>
#include <camber/pipeline/ladder.hpp>
#include <camber/pipeline/periodic.hpp>
#include <camber/pipeline/smooth_stage.hpp>
#include <camber/pipeline/summary.hpp>
#include <camber/pipeline/unpinch.hpp>
#include <camber/pipeline/volume_start.hpp>
#include <camber/pipeline/wall_repair.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace camber {
namespace {

/// Seconds by stage, in the order of first use.
class Stopwatch {
 public:
  void next(const char* stage) {
    stop();
    stage_ = stage;
    start_ = Clock::now();
  }
  void stop() {
    if (!stage_) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    for (auto& [name, total] : stages_) {
      if (name == stage_) {
        total += seconds;
        stage_ = nullptr;
        return;
      }
    }
    stages_.emplace_back(stage_, seconds);
    stage_ = nullptr;
  }
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& stages() const {
    return stages_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  const char* stage_ = nullptr;
  Clock::time_point start_;
  std::vector<std::pair<std::string, double>> stages_;
};

void refuse_bad_orders(const OrderOptions& orders) {
  if (orders.min_order < 1 || orders.max_order > k_max_order ||
      orders.min_order > orders.max_order) {
    throw OptionError(
        fmt::format("orders from {} to {} are not possible", orders.min_order, orders.max_order),
        "--order, --min-order", fmt::format("choose 1 <= lowest <= highest <= {}", k_max_order));
  }
  if (!(orders.deviation > 0.0)) {
    throw OptionError(fmt::format("a deviation of {:g} cannot be reached", orders.deviation),
                      "--deviation", "give a positive share of the length, 0.01 to 0.05 as a rule");
  }
  if (orders.deviation_length == DeviationLength::given && !(orders.length > 0.0)) {
    throw OptionError(
        fmt::format("the deviation cannot be measured against a length of {:g}", orders.length),
        "--deviation-length", "give a positive length in the unit of the mesh");
  }
}

/// By wall face: the distance to the CAD that is asked.
std::vector<double> wanted_distances(const LinearMesh& mesh, const Topology& topology,
                                     const Wall& wall, const OrderOptions& options) {
  const std::vector<double> shortest = shortest_edges(mesh, topology);
  std::vector<double> distances;
  for (Index f : wall.faces) {
    distances.push_back(options.deviation * deviation_length(mesh, topology, f, shortest, options));
  }
  return distances;
}

void refuse_bad_quality(double quality) {
  if (quality >= 0.0 && quality <= 1.0) return;
  throw OptionError(fmt::format("a cost of {:g} does not exist", quality), "--quality",
                    "give a value from 0 to 1; 0.95 is the paper's");
}

/// @param owned  emptied when it is no longer needed; may be null, else the same as data
CurveResult run(const MeshData& data, MeshData* owned, GeometryModel& geometry,
                const CurveOptions& options, const Progress& progress) {
  refuse_bad_orders(options.orders);
  refuse_bad_quality(options.quality);
  CurveResult result;
  Stopwatch watch;
  watch.next("topology");
  progress("topology", 0.0);
  result.linear = std::make_unique<LinearMesh>(build_linear_mesh(data));
  result.topology = std::make_unique<Topology>(build_topology(*result.linear));

  watch.next("associate");
  progress("associate", 0.1);
  CadLink cad_link(data, geometry, options);
  const Relink link = [&](CurveResult& linked) {
    linked.association = cad_link.link(*linked.linear, *linked.topology, linked.report);
    return build_wall(*linked.linear, *linked.topology, linked.association, geometry);
  };
  Wall wall = link(result);
  std::vector<Index> pinched =
      find_pinched_cells(*result.linear, *result.topology, result.association, wall);
  if (options.split_pinched) pinched = unpinch(result, wall, std::move(pinched), link);
  if (owned) *owned = {};
  const LinearMesh& mesh = *result.linear;
  const Topology& topology = *result.topology;

  watch.next("place");
  progress("place", 0.2);
  Placement placement(mesh, topology, result.association, geometry, wall, options.orders.max_order);

  if (options.fit) {
    fit_wall(mesh, topology, result.association, geometry, wall,
             wanted_distances(mesh, topology, wall, options.orders), placement);
  }

  watch.next("elevate");
  progress("elevate", 0.4);
  const Columns columns = find_columns(mesh, topology, wall);
  LayerFieldOptions layer = options.layer;
  if (options.propagation == Propagation::cell) layer.decay = Decay::cell;
  const LayerField field(mesh, topology, result.association, wall, placement, columns, layer);
  // Where the start is only to be untangled, orders must reach as far as its displacement will.
  std::optional<LayerField> carried;
  if (layer.decay == Decay::cell && options.smoothing == Smoothing::automatic) {
    carried.emplace(mesh, topology, result.association, wall, placement, columns, options.layer);
  }
  const LayerField& layers = carried ? *carried : field;
  OrderRequests requests = request_orders(mesh, topology, wall, placement, layers, options.orders);
  PeriodicMatch periodic(mesh, topology, options.periodic);
  OrderField orders = periodic.settle(requests, [&](const OrderRequests& asked) {
    return settle_orders(mesh, topology, asked, options.orders);
  });

  watch.next("propagate");
  progress("propagate", 0.6);
  result.curved = std::make_unique<CurvedMesh>(mesh, topology, std::move(orders), NodeStart::zero);
  VolumeStart start(*result.curved, field, layers, options.propagation);
  start.propagate();

  watch.next("certify");
  progress("certify", 0.7);
  start.certify();
  if (options.smoothing == Smoothing::automatic && start.is_tangled()) {
    watch.next("smooth");
    start.replace();
  }

  watch.next("rescue");
  progress("rescue", 0.8);
  const Carry carry = [&start](const std::vector<Index>& cells) { return start.carry(cells); };
  const LadderResult ladder = climb(*result.curved, result.association, geometry, placement, carry,
                                    wall, columns, pinched, start.uncertified());

  watch.next("smooth");
  progress("smooth", 0.85);
  SmoothOutcome smoothed =
      smooth_stage(*result.curved, geometry, {result.association, wall, placement, columns, layer},
                   options, progress);
  result.report.smooth = std::move(smoothed.rows);
  result.report.rescue.put_back = smoothed.put_back;
  periodic.copy(*result.curved);
  result.report.periodic = periodic.rows();

  watch.next("measure");
  progress("measure", 0.9);
  summarise(result, geometry, {wall, placement, columns, start.report(), ladder}, options);
  watch.stop();
  result.report.stages_s = watch.stages();
  for (const auto& [name, seconds] : watch.stages()) result.report.total_s += seconds;
  progress("measure", 1.0);
  return result;
}

/// What is known of every element of an exported mesh, as fields.
std::vector<Field> fields_of(const CurveResult& result, const CurveOptions& options,
                             const ExportMap& map) {
  const std::size_t n = map.cell.size();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Field order{"shape_order", std::vector<double>(n, nan)},
      bound{"scaled_jacobian", std::vector<double>(n, nan)};
  Field cost{"cost", std::vector<double>(n, nan)}, patch{"patch", std::vector<double>(n, nan)};
  Field deviation{"deviation", std::vector<double>(n, nan)};
  const Topology& topology = *result.topology;
  for (std::size_t i = 0; i < n; ++i) {
    const Index c = map.cell[i], f = map.face[i];
    if (c != k_none) {
      order.values[i] = result.curved->cell_order(c);
      bound.values[i] = result.cell_bound[at(c)];
      cost.values[i] = result.cell_cost[at(c)];
    } else if (f != k_none) {
      order.values[i] = result.curved->face_order(f);
      patch.values[i] =
          result.association.face2patch[at(f)] == k_none
              ? nan
              : result.association.patches[at(result.association.face2patch[at(f)])].entity;
      deviation.values[i] = result.face_deviation[at(f)];
      const Index behind = topology.face2cell[at(f)][0];
      bound.values[i] = result.cell_bound[at(behind)];
      cost.values[i] = result.cell_cost[at(behind)];
    }
  }
  std::vector<Field> fields{std::move(bound), std::move(cost), std::move(patch),
                            std::move(deviation)};
  // The file's own order of a cell says this already, unless all were elevated to one.
  if (options.uniform) fields.push_back(std::move(order));
  return fields;
}

int uniform_order(const CurveOptions& options) {
  return options.uniform ? options.orders.max_order : 0;
}

}  // namespace

CurveResult curve(const MeshData& data, GeometryModel& geometry, const CurveOptions& options,
                  const Progress& progress) {
  return run(data, nullptr, geometry, options, progress);
}

CurveResult curve(MeshData&& data, GeometryModel& geometry, const CurveOptions& options,
                  const Progress& progress) {
  return run(data, &data, geometry, options, progress);
}

MeshData exported(const CurveResult& result, const CurveOptions& options) {
  ExportMap map;
  MeshData data = export_mesh(*result.curved, uniform_order(options), &map);
  data.element_fields = fields_of(result, options, map);
  data.source = result.report.input.mesh;
  return data;
}

MeshData exported(CurveResult&& result, const CurveOptions& options, bool with_fields) {
  if (!with_fields) {
    result.association = {};
    result.cell_bound = {};
    result.cell_cost = {};
    result.face_deviation = {};
  }
  ExportMap map;
  MeshData data =
      export_mesh(std::move(*result.curved), uniform_order(options), with_fields ? &map : nullptr);
  if (with_fields) data.element_fields = fields_of(result, options, map);
  data.source = result.report.input.mesh;
  Report report = std::move(result.report);
  result = {};
  result.report = std::move(report);
  return data;
}

}  // namespace camber
