#include <camber/pipeline/text_report.hpp>
#include <camber/pipeline/text_table.hpp>
#include <camber/pipeline/version.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

#include <fmt/format.h>

namespace camber {
namespace {

constexpr std::size_t k_places_listed = 10;  // the farthest; the JSON report has all
constexpr std::size_t k_rows_listed = 12;    // of smoothing, evenly chosen; likewise
constexpr std::size_t k_line = 96;

std::string number(double value) { return fmt::format("{:.3g}", value); }
std::string number(std::size_t value) { return fmt::format("{}", value); }

std::string short_place(const Vec3& x) {
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", x.x(), x.y(), x.z());
}

std::string percent(std::size_t part, std::size_t whole) {
  return fmt::format("{:.3g} %",
                     whole ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0);
}

/// "key  items, broken at commas so that no line is too long".
std::string wrapped(const std::string& key, const std::vector<std::string>& items) {
  std::string out, line = fmt::format("{:<10} ", key);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string piece = items[i] + (i + 1 < items.size() ? ", " : "");
    if (line.size() + piece.size() > k_line && line.find_last_not_of(' ') > 10) {
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + "\n";
      line = std::string(11, ' ');
    }
    line += piece;
  }
  return out + line + "\n";
}

std::string joined(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += (out.empty() ? "" : ", ") + item;
  return out;
}

/// A sentence broken at blanks, set in under its key.
std::string sentence(const std::string& key, const std::string& text) {
  std::string out, line = fmt::format("{:<10}", key);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > k_line && line.size() > 10) {
      out.append(line).append("\n");
      line.assign(10, ' ');
    }
    line.append(" ").append(word);
  }
  return out.append(line).append("\n");
}

void add_head(const Report& report, std::string& out) {
  out += fmt::format("camber {} {}\n", version(), report.command);
  if (!report.input.mesh.empty()) out += wrapped("mesh", {report.input.mesh});
  if (!report.input.geometry.empty()) out += wrapped("geometry", report.input.geometry);
  if (!report.output.path.empty()) out += wrapped("output", {report.output.path});
  if (report.options.empty()) return;
  std::vector<std::string> options;
  for (const auto& [key, value] : report.options) options.push_back(key + " " + value);
  out += wrapped("options", options);
}

void add_cells(const Report& report, std::string& out) {
  const auto& by_shape = report.output.cells_by_shape_and_order;
  if (by_shape.empty()) return;
  const auto& by_order = report.output.cells_by_order;
  TextTable table;
  std::vector<std::string> head{"cells"};
  for (const auto& [order, count] : by_order) head.push_back(fmt::format("Q{}", order));
  head.emplace_back("all");
  table.add(head);
  const auto add_row = [&](const std::string& title, const std::map<int, std::size_t>& counts) {
    std::vector<std::string> row{title};
    std::size_t sum = 0;
    for (const auto& [order, count] : by_order) {
      const auto found = counts.find(order);
      const std::size_t n = found == counts.end() ? 0 : found->second;
      row.push_back(number(n));
      sum += n;
    }
    row.push_back(number(sum));
    table.add(row);
  };
  for (const auto& [shape, counts] : by_shape) add_row(std::string(name(shape)), counts);
  add_row("all", by_order);
  out += "\nCells by shape and order\n";
  out += table.text();
  out += fmt::format("  {} nodes", report.input.nodes);
  if (report.output.nodes > 0 && report.output.nodes != report.input.nodes) {
    out += fmt::format(" read, {} written", report.output.nodes);
  }
  out += "\n";
}

