#pragma once
// The CAD as the rest of Camber sees it: entities, projection, evaluation. No kernel types.
#include <camber/base/vec.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace camber {

/// A CAD vertex (dim 0), curve (1) or face (2); tag counts from 1 in the order of
/// docs/geometry (for OpenCASCADE: TopExp order, solids first, as Gmsh numbers them).
struct GeomEntity {
  int dim = -1;
  int tag = 0;
  friend bool operator==(const GeomEntity&, const GeomEntity&) = default;
  friend auto operator<=>(const GeomEntity&, const GeomEntity&) = default;
};

enum class ProjectionStatus {
  inside,    // orthogonal foot point in the entity's interior
  boundary,  // nearest point lies on the entity's trimming boundary (curve end, face edge, vertex)
  failed     // no answer; `point` is the query point itself, distance = infinity
};

struct Projection {
  Vec3 point = Vec3::Zero();
  Vec2 uv = Vec2::Zero();  // parameters on `entity`: (u,v) of a face, (t,0) of a curve
  double distance = 0.0;   // |x - point|
  ProjectionStatus status = ProjectionStatus::failed;
  GeomEntity entity;
};

struct SurfacePoint {
  Vec3 point, du, dv;
  Vec3 normal;  // unit, outward of the solid where the kernel knows (orientation applied); zero if
                // singular
};
struct CurvePoint {
  Vec3 point, tangent;  // tangent = dx/dt
};

/// Answers geometric questions; owned by one thread (holds evaluator caches). Lengths in the mesh's
/// unit.
class Projector {
 public:
  virtual ~Projector() = default;

  /// Nearest point of a vertex, curve (clamped to its range) or trimmed face. With a seed
  /// (parameters on the entity near the answer) a local Newton search is tried first and verified:
  /// its answer is taken when it converged and is inside the trim; else the global search runs.
  /// Seams are handled: the returned uv is the representative nearest to the seed when there is
  /// one.
  [[nodiscard]] virtual Projection closest(GeomEntity entity, const Vec3& x,
                                           const std::optional<Vec2>& seed = std::nullopt) = 0;

  /// Intersection of the line x + s*direction, |s| <= max_distance (direction need not be unit; s
  /// is a length), with the trimmed face: the crossing nearest to x. Empty if there is none.
  /// `distance` = |s|.
  [[nodiscard]] virtual std::optional<Projection> along_line(
      int face, const Vec3& x, const Vec3& direction, double max_distance,
      const std::optional<Vec2>& seed = std::nullopt) = 0;

  [[nodiscard]] virtual SurfacePoint evaluate_face(int face, const Vec2& uv) = 0;
  [[nodiscard]] virtual CurvePoint evaluate_curve(int curve, double t) = 0;

  /// Points of the curve that divide the stretch from t0 to t1 in arc length at the given fractions
  /// (0..1). t1 may be smaller than t0; on a closed curve the caller picks the way round by adding
  /// the period. Exact to 1e-12 of the stretch.
  virtual void divide_curve(int curve, double t0, double t1, std::span<const double> fractions,
                            std::span<Projection> result) = 0;
  [[nodiscard]] virtual double curve_length(int curve, double t0, double t1) = 0;
};

class GeometryModel {
 public:
  virtual ~GeometryModel() = default;

  [[nodiscard]] virtual int count(int dim) const = 0;
  [[nodiscard]] virtual std::string name(GeomEntity entity) const = 0;  // "" if the file gives none
  [[nodiscard]] virtual Box box() const = 0;
  [[nodiscard]] virtual Box box(GeomEntity entity) const = 0;
  /// Gap allowed by the CAD itself at this entity (edge and vertex tolerances).
  [[nodiscard]] virtual double tolerance(GeomEntity entity) const = 0;
  /// No length: a pole or cone tip. Such curves are never projected on.
  [[nodiscard]] virtual bool is_degenerate(int curve) const = 0;
  /// The curve bounds `face` on both of its sides.
  [[nodiscard]] virtual bool is_seam(int curve, int face) const = 0;
  [[nodiscard]] virtual bool is_planar(int face) const = 0;
  [[nodiscard]] virtual bool is_straight(int curve) const = 0;
  [[nodiscard]] virtual std::vector<int> faces_of_curve(int curve) const = 0;
  [[nodiscard]] virtual std::vector<int> curves_of_face(int face) const = 0;
  [[nodiscard]] virtual std::vector<int> vertices_of_curve(int curve) const = 0;  // 1 if closed
  /// Range of the curve's parameter; period 0 if it is not closed and periodic.
  struct CurveRange {
    double first = 0.0, last = 1.0, period = 0.0;
  };
  [[nodiscard]] virtual CurveRange range(int curve) const = 0;
  /// Periods of the face in u and v (0: none).
  [[nodiscard]] virtual Vec2 periods(int face) const = 0;
  /// Parameters on the face of the curve's point t. On a seam there are two answers: `near` picks.
  [[nodiscard]] virtual Vec2 curve_on_face(
      int curve, int face, double t, const std::optional<Vec2>& near = std::nullopt) const = 0;

  [[nodiscard]] virtual std::unique_ptr<Projector> projector() const = 0;

  /// Mesh lengths = scale * CAD lengths, applied to everything above. Set before use.
  virtual void set_scale(double scale) = 0;
  [[nodiscard]] virtual double scale() const = 0;
};

/// The paper's geometry group (2.1): CAD entities a mesh entity may lie on; any nearest one counts.
using GeometryGroup = std::vector<GeomEntity>;

/// Nearest point over the members of a group (ties: first member). Failed if the group is empty.
[[nodiscard]] Projection project_to_group(Projector& projector, const GeometryGroup& group,
                                          const Vec3& x);

}  // namespace camber
