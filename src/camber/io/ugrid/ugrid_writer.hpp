#pragma once
#include <camber/io/detail/named_mesh.hpp>

#include <string>

namespace camber::io {

/// What a .mapbc file allows in names: no blanks; one volume.
[[nodiscard]] NameRules ugrid_name_rules();

/// Writes a linear mesh; text or binary follows from the name `display` (ugrid_layout.hpp). The tag
/// of a face is the number of its patch, 1, 2, ...
/// @throws FileError if the disk refuses, a coordinate is not finite, or the file's 4-byte integers
///         cannot hold the numbers
void write_ugrid(const NamedMesh& named, const std::string& path, const std::string& display);

/// The text of NAME.mapbc that belongs to it: condition 5000 (far field) for every patch, for the
/// user to change.
[[nodiscard]] std::string mapbc_text(const NamedMesh& named);

}  // namespace camber::io
