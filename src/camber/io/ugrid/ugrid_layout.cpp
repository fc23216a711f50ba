#include <camber/base/error.hpp>
#include <camber/io/ugrid/ugrid_layout.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace camber::io::ugrid {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// ".lb8" of "wing.lb8.ugrid".
std::string flavour_of(const std::string& path) {
  return lower(fs::path(path).stem().extension().string());
}

constexpr std::array k_flavours{".b8", ".lb8", ".r8", ".lr8"};

bool is_binary_flavour(const std::string& flavour) {
  return std::find(k_flavours.begin(), k_flavours.end(), flavour) != k_flavours.end();
}

}  // namespace

Layout layout_of(const std::string& path) {
  const std::string flavour = flavour_of(path);
  for (const char* refused : {".b4", ".lb4", ".r4", ".lr4", ".b8l", ".lb8l", ".b8.l"}) {
    if (flavour != refused) continue;
    throw FileError("UGRID of the kind '" + flavour.substr(1) + "' is not taken", path,
                    "use 4-byte integers and double precision: .lb8.ugrid or .b8.ugrid");
  }
  if (!is_binary_flavour(flavour)) return {};
  return {.is_binary = true,
          .is_big_endian = flavour[1] != 'l',
          .has_records = flavour.find('r') != std::string::npos};
}

std::string mapbc_path(const std::string& path) {
  fs::path stem = fs::path(path).replace_extension();
  if (is_binary_flavour(lower(stem.extension().string()))) stem.replace_extension();
  return stem.string() + ".mapbc";
}

}  // namespace camber::io::ugrid
