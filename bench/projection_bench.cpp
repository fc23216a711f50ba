// Closest points and crossings: projections a second, with and without a seed.
#include <camber/geom/analytic_model.hpp>
#include <camber/geom_occ/cad_file.hpp>

#include <benchmark/benchmark.h>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "random_wall.hpp"

namespace camber {
namespace {

constexpr int k_queries = 256;
/// Queries lie this far off the surface, and their seeds this far from the foot (parts of the size,
/// of the parameters' range): about what a boundary face of a coarse mesh asks for.
constexpr double k_height = 0.01, k_seed_offset = 0.02;

struct Query {
  Vec3 x, normal;
  Vec2 seed;
};

/// Points off the face, over the middle of its box so that they stay inside of its trim.
std::vector<Query> queries(const GeometryModel& model, int face) {
  const auto projector = model.projector();
  const Box box = model.box({2, face});
  const double size = box.diagonal();
  std::vector<Query> all;
  for (int i = 0; all.size() < k_queries && i < 16 * k_queries; ++i) {
    // The golden ratio's sequence fills the box evenly.
    const Vec3 share(std::fmod(0.8191725134 * i, 1.0), std::fmod(0.6710436067 * i, 1.0),
                     std::fmod(0.5497004779 * i, 1.0));
    const Vec3 start = box.lower + share.cwiseProduct(box.upper - box.lower);
    const Projection foot = projector->closest({2, face}, start);
    if (foot.status != ProjectionStatus::inside) continue;
    const SurfacePoint at_foot = projector->evaluate_face(face, foot.uv);
    const Vec2 step(k_seed_offset * size / at_foot.du.norm(),
                    -k_seed_offset * size / at_foot.dv.norm());
    if (!step.allFinite()) continue;
    all.push_back(
        {at_foot.point + k_height * size * at_foot.normal, at_foot.normal, foot.uv + step});
  }
  return all;
}

enum class Kind { seeded, global, along_line };

void project(benchmark::State& state, const GeometryModel& model, int face, Kind kind) {
  const auto projector = model.projector();
  const std::vector<Query> all = queries(model, face);
  if (all.empty()) {
    state.SkipWithError("no query lies over the face");
    return;
  }
  const double reach = 0.1 * model.box({2, face}).diagonal();
  for (auto _ : state) {
    for (const Query& query : all) {
      if (kind == Kind::along_line) {
        benchmark::DoNotOptimize(
            projector->along_line(face, query.x, query.normal, reach, query.seed));
      } else {
        benchmark::DoNotOptimize(projector->closest(
            {2, face}, query.x,
            kind == Kind::seeded ? std::optional<Vec2>(query.seed) : std::nullopt));
      }
    }
  }
  state.counters["projections/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(all.size()),
                         benchmark::Counter::kIsRate);
}

struct Surface {
  const char* name;
  std::shared_ptr<const GeometryModel> model;
  int face;
};

[[maybe_unused]] const bool k_registered = [] {
  const std::string cases = std::string(CAMBER_SOURCE_DIR) + "/cases/";
  const std::vector<Surface> surfaces{
      {"sphere", make_sphere(Vec3::Zero(), 1.0), 1},
      {"ellipsoid", make_ellipsoid(Vec3::Zero(), {3.0, 1.0, 0.5}), 1},
      {"own-bspline", testing::random_case(1).model, 1},
      {"step-sphere", read_cad(cases + "ball/body.step"), 1},
      {"step-bspline-wing", read_cad(cases + "wing/body.step"), 1}};
  for (const Surface& surface : surfaces) {
    for (const auto& [kind, title] : {std::pair{Kind::seeded, "seeded/"},
                                      {Kind::global, "global/"},
                                      {Kind::along_line, "line/"}}) {
      benchmark::RegisterBenchmark((title + std::string(surface.name)).c_str(),
                                   [surface, kind = kind](benchmark::State& state) {
                                     project(state, *surface.model, surface.face, kind);
                                   });
    }
  }
  return true;
}();

}  // namespace
}  // namespace camber
