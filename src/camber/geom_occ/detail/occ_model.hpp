#pragma once
// Private: GeometryModel on OpenCASCADE.
#include <camber/geom/geometry_model.hpp>
#include <camber/geom_occ/detail/curve_data.hpp>
#include <camber/geom_occ/detail/face_data.hpp>
#include <camber/geom_occ/detail/topology.hpp>

#include <atomic>
#include <memory>
#include <mutex>

namespace camber::occ {

/// Built at the first question, once, by whichever thread asks first; then shared.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(once_, [&] { value_ = make(); });
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const T> value_;
};

/// Entities with their evaluators, in the kernel's unit; outlives every projector made of it.
class Body {
 public:
  explicit Body(const ShapeFile& file);
  [[nodiscard]] const Topology& topology() const { return topology_; }
  [[nodiscard]] const CurveData& curve(int tag) const;
  [[nodiscard]] const FaceData& face(int tag) const;
  [[nodiscard]] Box box(GeomEntity entity) const;
  [[nodiscard]] Box box() const;
  /// @throws GeometryError if the entity does not exist
  void check(GeomEntity entity) const;

 private:
  Topology topology_;
  std::unique_ptr<Lazy<CurveData>[]> curves_;
  std::unique_ptr<Lazy<FaceData>[]> faces_;
  std::unique_ptr<Lazy<Box>[]> boxes_[3];
  Lazy<Box> box_;
};

class OccModel final : public GeometryModel {
 public:
  explicit OccModel(const ShapeFile& file) : body_(std::make_shared<Body>(file)) {}

  int count(int dim) const override;
  std::string name(GeomEntity entity) const override;
  Box box() const override;
  Box box(GeomEntity entity) const override;
  double tolerance(GeomEntity entity) const override;
  bool is_degenerate(int curve) const override;
  bool is_seam(int curve, int face) const override;
  bool is_planar(int face) const override;
  bool is_straight(int curve) const override;
  std::vector<int> faces_of_curve(int curve) const override;
  std::vector<int> curves_of_face(int face) const override;
  std::vector<int> vertices_of_curve(int curve) const override;
  CurveRange range(int curve) const override;
  Vec2 periods(int face) const override;
  Vec2 curve_on_face(int curve, int face, double t, const std::optional<Vec2>& near) const override;
  std::unique_ptr<Projector> projector() const override;
  void set_scale(double scale) override;
  double scale() const override { return scale_; }

 private:
  std::shared_ptr<const Body> body_;
  double scale_ = 1.0;
};

}  // namespace camber::occ
