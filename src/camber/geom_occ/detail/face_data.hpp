#pragma once
// Private: one CAD face, ready for queries; shared by all projectors, lengths in the kernel's unit.
#include <camber/geom/surface_tree.hpp>
#include <camber/geom_occ/detail/curve_data.hpp>
#include <camber/geom_occ/detail/trim_grid.hpp>

#include <memory>
#include <optional>
#include <vector>

#include <Geom2d_Curve.hxx>
#include <TopoDS_Face.hxx>

namespace camber::occ {

/// An edge of a face and its curve in the face's parameters (two curves on a seam).
struct FaceEdge {
  int tag = 0;
  Handle(Geom2d_Curve) curve, seam_curve;
  [[nodiscard]] bool is_seam() const { return !seam_curve.IsNull(); }
};

struct FaceData {
  /// @param edges tags of the face's edges in order of the face
  FaceData(const TopoDS_Face& face, const std::vector<std::pair<int, TopoDS_Shape>>& edges);

  [[nodiscard]] const FaceEdge* find(int edge) const;
  /// uv in the period that starts at the lower limits.
  [[nodiscard]] Vec2 wrapped(const Vec2& uv) const;
  /// uv in the period around `near`.
  [[nodiscard]] Vec2 beside(const Vec2& uv, const Vec2& near) const;

  TopoDS_Face face;
  bool is_reversed = false;
  bool is_rectangle = false;  // the trim is the whole parameter rectangle
  UvBox limits;
  Vec2 periods = Vec2::Zero();
  /// Largest gap that the model itself has at the border of the face (edge and vertex tolerances).
  double gap = 0.0;
  std::vector<FaceEdge> edges;
  TrimGrid trim;  // empty if is_rectangle
  std::unique_ptr<ParametricSurface> surface;
  std::unique_ptr<SurfaceTree> tree;
};

/// Parameters on the face of point t of its edge; on a seam the side nearer to `near`.
[[nodiscard]] Vec2 edge_uv(const FaceData& face, const FaceEdge& edge, double t,
                           const std::optional<Vec2>& near);

}  // namespace camber::occ
