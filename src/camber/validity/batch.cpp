#include <camber/base/parallel.hpp>
#include <camber/validity/batch.hpp>
#include <camber/validity/detail/element_bounds.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace camber {

namespace {

using detail::DeterminantPlan;

// Elements gathered before they are sorted into lanes; fixed, so results do not depend on the
// threads.
constexpr std::size_t k_chunk = 256;

struct Gathered {
  ElementKind kind;
  std::size_t element = 0;
  std::size_t first_node = 0;  // in the chunk's node array
};

// The elements of one chunk, sorted by kind.
struct Chunk {
  std::vector<Gathered> elements;
  Points nodes, one;
};

bool same_kind(const Gathered& a, const Gathered& b) {
  return a.kind.shape == b.kind.shape && a.kind.order == b.kind.order;
}

void gather_chunk(std::size_t begin, std::size_t end, const GatherNodes& gather, Chunk& chunk) {
  chunk.elements.clear();
  chunk.nodes.clear();
  for (std::size_t i = begin; i < end; ++i) {
    chunk.one.clear();
    const ElementKind kind = gather(i, chunk.one);
    const DeterminantPlan& plan = DeterminantPlan::of(kind.shape, kind.order);
    if (dimension(kind.shape) != 3 ||
        chunk.one.size() != static_cast<std::size_t>(plan.kernel().nodes)) {
      throw std::invalid_argument("element " + std::to_string(i) + " is no " +
                                  std::string(name(kind.shape)) + " of order " +
                                  std::to_string(kind.order) + " to certify");
    }
    chunk.elements.push_back({kind, i, chunk.nodes.size()});
    chunk.nodes.insert(chunk.nodes.end(), chunk.one.begin(), chunk.one.end());
  }
  std::stable_sort(chunk.elements.begin(), chunk.elements.end(),
                   [](const Gathered& a, const Gathered& b) {
                     return a.kind.shape != b.kind.shape ? a.kind.shape < b.kind.shape
                                                         : a.kind.order < b.kind.order;
                   });
}

// Runs the kernel on elements [first, first + count) of one kind, count <= lanes; idle lanes repeat
// the first element.
detail::KernelRun run_lanes(const Chunk& chunk, std::size_t first, std::size_t count,
                            bool with_straight, detail::KernelChoice kernel,
                            detail::ElementWork& work) {
  const Gathered& head = chunk.elements[first];
  const DeterminantPlan& plan = DeterminantPlan::of(head.kind.shape, head.kind.order);
  const auto nodes = static_cast<std::size_t>(plan.kernel().nodes);
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  double* x = detail::KernelRun::node_buffer(plan, kernel.lanes, work);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Gathered& element = chunk.elements[lane < count ? first + lane : first];
    for (std::size_t n = 0; n < nodes; ++n) {
      const Vec3& point = chunk.nodes[element.first_node + n];
      for (std::size_t d = 0; d < 3; ++d) {
        x[(d * nodes + n) * lanes + lane] = point(static_cast<Eigen::Index>(d));
      }
    }
  }
  return {plan, kernel, with_straight, work};
}

// Calls visit(run, lane, element) for every element, runs being filled by kind.
template <class Visit>
void for_each_lane(std::size_t n, const GatherNodes& gather, bool with_straight,
                   const Visit& visit) {
  const detail::KernelChoice widest = detail::widest_kernel();
  parallel_for(n, k_chunk, [&](std::size_t begin, std::size_t end) {
    detail::ElementWork& work = detail::element_work();
    Chunk chunk;
    gather_chunk(begin, end, gather, chunk);
    std::size_t first = 0;
    while (first < chunk.elements.size()) {
      const Gathered& head = chunk.elements[first];
      std::size_t last = first + 1;
      while (last < chunk.elements.size() && same_kind(head, chunk.elements[last])) ++last;
      while (first < last) {
        const bool alone = last - first == 1;
        const detail::KernelChoice kernel = alone ? detail::scalar_kernel() : widest;
        const std::size_t count = std::min(last - first, static_cast<std::size_t>(kernel.lanes));
        const detail::KernelRun run =
            run_lanes(chunk, first, count, with_straight && head.kind.order > 1, kernel, work);
        for (std::size_t lane = 0; lane < count; ++lane) {
          visit(run, static_cast<int>(lane), chunk.elements[first + lane], work);
        }
        first += count;
      }
    }
  });
}

}  // namespace

std::vector<JacobianBounds> certify_all(std::size_t n, const GatherNodes& gather,
                                        const CertifyOptions& options) {
  std::vector<JacobianBounds> bounds(n);
  for_each_lane(n, gather, true,
                [&](const detail::KernelRun& run, int lane, const Gathered& element,
                    detail::ElementWork& work) {
                  bounds[element.element] =
                      detail::volume_bounds(run, lane, element.kind.order, options, work);
                });
  return bounds;
}

std::vector<Verdict> quick_verdicts(std::size_t n, const GatherNodes& gather,
                                    const CertifyOptions& options) {
  std::vector<Verdict> verdicts(n, Verdict::undecided);
  for_each_lane(n, gather, false,
                [&](const detail::KernelRun& run, int lane, const Gathered& element,
                    detail::ElementWork& work) {
                  verdicts[element.element] = detail::volume_verdict(run, lane, options, work);
                });
  return verdicts;
}

}  // namespace camber