void add_validity(const Report& report, std::string& out) {
  const auto& v = report.validity;
  const std::size_t all = v.certified + v.invalid + v.undecided;
  if (all == 0) return;
  out += "\nValidity (proved bounds of the Jacobian determinant)\n";
  out += fmt::format("  {} of {} certified, {} invalid, {} undecided\n", v.certified, all,
                     v.invalid, v.undecided);
  out += fmt::format("  lowest scaled Jacobian {:.3g}, lowest ratio to the straight cell {:.3g}\n",
                     v.min_scaled_jacobian, v.min_jacobian_ratio);
  TextTable table;
  table.add({"lowest", "cell", "order", "scaled Jacobian", "centre"});
  for (const WorstCell& cell : v.worst) {
    table.add({std::string(name(cell.shape)), fmt::format("{}", cell.cell),
               fmt::format("Q{}", cell.order), number(cell.lower_bound), short_place(cell.centre)});
  }
  if (!v.worst.empty()) out += table.text();
}

/// Patches of less confidence had second choices nearly as good as the first.
constexpr double k_sure = 0.7;

/// Only what was found by shape needs telling.
void add_link(const Report& report, std::string& out) {
  const auto& link = report.link;
  if (link.method == "mesh") {
    out += fmt::format("\nGeometry: made from the mesh, there is no CAD\n  {}\n", link.reason);
  }
  if (link.method == "place") {
    out += fmt::format(
        "\nGeometry: not a CAD file, linked by place\n  {} of {} surface elements lie "
        "on it\n",
        link.on_cad, link.faces);
  }
  const bool is_by_families = link.method == "families";
  if (link.method != "shape" && !is_by_families) return;
  bool is_any = false;
  out += fmt::format("\nLink to the CAD: found by {}\n",
                     is_by_families ? "families of the mesh and shape" : "shape");
  if (!link.reason.empty()) {
    out += fmt::format("  {}{}\n", is_by_families ? "" : "why not by tags: ", link.reason);
  }
  out += fmt::format("  {} of {} boundary faces on the CAD, {} of them across CAD edges\n",
                     link.on_cad, link.faces, link.straddling);
  if (link.off_cad > 0) {
    out += fmt::format("  {} faces with all nodes near the CAD lie on none of its faces\n",
                       link.off_cad);
  }
  out += fmt::format("  largest distance of a linked vertex {:.3g}\n", link.largest_distance);
  TextTable table;
  table.add({"patch", "CAD", "faces", "confidence"});
  for (const LinkRow& row : link.patches) {
    // What is certain stands in the table of surfaces already, unless the link is all there is.
    if (report.command == "curve" && row.confidence > k_sure) continue;
    if (row.cad.empty()) continue;
    table.add({row.name, joined(row.cad), number(row.faces), number(row.confidence)});
    is_any = true;
  }
  if (is_any) out += table.text();
  if (!link.cad_without_mesh.empty()) {
    out += wrapped("  CAD faces without mesh:", link.cad_without_mesh);
  }
}

/// The paper's Tables 1 and 2, with the linear mesh beside.
void add_surface(const Report& report, std::string& out) {
  const auto& s = report.surface;
  if (s.faces > 0) {
    out += "\nSurface: distance to the CAD (mesh units), average over the area and maximum\n";
    const auto add_rows = [&](const char* title, const std::vector<SurfaceRow>& rows) {
      TextTable table;
      table.add(
          {title, "CAD", "faces", "area", "linear avg", "linear max", "curved avg", "curved max"});
      for (const SurfaceRow& row : rows) {
        const std::string cad =
            row.cad.size() > 2 ? fmt::format("{} faces", row.cad.size()) : joined(row.cad);
        table.add({row.name, cad, number(row.faces), number(row.area), number(row.linear_average),
                   number(row.linear_maximum), number(row.average), number(row.maximum)});
      }
      out += table.text();
    };
    std::vector<SurfaceRow> groups = s.by_group;
    SurfaceRow all;
    all.name = "all";
    all.faces = s.faces;
    all.average = s.average;
    all.maximum = s.maximum;
    all.linear_average = s.linear_average;
    all.linear_maximum = s.linear_maximum;
    for (const SurfaceRow& row : groups) all.area += row.area;
    groups.push_back(all);
    add_rows("group", groups);
    add_rows("order", s.by_order);
    out += fmt::format("  {} of {} faces are over the deviation asked\n", s.faces_over_deviation,
                       s.faces);
  }
  if (!s.patches_without_cad.empty()) {
    if (s.faces == 0) out += "\n";
    std::vector<std::string> names;  // one patch may be several surfaces of one name
    for (const std::string& patch : s.patches_without_cad) {
      if (std::find(names.begin(), names.end(), patch) == names.end()) names.push_back(patch);
    }
    out += wrapped("  no CAD:", names);
  }
}

