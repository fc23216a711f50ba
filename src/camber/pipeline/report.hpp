#pragma once
// What a run found and did: the data behind the text report and the --json file (see docs/report).
#include <camber/smooth/smooth_row.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace camber {

inline constexpr int k_histogram_bins = 10;  // of [0,1]
using Histogram = std::array<std::size_t, k_histogram_bins>;

/// Counts a value of [0, 1]; what lies outside goes to the first or last bin.
inline void count_in(Histogram& histogram, double value) {
  const double bin = std::clamp(value * k_histogram_bins, 0.0, k_histogram_bins - 1.0);
  ++histogram[static_cast<std::size_t>(bin)];
}

inline constexpr std::size_t k_worst_listed = 10;  // cells named in the report

struct WorstCell {
  GlobalId cell = 0;
  Shape shape = Shape::point;
  int order = 0;
  Vec3 centre = Vec3::Zero();
  double lower_bound = 0.0;  // certified scaled Jacobian
};

struct SurfaceRow {  // one group (patch on CAD), or one order
  std::string name;
  std::vector<std::string> cad;  // "face_3"
  int order = 0;
  std::size_t faces = 0;
  double area = 0.0;
  double average = 0.0, maximum = 0.0;  // shape conformity, eq. (1), and largest distance
  double linear_average = 0.0, linear_maximum = 0.0;  // of the linear mesh
};

struct LinkRow {  // one patch
  std::string name;
  std::vector<std::string> cad;  // "face_3"; empty: no CAD
  std::size_t faces = 0;
  double confidence = 1.0;  // share by which first choices were better than second ones
};

struct RescuePlace {
  GlobalId cell = 0;
  Shape shape = Shape::point;
  Vec3 centre = Vec3::Zero();
  double distance =
      0.0;  // what it cost: largest distance of its wall nodes to where they were placed
  std::string
      reason;  // "scaled back", "order lowered", "pinched between faces of one surface", ...
};

/// x -> R x + t, a rigid motion.
struct RigidMotion {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return rotation * x + translation; }
};

/// A pair of patches made equal (pipeline/periodic.hpp).
struct PeriodicRow {
  std::string from, to;
  RigidMotion motion;
  std::size_t faces = 0, edges = 0;
  double largest_mismatch = 0.0;  // of a linear vertex to its partner's image
  double largest_change = 0.0;    // of a node of `to` when it took its partner's place
  std::size_t refused = 0;  // entities left as they were, orders differ or a cell would lose its
                            // certificate
};

/// All elastic solves of a run (smooth/elastic.hpp).
struct ElasticWork {
  std::size_t solves = 0, unconverged = 0;
  std::size_t products = 0;       // with the stiffness, of all solves
  double largest_residual = 0.0;  // relative, of the solve that ended worst
};

/// How the wall's displacement first reached the volume (pipeline/volume_start.hpp).
struct StartReport {
  std::string asked, taken;  // "layer", "elastic", "cell"; taken: what replaced a tangled start
  std::size_t uncertified_as_asked = 0, uncertified = 0;  // cells after each
  ElasticWork elastic;                                    // of the start and of the rescue
};

struct Report {
  std::string command;        // "curve", "check", ...
  std::string status = "ok";  // ok | not_certified | scaled_back | not_periodic | ...
  int exit_code = 0;
  std::vector<std::pair<std::string, std::string>> options;  // effective options, name and value
  struct {
    std::string mesh;
    std::vector<std::string> geometry;
    std::map<Shape, std::size_t> cells;
    std::size_t nodes = 0;
  } input;
  struct {
    std::string path;
    std::map<int, std::size_t> cells_by_order;
    std::map<Shape, std::map<int, std::size_t>> cells_by_shape_and_order;
    std::size_t nodes = 0;
  } output;
  struct {  // how the mesh was linked to the CAD; only the first two and the last for tags
    std::string method, reason;         // "tags", "shape", "file", ..; why not by tags
    std::size_t faces = 0, on_cad = 0;  // boundary faces; of these on CAD faces
    std::size_t straddling = 0;         // across CAD edges: on a group of several faces
    std::size_t off_cad = 0;            // nodes on the CAD, the face not: left straight
    std::vector<LinkRow> patches;       // if it was found by shape
    std::vector<std::string> cad_without_mesh;
    double largest_distance = 0.0;  // of a linked vertex to its CAD entity
  } link;
  struct {
    std::size_t certified = 0, invalid = 0, undecided = 0;
    double min_scaled_jacobian = 1.0, min_jacobian_ratio = 1.0;
    std::vector<WorstCell> worst;  // ten lowest
  } validity;
  struct {
    double max_gap = 0.0;  // largest distance between the two sides of a face [length]
    int max_order_jump = 0;
    double model_size = 0.0;
  } conformity;
  struct {
    std::size_t faces = 0, faces_over_deviation = 0;
    double average = 0.0, maximum = 0.0, linear_average = 0.0, linear_maximum = 0.0;
    std::vector<SurfaceRow> by_group, by_order;
    std::vector<std::string> patches_without_cad;
  } surface;
  struct {
    double minimum = 1.0, average = 1.0;  // cost C of eq. (2)
    double target = 0.95;
    std::size_t below_target = 0;
    Histogram cost{}, scaled_jacobian{};
  } quality;
  StartReport start;
  std::vector<PeriodicRow> periodic;
  std::vector<SmoothRow> smooth;  // how smoothing went, if it was asked for
  struct {
    std::size_t columns = 0, wall_nodes = 0, first_cell_changed_over_1_percent = 0;
    double max_change = 0.0;
  } wall_spacing;
  struct {
    std::size_t faces_smoothed = 0;   // wall faces whose nodes slid along the CAD
    std::size_t elastic_patches = 0;  // elastic solves around cells that nothing else mended
    std::size_t load_steps = 0, patches = 0, orders_lowered = 0, scaled_back = 0;
    std::size_t put_back = 0;  // cells that smoothing made worse than any was: as before it
    std::size_t pinched = 0;   // tets with two faces or three edges on one smooth CAD face
    // --split-pinched: edges removed behind them, and cells cut from their centre instead
    std::size_t edges_removed = 0, pinched_split = 0;
    std::vector<RescuePlace> places;
    std::vector<RescuePlace> mended;  // groups of cells certified by moving volume nodes: no cost
  } rescue;
  std::vector<std::pair<std::string, double>>
      stages_s;  // read, associate, elevate, place, propagate, ...
  double total_s = 0.0;
  std::size_t peak_bytes = 0;
  std::size_t estimated_bytes = 0;  // of the peak, before the run; 0: none was made
  int threads = 0, ranks = 1;
  std::vector<std::string> warnings;
};

}  // namespace camber
