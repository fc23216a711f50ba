#include <camber/validity/detail/element_bounds.hpp>

#include <cstdint>

namespace camber::detail {

namespace {

constexpr std::size_t k_alignment = 64;  // of the widest vectors

const double* lane_of(const double* values, int size, int lanes, int lane,
                      std::vector<double>& store) {
  if (lanes == 1) return values;
  store.resize(static_cast<std::size_t>(size));
  for (int n = 0; n < size; ++n) store[static_cast<std::size_t>(n)] = values[n * lanes + lane];
  return store.data();
}

}  // namespace

double* AlignedBuffer::of(std::size_t size) {
  constexpr std::size_t extra = k_alignment / sizeof(double);
  if (storage_.size() < size + extra) storage_.resize(size + extra);
  const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
  const std::size_t skip = (k_alignment - address % k_alignment) % k_alignment;
  return storage_.data() + skip / sizeof(double);
}

ElementWork& element_work() {
  thread_local ElementWork work;
  return work;
}

double* KernelRun::node_buffer(const DeterminantPlan& plan, int lanes, ElementWork& work) {
  return work.nodes.of(3 * static_cast<std::size_t>(plan.kernel().nodes * lanes));
}

KernelRun::KernelRun(const DeterminantPlan& plan, KernelChoice kernel, bool with_straight,
                     ElementWork& work)
    : plan_(plan), lanes_(kernel.lanes) {
  constexpr std::size_t k_summaries = 9;
  const auto lanes = static_cast<std::size_t>(lanes_);
  const std::size_t size = static_cast<std::size_t>(plan.kernel().size) * lanes;
  double* next = work.output.of(2 * size + k_summaries * lanes);
  for (double** place : {&out_.coefficients, &out_.straight_coefficients}) {
    *place = next;
    next += size;
  }
  for (double** place :
       {&out_.margin, &out_.straight_margin, &out_.lowest, &out_.highest, &out_.corner_lowest,
        &out_.corner_highest, &out_.ratio_lowest, &out_.ratio_corner, &out_.finite}) {
    *place = next;
    next += lanes;
  }
  double* scratch = work.scratch.of(static_cast<std::size_t>(plan.work()) * lanes);
  kernel.run(plan.kernel(), with_straight ? &plan.straight() : nullptr,
             node_buffer(plan, lanes_, work), scratch, out_);
}

const double* KernelRun::curved(int lane, ElementWork& work) const {
  return lane_of(out_.coefficients, plan_.kernel().size, lanes_, lane, work.curved);
}

const double* KernelRun::straight(int lane, ElementWork& work) const {
  return lane_of(out_.straight_coefficients, plan_.kernel().size, lanes_, lane, work.straight);
}

}  // namespace camber::detail