void add_conformity(const Report& report, std::string& out) {
  const auto& c = report.conformity;
  if (c.model_size <= 0.0) return;
  out += "\nConformity\n";
  out += fmt::format(
      "  largest gap between cells {:.3g} mesh units = {:.3g} of the model size {:.6g}\n",
      c.max_gap, c.max_gap / c.model_size, c.model_size);
  out += fmt::format("  largest order jump between face neighbours {}\n", c.max_order_jump);
}

void add_wall(const Report& report, std::string& out) {
  const auto& w = report.wall_spacing;
  if (w.columns == 0) return;
  out += "\nWall spacing\n";
  out +=
      fmt::format("  {} columns; first cell changed by more than 1 % at {} of {} wall nodes ({})\n",
                  w.columns, w.first_cell_changed_over_1_percent, w.wall_nodes,
                  percent(w.first_cell_changed_over_1_percent, w.wall_nodes));
  out += fmt::format("  largest change {:.3g} %\n", 100.0 * w.max_change);
}

void add_quality(const Report& report, std::string& out) {
  const auto& q = report.quality;
  const auto total = [](const Histogram& h) {
    return std::accumulate(h.begin(), h.end(), std::size_t{0});
  };
  if (total(q.scaled_jacobian) == 0) return;
  out += "\nQuality\n";
  TextTable table;
  std::vector<std::string> head{"cells with values up to"};
  for (int b = 1; b <= k_histogram_bins; ++b) {
    head.push_back(fmt::format("{:.1f}", static_cast<double>(b) / k_histogram_bins));
  }
  table.add(head);
  const auto add_row = [&](const char* title, const Histogram& histogram) {
    std::vector<std::string> row{title};
    for (std::size_t n : histogram) row.push_back(number(n));
    table.add(row);
  };
  add_row("scaled Jacobian", q.scaled_jacobian);
  if (total(q.cost) > 0) {
    add_row("cost C", q.cost);
    out += fmt::format(
        "  cost C = min(1, Jp/Jc) / WCN: lowest {:.3g}, average {:.4g}, {} cells below {:g}\n",
        q.minimum, q.average, q.below_target, q.target);
  }
  out += table.text();
}

void add_start(const Report& report, std::string& out) {
  const StartReport& s = report.start;
  if (s.uncertified_as_asked == 0 && s.elastic.solves == 0) return;
  out += "\nStart (the wall's displacement carried into the volume)\n";
  out += fmt::format("  --propagate {}: {} cells not certified", s.asked, s.uncertified_as_asked);
  if (s.taken != s.asked) out += fmt::format("; replaced by {}: {}", s.taken, s.uncertified);
  out += "\n";
  if (s.elastic.solves == 0) return;
  out += fmt::format("  {} elastic solves, {} products with the stiffness, {} not converged\n",
                     s.elastic.solves, s.elastic.products, s.elastic.unconverged);
}

void add_periodic(const Report& report, std::string& out) {
  if (report.periodic.empty()) return;
  out += "\nPeriodic pairs (shapes equal to the bit after the motion)\n";
  TextTable table;
  table.add({"from = to", "faces", "edges", "vertices off by", "nodes moved by", "not equal"});
  for (const PeriodicRow& row : report.periodic) {
    table.add({row.from + " = " + row.to, number(row.faces), number(row.edges),
               number(row.largest_mismatch), number(row.largest_change), number(row.refused)});
  }
  out += table.text();
}

