#pragma once
#include <cstddef>
#include <functional>
#include <memory>

namespace camber {

/// Bounds the number of threads used by every parallel_for while it lives (0: all of the machine).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Threads that parallel_for may use now.
[[nodiscard]] int thread_count();

/// Calls body(begin, end) over disjoint ranges that cover [0, n). Ranges are cut at multiples of
/// `grain` whatever the number of threads, so a body that writes only to its own range gives the
/// same bits for any thread count. The first exception (lowest range) is rethrown after all
/// finished.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// The same with a state per running thread: make() is called at most once a thread (projectors,
/// work arrays). The state must not influence results.
template <class Make, class Body>
void parallel_for_with(std::size_t n, std::size_t grain, const Make& make, const Body& body);

/// Sum of term(i), i < n, in fixed blocks of 1024 added in order: same bits for any thread count.
[[nodiscard]] double ordered_sum(std::size_t n, const std::function<double(std::size_t)>& term);

namespace detail {
/// Slot of the running thread in [0, slots()): stable while a task body runs.
[[nodiscard]] std::size_t slot();
[[nodiscard]] std::size_t slots();
}  // namespace detail

template <class Make, class Body>
void parallel_for_with(std::size_t n, std::size_t grain, const Make& make, const Body& body) {
  using State = decltype(make());
  std::unique_ptr<State[]> states(new State[detail::slots()]{});
  std::unique_ptr<bool[]> made(new bool[detail::slots()]{});
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    const std::size_t s = detail::slot();
    if (!made[s]) {
      states[s] = make();
      made[s] = true;
    }
    body(begin, end, states[s]);
  });
}

}  // namespace camber
