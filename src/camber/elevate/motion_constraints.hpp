#pragma once
#include <camber/associate/association.hpp>

#include <cstdint>
#include <vector>

namespace camber {

/// How edges and faces of still patches (boundary that is no wall) may move: inside their plane,
/// along the line of two planes, or not at all. All other edges and faces are free. Const members:
/// any thread.
class MotionConstraints {
 public:
  MotionConstraints() = default;
  /// @param still_faces  topology faces of all still patches
  MotionConstraints(const LinearMesh& mesh, const Topology& topology,
                    const Association& association, const std::vector<Index>& still_faces);

  /// The part of a displacement that is allowed.
  [[nodiscard]] Vec3 edge_move(Index e, const Vec3& u) const { return move(edge_[at(e)], u); }
  [[nodiscard]] Vec3 face_move(Index f, const Vec3& u) const { return move(face_[at(f)], u); }
  /// The nearest allowed place to x: takes rounding away. x itself where nothing may move.
  [[nodiscard]] Vec3 edge_point(Index e, const Vec3& x) const { return point(edge_[at(e)], x); }
  [[nodiscard]] Vec3 face_point(Index f, const Vec3& x) const { return point(face_[at(f)], x); }

 private:
  enum class Kind : std::uint8_t { plane, line, fixed };
  struct Constraint {
    Kind kind = Kind::fixed;
    Vec3 origin = Vec3::Zero(), a = Vec3::Zero();  // plane normal, or direction of the line
  };
  [[nodiscard]] Vec3 move(Index constraint, const Vec3& u) const;
  [[nodiscard]] Vec3 point(Index constraint, const Vec3& x) const;
  /// Constraint of an edge at `x` that two different ones meet in.
  [[nodiscard]] Index meet(Index first, Index second, const Vec3& x);

  std::vector<Constraint> constraints_;
  std::vector<Index> edge_, face_;  // into constraints_, or -1: free
};

}  // namespace camber
