#pragma once
// From a carried start to a mesh in which every cell is certified.
#include <camber/elevate/columns.hpp>
#include <camber/elevate/placement.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/pipeline/report.hpp>
#include <camber/smooth/patch.hpp>

#include <functional>
#include <vector>

namespace camber {

struct LadderResult {
  std::vector<Index> mended;            // first cells of groups mended by moving volume nodes only
  std::size_t load_steps = 0;           // of groups that needed them
  std::size_t elastic_patches = 0;      // elastic solves around bad cells that were kept
  ElasticWork elastic;                  // of the third rung
  std::size_t wall_faces_smoothed = 0;  // faces whose nodes slid along the CAD
  std::vector<Index> lowered_faces;     // wall face slots whose shape was lowered below their order
  RescueResult scaled;                  // the last rung
  std::vector<Index> pinched;  // cells that no curved wall can leave valid (elevate/pinched.hpp)
};

/// Carries the wall's displacement, as Placement has it now, to the given cells again; returns all
/// cells that it may have changed, sorted.
using Carry = std::function<std::vector<Index>(const std::vector<Index>& cells)>;

/// Climbs only as far as needed, for the cells that are not certified:
/// (Pinched cells start at 4.)
///   1. volume nodes of the group and its rings are moved (smooth/patch.hpp); the wall stays as it
///   is
///   2. wall faces under what is left are smoothed along the CAD, once each (wall_repair.hpp)
///   3. once, where no wall face could be smoothed: an elastic solve over the rings around what is
///   left, kept if it certifies all; tried again before 5
///   4. wall faces under what is left get one order less of shape, together with thin neighbours
///   that this would fold (detail/lowered_together.hpp), and their columns are carried again; where
///   they are straight already, the rings of wall faces around them are straightened
///   5. displacements are scaled back until certified (elevate/rescue.hpp); this always ends
LadderResult climb(CurvedMesh& curved, const Association& association, const GeometryModel& model,
                   Placement& placement, const Carry& carry, const Wall& wall,
                   const Columns& columns, const std::vector<Index>& pinched,
                   const std::vector<Index>& uncertified);

}  // namespace camber
