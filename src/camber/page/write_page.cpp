#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/page/write_page.hpp>

#include <fstream>

namespace camber {

void write_page(const std::string& text, const std::string& path) {
  io::write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw FileError("cannot be written", path, "check that the disk is not full");
  });
}

}  // namespace camber
