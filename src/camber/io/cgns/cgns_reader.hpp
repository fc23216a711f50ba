#pragma once
// CGNS files, HDF5 and ADF, linear and curved.
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

/// Reads the first base with volume cells: all its zones, unstructured (sections of one type or
/// MIXED, complete elements to order 4) and structured (every cell a hex).
///
/// Patches: a surface element belongs to the first boundary condition that names it, by its number
/// or by all of its nodes, else to its section; the entity has the name of the condition and is
/// also in the group of its family. Structured zones have the surface elements of their boundary
/// conditions. Volumes have the name of the zone, or that of the section's Descriptor "Region".
/// Zones that are connected one to one share nodes where these coincide to 1e-6 of the box (a
/// periodic connection does not).
/// @throws FileError for polyhedra (NGON_n, NFACE_n), serendipity elements, nodes out of range, and
///         everything the library refuses
/// Threads: any; the library is used by one at a time.
[[nodiscard]] MeshData read_cgns(const std::string& path);

}  // namespace camber::io
