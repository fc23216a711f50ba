#pragma once
#include <camber/io/detail/named_mesh.hpp>

#include <string>

namespace camber::io {

/// What SU2 allows in the names of markers: no blanks; one volume.
[[nodiscard]] NameRules su2_name_rules();

/// Writes a .su2 file of any mix of orders 1 to 4: cells, nodes, one marker a patch. Coordinates
/// are the shortest decimals that give the same bits back.
/// @throws FileError if the disk refuses or a coordinate is not finite
void write_su2(const NamedMesh& named, const std::string& path, const std::string& display);

}  // namespace camber::io
