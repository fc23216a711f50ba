// The paper's cost of one element at its survey points: elements a second by shape and order.
#include <camber/basis/lattice.hpp>
#include <camber/metric/element_quality.hpp>

#include <benchmark/benchmark.h>
#include <cmath>
#include <string>
#include <vector>

namespace camber {
namespace {

Points bent_element(Shape shape, int p) {
  Points nodes;
  for (const Vec3& x : lattice_xi(shape, p)) {
    nodes.push_back(
        x + 0.06 * Vec3(std::sin(2.0 * x.y()), std::cos(1.5 * x.z()), std::sin(x.x() + x.y())));
  }
  return nodes;
}

void cost_of_element(benchmark::State& state, Shape shape, int p) {
  const Points nodes = bent_element(shape, p);
  for (auto _ : state) benchmark::DoNotOptimize(element_cost(shape, p, nodes));
  state.counters["elements/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(nodes.size() * sizeof(Vec3)));
}

/// As in the pipeline: many cells of one kind, in the lanes of the processor, one thread.
void cost_of_cells(benchmark::State& state, Shape shape, int p) {
  constexpr std::size_t k_elements = 256;
  const Points one = bent_element(shape, p);
  Points nodes;
  for (std::size_t i = 0; i < k_elements; ++i) nodes.insert(nodes.end(), one.begin(), one.end());
  std::vector<ElementCost> costs(k_elements);
  for (auto _ : state) {
    element_costs(shape, p, nodes, costs);
    benchmark::DoNotOptimize(costs.data());
  }
  state.counters["elements/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * k_elements, benchmark::Counter::kIsRate);
}

[[maybe_unused]] const bool k_registered = [] {
  for (Shape shape : {Shape::triangle, Shape::quadrilateral, Shape::tetrahedron, Shape::pyramid,
                      Shape::prism, Shape::hexahedron}) {
    for (int p = 1; p <= k_max_order; ++p) {
      const std::string title = "cost/" + std::string(name(shape)) + "/Q" + std::to_string(p);
      benchmark::RegisterBenchmark(
          title.c_str(), [=](benchmark::State& state) { cost_of_element(state, shape, p); });
      if (dimension(shape) < 3) continue;
      benchmark::RegisterBenchmark(("cells-" + title).c_str(), [=](benchmark::State& state) {
        cost_of_cells(state, shape, p);
      });
    }
  }
  return true;
}();

}  // namespace
}  // namespace camber
