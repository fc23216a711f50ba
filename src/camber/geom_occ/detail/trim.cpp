#include <camber/geom_occ/detail/trim.hpp>

namespace camber::occ {
namespace {

/// Parameter distance, relative to the rectangle, that counts as "on a loop".
constexpr double k_on_loop = 1e-10;

}  // namespace

bool Trim::contains(const Vec2& uv) {
  const Vec2 p = face_.wrapped(uv);
  const Vec2 range = face_.limits.upper - face_.limits.lower;
  for (int k = 0; k < 2; ++k)
    if (p[k] < face_.limits.lower[k] - k_on_loop * range[k] ||
        p[k] > face_.limits.upper[k] + k_on_loop * range[k])
      return false;
  if (face_.is_rectangle) return true;
  if (const TrimGrid::State state = face_.trim.at(p); state != TrimGrid::State::unknown)
    return state == TrimGrid::State::inside;
  if (!classifier_)
    classifier_ =
        std::make_unique<BRepTopAdaptor_FClass2d>(face_.face, k_on_loop * range.minCoeff());
  return classifier_->Perform(gp_Pnt2d(p[0], p[1]), true) != TopAbs_OUT;
}

}  // namespace camber::occ
