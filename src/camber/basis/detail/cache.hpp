#pragma once
// Tables that are computed once and then shared by all threads.
#include <camber/basis/shape.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace camber::detail {

/// Slots of tables kept by shape and order (or one more small number below 32).
inline constexpr std::size_t k_fast_keys = static_cast<std::size_t>(k_shape_count) * 32;

/// Lazy tables by a small integer key. Addresses are stable for the life of the cache. Keys below
/// `Slots` cost one atomic load once built; larger ones a mutex. Two threads may build the same
/// table at once, the first one in is kept: so make() must be a pure function of the key. It may
/// use other keys of the same cache.
template <class T, std::size_t Slots>
class Cache {
 public:
  template <class Make>
  [[nodiscard]] const T& get(std::size_t key, const Make& make) {
    if (key < Slots) {
      if (const T* known = fast_[key].load(std::memory_order_acquire)) return *known;
    } else {
      const std::lock_guard lock(mutex_);
      if (const auto known = tables_.find(key); known != tables_.end()) return *known->second;
    }
    auto made = std::make_unique<const T>(make());
    const std::lock_guard lock(mutex_);
    const auto place = tables_.try_emplace(key, std::move(made)).first;
    if (key < Slots) fast_[key].store(place->second.get(), std::memory_order_release);
    return *place->second;
  }

 private:
  std::array<std::atomic<const T*>, Slots> fast_{};
  std::mutex mutex_;
  std::map<std::size_t, std::unique_ptr<const T>> tables_;
};

/// Key of (shape, order): dense, k_shape_count keys an order.
[[nodiscard]] inline std::size_t cache_key(Shape shape, int order) {
  return static_cast<std::size_t>(shape) +
         static_cast<std::size_t>(k_shape_count) * static_cast<std::size_t>(order);
}

/// Key of (shape, p, q): dense over the square p, q < m for every m (Szudzik's pairing).
[[nodiscard]] inline std::size_t cache_key(Shape shape, int p, int q) {
  return cache_key(shape, p < q ? q * q + p : p * p + p + q);
}

}  // namespace camber::detail
