#pragma once
// Private: a raster over a face's parameter rectangle that answers most "is it inside the loops" at
// once.
#include <camber/geom/parametric.hpp>

#include <functional>
#include <vector>

#include <Geom2d_Curve.hxx>
#include <gp_Pnt2d.hxx>

namespace camber::occ {

/// Cells away from every loop are inside or outside as a whole; immutable after construction.
class TrimGrid {
 public:
  enum class State : unsigned char { unknown, inside, outside };
  struct Loop {
    Handle(Geom2d_Curve) curve;
    double first = 0.0, last = 1.0;
  };

  TrimGrid() = default;
  /// @param contains exact test, asked once for each connected group of cells that no loop touches
  TrimGrid(const UvBox& limits, const std::vector<Loop>& loops,
           const std::function<bool(const Vec2&)>& contains);

  /// unknown near a loop (and everywhere in an empty grid): ask the exact test.
  [[nodiscard]] State at(const Vec2& uv) const;

 private:
  [[nodiscard]] Vec2 in_cells(const Vec2& uv) const;
  void mark(const Loop& loop, double t0, const Vec2& p0, double t1, const Vec2& p1, int depth);
  void mark_around(const Vec2& p);

  UvBox limits_;
  std::vector<State> cells_;
};

}  // namespace camber::occ
