#pragma once
// Private: a CAD file as a kernel shape and the names in it.
#include <string>
#include <unordered_map>

#include <TopoDS_Shape.hxx>

namespace camber::occ {

struct ShapeFile {
  TopoDS_Shape shape;
  std::unordered_map<const TopoDS_TShape*, std::string>
      names;  // faces, edges, vertices that have one
};

/// Reads by extension; lengths in millimetres. One file at a time (the kernel's reader settings are
/// global).
/// @throws FileError
[[nodiscard]] ShapeFile read_shape_file(const std::string& path);

}  // namespace camber::occ
