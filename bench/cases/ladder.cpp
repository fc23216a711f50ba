#include "ladder.hpp"

#include <camber/base/error.hpp>
#include <camber/elevate/apply_field.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/metric/element_quality.hpp>
#include <camber/smooth/elastic.hpp>
#include <camber/smooth/patch.hpp>

#include <algorithm>
#include <ctime>
#include <map>
#include <utility>

namespace camber::testing {
namespace {

/// CPU seconds of the process by stage of curve(), from the stages it reports.
class StageClock {
 public:
  [[nodiscard]] Progress progress() {
    Progress heard;
    heard.report = [this](std::string_view stage, double) { next(std::string(stage)); };
    return heard;
  }
  [[nodiscard]] double seconds(const std::string& stage) const {
    const auto found = seconds_.find(stage);
    return found == seconds_.end() ? 0.0 : found->second;
  }

 private:
  void next(std::string stage) {
    const std::clock_t now = std::clock();
    seconds_[stage_] += static_cast<double>(now - since_) / CLOCKS_PER_SEC;
    stage_ = std::move(stage);
    since_ = now;
  }
  std::map<std::string, double> seconds_;
  std::string stage_ = "before";
  std::clock_t since_ = std::clock();
};

/// The mesh as propagated, with nothing done to it.
void survey_start(const MeshData& data, const BodyCase& body, LadderRow& row) {
  const auto c = make_case(data, body.model(), row.settings.order);
  LayerFieldOptions layer;
  if (row.settings.start == Propagation::cell) layer.decay = Decay::cell;
  CurvedMesh curved = carried(*c, c->field(layer), row.settings.order);
  if (row.settings.start == Propagation::elastic) {
    relax_elastic(curved, all_cells(c->mesh), free_nodes(curved));
  }
  row.cells = c->mesh.cell_count();
  row.invalid_at_start = uncertified_cells(curved, all_cells(c->mesh)).size();
  row.start = mesh_cost(curved);
}

}  // namespace

MeshCost mesh_cost(const CurvedMesh& curved) {
  MeshCost total;
  double sum = 0.0;
  Points nodes;
  const std::size_t n = curved.linear().cell_count();
  for (Index c = 0; at(c) < n; ++c) {
    const int p = curved.cell_order(c);
    curved.gather(c, p, nodes);
    const ElementCost cost = element_cost(curved.linear().cell_shape[at(c)], p, nodes);
    total.minimum = std::min(total.minimum, cost.minimum);
    sum += cost.average;
  }
  total.mean = sum / static_cast<double>(n);
  return total;
}

void read_result(const CurveResult& result, LadderRow& row) {
  const Report& report = result.report;
  row.cells = result.linear->cell_count();
  row.invalid_at_end = report.validity.invalid + report.validity.undecided;
  row.patches = report.rescue.patches;
  row.smoothed_faces = report.rescue.faces_smoothed;
  row.lowered = report.rescue.orders_lowered;
  row.scaled_back = report.rescue.scaled_back;
  row.products = report.start.elastic.products;
  row.min_jacobian_ratio = report.validity.min_jacobian_ratio;
  std::map<std::pair<std::string, int>, int> iterations;
  for (const SmoothRow& step : report.smooth) {
    int& last = iterations[{step.stage, step.pass}];
    last = std::max(last, step.iteration);
  }
  row.iterations = 0;
  for (const auto& [pass, count] : iterations) row.iterations += count;
  row.end = mesh_cost(*result.curved);
}

CurveOptions curve_options(const LadderSettings& settings) {
  CurveOptions options;
  options.orders.min_order = options.orders.max_order = settings.order;
  options.propagation = settings.start;
  options.smoothing = settings.smoothing;
  options.scale = 1.0;
  return options;
}

bool is_wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

LadderRow climb_ladder(const BodyCase& body, const LadderSettings& settings) {
  LadderRow row;
  row.body = body.body;
  row.filling = body.filling;
  row.settings = settings;
  try {
    const MeshData data = body.mesh(settings.first_over_edge);
    survey_start(data, body, row);
    const std::unique_ptr<GeometryModel> model = body.model();
    StageClock clock;
    read_result(curve(data, *model, curve_options(settings), clock.progress()), row);
    row.certify_s = clock.seconds("certify");
    row.rescue_s = clock.seconds("rescue");
    row.smooth_s = clock.seconds("smooth");
  } catch (const Error& error) {
    row.error = error.what();
  }
  return row;
}

const char* name_of(Propagation start) {
  switch (start) {
    case Propagation::layer:
      return "carried";
    case Propagation::elastic:
      return "elastic";
    case Propagation::cell:
      return "cell";
  }
  return "";
}

const char* name_of(Smoothing smoothing) {
  switch (smoothing) {
    case Smoothing::automatic:
      return "auto";
    case Smoothing::marching:
      return "marching";
    case Smoothing::none:
      return "none";
  }
  return "";
}

}  // namespace camber::testing
