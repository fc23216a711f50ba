#pragma once
#include <camber/associate/by_tags.hpp>

#include <string>
#include <vector>

namespace camber {

/// What the search for CAD entities found and what it did not.
struct ShapeLink {
  Association association;
  std::size_t faces = 0;              // boundary faces
  std::size_t on_cad = 0;             // of these: on one or several CAD faces
  std::size_t straddling = 0;         // of these: across CAD edges, on a group of several faces
  std::size_t off_cad = 0;            // near the CAD, but on no face of it (bridges, chords)
  std::vector<double> confidence;     // by patch: 1 none of its faces had a second choice
  std::vector<int> cad_without_mesh;  // CAD faces that no mesh face lies on
};

/// Association by place and shape alone, for meshes without the CAD's tags. The model's scale must
/// fit the mesh already (fit_cad_scale_by_shape).
///
/// A boundary face belongs to a CAD face that all its forming nodes lie on and that faces its way;
/// of several the one nearest to its nodes, then to its centre and normal, with the sense of
/// normals that the CAD face has elsewhere: never the far side of a thin sheet. Where no single CAD
/// face holds all forming nodes, the group of those faces that hold one and face its way. Mesh
/// edges between two CAD faces lie on the curve they share; edges along seams on the seam. Faces on
/// no CAD face keep the patches of the file, cut where they turn sharply; planar ones are kept
/// planar.
///
/// A vertex lies on a CAD face if it is nearer than options.distance_tolerance of the CAD's size
/// and a tenth of its longest boundary edge.
/// @throws GeometryError if no boundary face lies on the CAD; OptionError for a rule that names no
///         patch or an unknown CAD face. Threads: runs parallel inside, same bits for any number.
[[nodiscard]] ShapeLink associate_by_shape(const LinearMesh& mesh, const Topology& topology,
                                           const GeometryModel& model,
                                           const TagOptions& options = {});

}  // namespace camber
