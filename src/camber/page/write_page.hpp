#pragma once
#include <string>

namespace camber {

/// Writes the text of a page, replacing `path` in one step as io::write_atomically() does.
/// @throws FileError if it cannot be written
void write_page(const std::string& text, const std::string& path);

}  // namespace camber
