#include <camber/pipeline/text_report.hpp>
#include <camber/pipeline/version.hpp>

#include <nlohmann/json.hpp>

namespace camber {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<Shape, 4> k_cell_shapes{Shape::tetrahedron, Shape::pyramid, Shape::prism,
                                             Shape::hexahedron};

Json to_json(const Vec3& x) { return Json::array({x.x(), x.y(), x.z()}); }

template <class Key>
std::size_t count_of(const std::map<Key, std::size_t>& counts, const Key& key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

Json orders(const std::map<int, std::size_t>& counts) {
  Json json = Json::object();
  for (int p = 1; p <= k_max_order; ++p) json[std::to_string(p)] = count_of(counts, p);
  for (const auto& [p, n] : counts) json[std::to_string(p)] = n;
  return json;
}

Json input(const Report& report) {
  Json cells = Json::object();
  for (Shape shape : k_cell_shapes) cells[name(shape)] = count_of(report.input.cells, shape);
  return {{"mesh", report.input.mesh},
          {"geometry", report.input.geometry},
          {"cells", cells},
          {"nodes", report.input.nodes}};
}

Json output(const Report& report) {
  Json by_shape = Json::object();
  for (const auto& [shape, counts] : report.output.cells_by_shape_and_order) {
    by_shape[name(shape)] = orders(counts);
  }
  return {{"path", report.output.path},
          {"cells_by_order", orders(report.output.cells_by_order)},
          {"cells_by_shape_and_order", by_shape},
          {"nodes", report.output.nodes}};
}

Json validity(const Report& report) {
  Json worst = Json::array();
  for (const WorstCell& cell : report.validity.worst) {
    worst.push_back({{"cell", cell.cell},
                     {"shape", name(cell.shape)},
                     {"order", cell.order},
                     {"centre", to_json(cell.centre)},
                     {"lower_bound", cell.lower_bound}});
  }
  return {{"certified", report.validity.certified},
          {"invalid", report.validity.invalid},
          {"undecided", report.validity.undecided},
          {"min_scaled_jacobian", report.validity.min_scaled_jacobian},
          {"min_jacobian_ratio", report.validity.min_jacobian_ratio},
          {"worst", worst}};
}

Json link_patches(const Report& report) {
  Json patches = Json::array();
  for (const LinkRow& row : report.link.patches) {
    patches.push_back({{"name", row.name},
                       {"cad", row.cad},
                       {"faces", row.faces},
                       {"confidence", row.confidence}});
  }
  return patches;
}

Json surface(const Report& report) {
  Json groups = Json::array(), by_order = Json::array();
  for (const SurfaceRow& row : report.surface.by_group) {
    groups.push_back({{"name", row.name},
                      {"cad", row.cad},
                      {"faces", row.faces},
                      {"area", row.area},
                      {"average", row.average},
                      {"maximum", row.maximum},
                      {"linear_average", row.linear_average},
                      {"linear_maximum", row.linear_maximum}});
  }
  for (const SurfaceRow& row : report.surface.by_order) {
    by_order.push_back({{"order", row.order},
                        {"faces", row.faces},
                        {"average", row.average},
                        {"maximum", row.maximum},
                        {"linear_average", row.linear_average},
                        {"linear_maximum", row.linear_maximum}});
  }
  return {{"faces", report.surface.faces},
          {"faces_over_deviation", report.surface.faces_over_deviation},
          {"average", report.surface.average},
          {"maximum", report.surface.maximum},
          {"linear_average", report.surface.linear_average},
          {"linear_maximum", report.surface.linear_maximum},
          {"by_group", groups},
          {"by_order", by_order},
          {"patches_without_cad", report.surface.patches_without_cad}};
}

Json list_of(const std::vector<RescuePlace>& places) {
  Json list = Json::array();
  for (const RescuePlace& place : places) {
    list.push_back({{"cell", place.cell},
                    {"shape", name(place.shape)},
                    {"centre", to_json(place.centre)},
                    {"distance", place.distance},
                    {"reason", place.reason}});
  }
  return list;
}

Json rescue(const Report& report) {
  return {{"load_steps", report.rescue.load_steps},
          {"patches", report.rescue.patches},
          {"faces_smoothed", report.rescue.faces_smoothed},
          {"orders_lowered", report.rescue.orders_lowered},
          {"scaled_back", report.rescue.scaled_back},
          {"put_back", report.rescue.put_back},
          {"pinched", report.rescue.pinched},
          {"elastic_patches", report.rescue.elastic_patches},
          {"edges_removed", report.rescue.edges_removed},
          {"pinched_split", report.rescue.pinched_split},
          {"mended", list_of(report.rescue.mended)},
          {"places", list_of(report.rescue.places)}};
}

Json start(const StartReport& start) {
  return {{"asked", start.asked},
          {"taken", start.taken},
          {"uncertified_as_asked", start.uncertified_as_asked},
          {"uncertified", start.uncertified},
          {"elastic",
           {{"solves", start.elastic.solves},
            {"unconverged", start.elastic.unconverged},
            {"products", start.elastic.products},
            {"largest_residual", start.elastic.largest_residual}}}};
}

Json periodic(const Report& report) {
  Json rows = Json::array();
  for (const PeriodicRow& row : report.periodic) {
    Json rotation = Json::array();
    for (int i = 0; i < 3; ++i) rotation.push_back(to_json(row.motion.rotation.row(i).transpose()));
    rows.push_back({{"from", row.from},
                    {"to", row.to},
                    {"rotation", rotation},
                    {"translation", to_json(row.motion.translation)},
                    {"faces", row.faces},
                    {"edges", row.edges},
                    {"largest_mismatch", row.largest_mismatch},
                    {"largest_change", row.largest_change},
                    {"refused", row.refused}});
  }
  return rows;
}

Json smooth(const Report& report) {
  Json rows = Json::array();
  for (const SmoothRow& row : report.smooth) {
    rows.push_back({{"stage", row.stage},
                    {"pass", row.pass},
                    {"iteration", row.iteration},
                    {"active_nodes", row.active_nodes},
                    {"negative_elements", row.negative_elements},
                    {"elevated_elements", row.elevated_elements},
                    {"worst_cost", row.worst_cost},
                    {"place", to_json(row.place)},
                    {"element", row.element},
                    {"shape", name(row.shape)},
                    {"order", row.order}});
  }
  return rows;
}

Json pairs(const std::vector<std::pair<std::string, std::string>>& list) {
  Json json = Json::object();
  for (const auto& [key, value] : list) json[key] = value;
  return json;
}

Json time(const Report& report) {
  Json stages = Json::object();
  for (const char* stage : {"read", "associate", "elevate", "place", "propagate", "certify",
                            "smooth", "write", "verify"}) {
    stages[stage] = 0.0;
  }
  for (const auto& [stage, seconds] : report.stages_s) stages[stage] = seconds;
  return {{"total_s", report.total_s}, {"stages_s", stages}};
}

}  // namespace

std::string json_report(const Report& report) {
  Json json;
  json["camber"] = {{"version", version()}};
  json["command"] = report.command;
  json["status"] = report.status;
  json["exit_code"] = report.exit_code;
  json["options"] = pairs(report.options);
  json["input"] = input(report);
  json["output"] = output(report);
  json["validity"] = validity(report);
  json["conformity"] = {{"max_gap", report.conformity.max_gap},
                        {"max_order_jump", report.conformity.max_order_jump},
                        {"model_size", report.conformity.model_size}};
  json["link"] = {{"method", report.link.method},
                  {"reason", report.link.reason},
                  {"faces", report.link.faces},
                  {"on_cad", report.link.on_cad},
                  {"straddling", report.link.straddling},
                  {"off_cad", report.link.off_cad},
                  {"patches", link_patches(report)},
                  {"cad_without_mesh", report.link.cad_without_mesh},
                  {"largest_distance", report.link.largest_distance}};
  json["surface"] = surface(report);
  json["quality"] = {{"cost",
                      {{"minimum", report.quality.minimum},
                       {"average", report.quality.average},
                       {"target", report.quality.target},
                       {"below_target", report.quality.below_target},
                       {"histogram", report.quality.cost}}},
                     {"scaled_jacobian", {{"histogram", report.quality.scaled_jacobian}}}};
  json["wall_spacing"] = {
      {"columns", report.wall_spacing.columns},
      {"wall_nodes", report.wall_spacing.wall_nodes},
      {"first_cell_changed_over_1_percent", report.wall_spacing.first_cell_changed_over_1_percent},
      {"max_change", report.wall_spacing.max_change}};
  json["start"] = start(report.start);
  json["rescue"] = rescue(report);
  json["periodic"] = periodic(report);
  json["smooth"] = smooth(report);
  json["time"] = time(report);
  json["memory"] = {{"peak_bytes", report.peak_bytes}, {"estimated_bytes", nullptr}};
  if (report.estimated_bytes > 0) json["memory"]["estimated_bytes"] = report.estimated_bytes;
  json["threads"] = report.threads;
  json["ranks"] = report.ranks;
  json["warnings"] = report.warnings;
  // Names come from the user's files, in any encoding.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace camber
