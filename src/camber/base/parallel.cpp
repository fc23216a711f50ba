#include <camber/base/parallel.hpp>

#include <algorithm>
#include <exception>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace camber {

struct ThreadLimit::Impl {
  explicit Impl(int threads)
      : control(
            tbb::global_control::max_allowed_parallelism,
            static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency())) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) : impl_(std::make_unique<Impl>(threads)) {}
ThreadLimit::~ThreadLimit() = default;

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  grain = std::max<std::size_t>(1, grain);
  const std::size_t chunks = (n + grain - 1) / grain;
  if (chunks == 1) {
    body(0, n);
    return;
  }
  std::vector<std::exception_ptr> failures(chunks);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    // Isolated: a body that waits inside must not pick up another chunk on the same thread state.
    tbb::this_task_arena::isolate([&] {
      try {
        body(c * grain, std::min(n, (c + 1) * grain));
      } catch (...) {
        failures[c] = std::current_exception();
      }
    });
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

double ordered_sum(std::size_t n, const std::function<double(std::size_t)>& term) {
  constexpr std::size_t k_block = 1024;
  std::vector<double> partial((n + k_block - 1) / k_block, 0.0);
  parallel_for(n, k_block, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    partial[begin / k_block] = sum;
  });
  double total = 0.0;
  for (double p : partial) total += p;
  return total;
}

namespace detail {

std::size_t slot() {
  const int index = tbb::this_task_arena::current_thread_index();
  return index < 0 ? 0 : static_cast<std::size_t>(index);
}

std::size_t slots() {
  return static_cast<std::size_t>(std::max(tbb::this_task_arena::max_concurrency(), 1)) + 1;
}

}  // namespace detail
}  // namespace camber
