#include <camber/geom_occ/detail/trim_grid.hpp>

#include <algorithm>
#include <cmath>

namespace camber::occ {
namespace {

constexpr int k_cells = 128;  // a direction
// Samples of a loop are at most this many cells apart; each marks its own cell and the eight around
// it.
constexpr double k_sample_distance = 0.4;
constexpr int k_first_samples = 16;
constexpr int k_max_depth = 16;
constexpr auto k_open = static_cast<TrimGrid::State>(3);  // not on a loop, not yet classified

std::size_t index(int i, int j) { return static_cast<std::size_t>(i * k_cells + j); }

}  // namespace

TrimGrid::TrimGrid(const UvBox& limits, const std::vector<Loop>& loops,
                   const std::function<bool(const Vec2&)>& contains)
    : limits_(limits), cells_(index(k_cells, 0), k_open) {
  for (const Loop& loop : loops) {
    const auto point = [&](double t) {
      const gp_Pnt2d p = loop.curve->Value(t);
      return in_cells({p.X(), p.Y()});
    };
    for (int k = 0; k < k_first_samples; ++k) {
      const double t0 = std::lerp(loop.first, loop.last, k / static_cast<double>(k_first_samples));
      const double t1 =
          std::lerp(loop.first, loop.last, (k + 1) / static_cast<double>(k_first_samples));
      mark(loop, t0, point(t0), t1, point(t1), 0);
    }
  }
  const Vec2 cell = (limits.upper - limits.lower) / k_cells;
  std::vector<std::pair<int, int>> front;
  for (int i = 0; i < k_cells; ++i) {
    for (int j = 0; j < k_cells; ++j) {
      if (cells_[index(i, j)] != k_open) continue;
      const Vec2 centre = limits.lower + cell.cwiseProduct(Vec2(i + 0.5, j + 0.5));
      const State state = contains(centre) ? State::inside : State::outside;
      cells_[index(i, j)] = state;
      front.assign(1, {i, j});
      while (!front.empty()) {
        const auto [a, b] = front.back();
        front.pop_back();
        for (const auto& [x, y] :
             {std::pair(a - 1, b), std::pair(a + 1, b), std::pair(a, b - 1), std::pair(a, b + 1)}) {
          if (x < 0 || y < 0 || x >= k_cells || y >= k_cells || cells_[index(x, y)] != k_open)
            continue;
          cells_[index(x, y)] = state;
          front.emplace_back(x, y);
        }
      }
    }
  }
}

TrimGrid::State TrimGrid::at(const Vec2& uv) const {
  if (cells_.empty()) return State::unknown;
  const Vec2 p = in_cells(uv);
  if (!(p.minCoeff() >= 0.0) || !(p.maxCoeff() < k_cells)) return State::unknown;
  return cells_[index(static_cast<int>(p[0]), static_cast<int>(p[1]))];
}

Vec2 TrimGrid::in_cells(const Vec2& uv) const {
  return k_cells * (uv - limits_.lower).cwiseQuotient(limits_.upper - limits_.lower);
}

void TrimGrid::mark(const Loop& loop, double t0, const Vec2& p0, double t1, const Vec2& p1,
                    int depth) {
  mark_around(p0);
  mark_around(p1);
  const double middle = 0.5 * (t0 + t1);
  const gp_Pnt2d kernel = loop.curve->Value(middle);
  const Vec2 p = in_cells({kernel.X(), kernel.Y()});
  if (std::max((p - p0).norm(), (p1 - p).norm()) <= k_sample_distance || depth >= k_max_depth) {
    mark_around(p);
    return;
  }
  mark(loop, t0, p0, middle, p, depth + 1);
  mark(loop, middle, p, t1, p1, depth + 1);
}

void TrimGrid::mark_around(const Vec2& p) {
  const int i = static_cast<int>(std::floor(std::clamp(p[0], -2.0, k_cells + 2.0)));
  const int j = static_cast<int>(std::floor(std::clamp(p[1], -2.0, k_cells + 2.0)));
  for (int a = std::max(0, i - 1); a <= std::min(k_cells - 1, i + 1); ++a)
    for (int b = std::max(0, j - 1); b <= std::min(k_cells - 1, j + 1); ++b)
      cells_[index(a, b)] = State::unknown;
}

}  // namespace camber::occ
