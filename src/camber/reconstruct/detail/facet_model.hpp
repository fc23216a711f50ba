#pragma once
#include <camber/geom/curve_tree.hpp>
#include <camber/reconstruct/detail/facet_set.hpp>
#include <camber/reconstruct/reconstruct.hpp>

#include <memory>
#include <vector>

namespace camber::detail {

/// What model and projectors share.
struct FacetBody {
  FacetBody(const FacetMesh& mesh, Features found);

  Features features;
  std::vector<ChainCurve> curves;
  FacetSet facets;
  std::vector<std::array<Index, 4>> corner_of;  // facet -> vertices, [3] = -1 for triangles
  std::vector<CurveTree> trees;                 // of the curves
  std::vector<std::uint8_t> is_straight;        // by curve
  Points corners;                               // of the features
};

class FacetModel final : public ReconstructedModel {
 public:
  explicit FacetModel(std::shared_ptr<const FacetBody> body) : body_(std::move(body)) {}

  [[nodiscard]] const Features& features() const override { return body_->features; }
  [[nodiscard]] std::size_t flat_corners() const override { return body_->facets.flat_corners(); }

  [[nodiscard]] int count(int dim) const override;
  [[nodiscard]] std::string name(GeomEntity) const override { return {}; }
  [[nodiscard]] Box box() const override;
  [[nodiscard]] Box box(GeomEntity entity) const override;
  [[nodiscard]] double tolerance(GeomEntity) const override { return 0.0; }
  [[nodiscard]] bool is_degenerate(int) const override { return false; }
  [[nodiscard]] bool is_seam(int curve, int face) const override;
  [[nodiscard]] bool is_planar(int face) const override;
  [[nodiscard]] bool is_straight(int curve) const override;
  [[nodiscard]] std::vector<int> faces_of_curve(int curve) const override;
  [[nodiscard]] std::vector<int> curves_of_face(int face) const override;
  [[nodiscard]] std::vector<int> vertices_of_curve(int curve) const override;
  [[nodiscard]] CurveRange range(int curve) const override;
  [[nodiscard]] Vec2 periods(int) const override { return Vec2::Zero(); }
  [[nodiscard]] Vec2 curve_on_face(int curve, int face, double t,
                                   const std::optional<Vec2>& near) const override;
  [[nodiscard]] std::unique_ptr<Projector> projector() const override;
  void set_scale(double scale) override;
  [[nodiscard]] double scale() const override { return scale_; }

 private:
  void check(GeomEntity entity) const;
  [[nodiscard]] std::size_t place(int dim, int tag) const;  // after check
  /// Parameters on the facet of the point at share s of one of its edges, from the edge's smaller
  /// vertex number.
  [[nodiscard]] Vec2 edge_parameters(Index facet, Index edge, double s) const;

  std::shared_ptr<const FacetBody> body_;
  double scale_ = 1.0;
};

/// @throws GeometryError if the model has no such entity
void check_entity(const FacetBody& body, GeomEntity entity);

}  // namespace camber::detail
