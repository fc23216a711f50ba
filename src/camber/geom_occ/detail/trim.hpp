#pragma once
// Private: is a parameter point inside the loops of a face? One object per projector (kernel
// caches).
#include <camber/geom_occ/detail/face_data.hpp>

#include <memory>

#include <BRepTopAdaptor_FClass2d.hxx>

namespace camber::occ {

class Trim {
 public:
  explicit Trim(const FaceData& face) : face_(face) {}
  /// Inside the loops or on them; uv in any period.
  [[nodiscard]] bool contains(const Vec2& uv);

 private:
  const FaceData& face_;
  std::unique_ptr<BRepTopAdaptor_FClass2d> classifier_;
};

}  // namespace camber::occ
