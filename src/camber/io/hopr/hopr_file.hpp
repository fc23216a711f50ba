#pragma once
// HOPR mesh files: HDF5 with the arrays of hopr_arrays.hpp.
#include <camber/io/hopr/hopr_arrays.hpp>

#include <string>

namespace camber::io {

/// Names of boundary conditions have at most 255 characters; zones are numbers.
[[nodiscard]] NameRules hopr_name_rules();

/// Writes the arrays and the attributes Version, Ngeo, nElems, nSides, nNodes, nUniqueSides,
/// nUniqueNodes, nBCs and FEMconnect ("OFF") into `path`. The same arrays give the same bytes.
/// @param display  name used in errors (the user's file, when `path` is a temporary)
/// @throws FileError if the disk refuses
/// Cost: the file is made in memory first. Threads: holds hdf5_mutex().
void write_hopr(const hopr::Arrays& arrays, const std::string& path, const std::string& display);

/// Reads the arrays back and compares every number. @throws FileError if one differs
void check_hopr(const hopr::Arrays& arrays, const std::string& path, const std::string& display);

}  // namespace camber::io
