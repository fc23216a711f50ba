// Certification: elements a second by shape and order.
#include <camber/base/parallel.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/validity/batch.hpp>

#include <benchmark/benchmark.h>
#include <cmath>

namespace camber {
namespace {

constexpr std::size_t k_elements = 2048;

/// A smoothly bent element that is far from linear and valid, a little different for each i.
void bent_element(Shape shape, int p, std::size_t i, Points& nodes) {
  const double phase = 0.01 * static_cast<double>(i);
  const std::span<const Vec3> xi = lattice_xi(shape, p);
  nodes.resize(xi.size());
  for (std::size_t n = 0; n < xi.size(); ++n) {
    const Vec3& x = xi[n];
    nodes[n] = x + 0.06 * Vec3(std::sin(2.0 * x.y() + phase), std::cos(1.5 * x.z() - phase),
                               std::sin(x.x() + x.y() + phase));
  }
}

/// As in the pipeline: certify_all on one thread (verdict and bounds), or verdicts alone.
void certify_elements(benchmark::State& state, Shape shape, int p, bool is_verdict_only) {
  const ThreadLimit limit(1);
  std::vector<Points> elements(k_elements);
  for (std::size_t i = 0; i < k_elements; ++i) bent_element(shape, p, i, elements[i]);
  const GatherNodes gather = [&](std::size_t i, Points& nodes) {
    nodes.assign(elements[i].begin(), elements[i].end());
    return ElementKind{shape, p};
  };
  for (auto _ : state) {
    if (is_verdict_only) {
      benchmark::DoNotOptimize(quick_verdicts(k_elements, gather));
    } else {
      benchmark::DoNotOptimize(certify_all(k_elements, gather));
    }
  }
  const double done = static_cast<double>(state.iterations()) * k_elements;
  state.counters["elements/s"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
  state.SetBytesProcessed(static_cast<std::int64_t>(done) * node_count(shape, p) *
                          static_cast<std::int64_t>(sizeof(Vec3)));
}

[[maybe_unused]] const bool k_registered = [] {
  for (Shape shape : {Shape::tetrahedron, Shape::pyramid, Shape::prism, Shape::hexahedron}) {
    for (int p = 2; p <= k_max_order; ++p) {
      for (bool is_verdict_only : {true, false}) {
        const std::string title = (is_verdict_only ? "verdict/" : "bounds/") +
                                  std::string(name(shape)) + "/Q" + std::to_string(p);
        benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) {
          certify_elements(state, shape, p, is_verdict_only);
        });
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace camber