void add_rescue(const Report& report, std::string& out) {
  const auto& r = report.rescue;
  if (r.edges_removed + r.pinched_split > 0) {
    out += fmt::format(
        "\nPinched between faces of one surface: {} edges behind such tets removed, {} cells cut "
        "from their centre\n",
        r.edges_removed, r.pinched_split);
  }
  if (r.scaled_back + r.orders_lowered + r.pinched + r.places.size() == 0) return;
  out += "\nRescue (where no valid curved state was found)\n";
  out += fmt::format(
      "  {} cells scaled back, {} orders lowered, {} cells pinched between faces of one surface\n",
      r.scaled_back, r.orders_lowered, r.pinched);
  TextTable table;
  table.add({"place", "cell", "off by", "centre", "reason"});
  std::vector<RescuePlace> places = r.places;
  std::stable_sort(places.begin(), places.end(), [](const RescuePlace& a, const RescuePlace& b) {
    return a.distance > b.distance;
  });
  places.resize(std::min(places.size(), k_places_listed));
  for (const RescuePlace& p : places) {
    table.add({std::string(name(p.shape)), fmt::format("{}", p.cell), number(p.distance),
               short_place(p.centre), p.reason});
  }
  if (!r.places.empty()) out += table.text();
  if (r.places.size() > k_places_listed) {
    out += fmt::format("  and {} more (all in the --json report)\n",
                       r.places.size() - k_places_listed);
  }
}

void add_smooth(const Report& report, std::string& out) {
  const std::vector<SmoothRow>& rows = report.smooth;
  const std::size_t all = rows.size(), listed = std::min(all, k_rows_listed);
  if (all == 0) return;
  out += "\nSmoothing (cost C of the elements of the stage)\n";
  TextTable table;
  table.add({"stage", "pass", "iteration", "active nodes", "negative", "raised", "worst C", "at",
             "element"});
  for (std::size_t i = 0; i < listed; ++i) {
    const SmoothRow& row = rows[listed == 1 ? 0 : i * (all - 1) / (listed - 1)];
    table.add({row.stage, fmt::format("{}", row.pass), fmt::format("{}", row.iteration),
               number(row.active_nodes), number(row.negative_elements),
               number(row.elevated_elements), number(row.worst_cost), short_place(row.place),
               fmt::format("{} {} Q{}", name(row.shape), row.element, row.order)});
  }
  out += table.text();
  if (report.rescue.put_back > 0) {
    out += fmt::format("  {} cells came out worse than any was and got their shape back\n",
                       report.rescue.put_back);
  }
}

void add_foot(const Report& report, std::string& out) {
  out += "\n";
  std::vector<std::string> stages;
  for (const auto& [stage, seconds] : report.stages_s) {
    stages.push_back(fmt::format("{} {:.2f}", stage, seconds));
  }
  out += wrapped("time", {fmt::format("{:.2f} s on {} threads", report.total_s, report.threads)});
  if (!stages.empty()) out += wrapped("  stages", stages);
  if (report.peak_bytes > 0) {
    out += wrapped("memory", {fmt::format("{:.0f} MiB at most",
                                          static_cast<double>(report.peak_bytes) / 1048576.0)});
  }
  for (const std::string& warning : report.warnings) out += sentence("warning", warning);
  out += wrapped("result", {report.status});
}

}  // namespace

std::string text_report(const Report& report) {
  std::string out;
  add_head(report, out);
  add_cells(report, out);
  add_link(report, out);
  add_surface(report, out);
  add_validity(report, out);
  add_conformity(report, out);
  add_wall(report, out);
  add_quality(report, out);
  add_periodic(report, out);
  add_start(report, out);
  add_rescue(report, out);
  add_smooth(report, out);
  add_foot(report, out);
  return out;
}

}  // namespace camber
