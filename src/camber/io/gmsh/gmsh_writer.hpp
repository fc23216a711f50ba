#pragma once
// Gmsh .msh 4.1 and 2.2, text and binary.
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

struct GmshWriteOptions {
  bool binary = true;
  double version = 4.1;  // 4.1 or 2.2
};

/// Writes a mesh of any orders 1..4 into `path`, in place (see write_mesh for the safe way).
///
/// Version 4.1 keeps everything of MeshData but element_fields: groups, entities with boxes
/// (without bounding entities), classification and parameters of the nodes. Nodes come out sorted
/// by entity, so a reader may see them in another order; elements keep theirs. Version 2.2 keeps
/// the first physical group of each entity and no classification of nodes. Nodes without
/// classification get that of the lowest entity whose elements use them. Coordinates in text are
/// the shortest decimals that give the same bits back.
/// @param display  name used in errors (the user's file, when `path` is a temporary)
/// @throws FileError if the disk refuses, a number does not fit the version, or a coordinate is not
///         finite; std::invalid_argument if the arrays of `mesh` contradict each other
void write_gmsh(const MeshData& mesh, const std::string& path, const GmshWriteOptions& options,
                const std::string& display);

}  // namespace camber::io
