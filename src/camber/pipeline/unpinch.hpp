#pragma once
#include <camber/elevate/wall.hpp>
#include <camber/pipeline/curve.hpp>

#include <functional>
#include <vector>

namespace camber {

/// Links the mesh of a result to its CAD anew and gives its wall.
using Relink = std::function<Wall(CurveResult& result)>;

/// Changes the linear mesh inside the volume so that fewer cells are pinched (elevate/pinched.hpp):
/// edges behind pinched tets are removed while that helps, what is left is cut from its centre. The
/// surface mesh stays. Counts go to the report.
/// @param wall     of the mesh as it is; replaced where the mesh changes
/// @param pinched  sorted
/// @return the cells that are still pinched
std::vector<Index> unpinch(CurveResult& result, Wall& wall, std::vector<Index> pinched,
                           const Relink& relink);

}  // namespace camber
