// Reads a linear mesh and its CAD: usage: whole_library MESH CAD
#include <camber/geom_occ/cad_file.hpp>
#include <camber/io/mesh_file.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) return 1;
  try {
    const camber::MeshData mesh = camber::io::read_mesh(argv[1]);
    const auto cad = camber::read_cad(argv[2]);
    std::printf("%zu elements, %d CAD faces\n", mesh.element_count(), cad->count(2));
    return mesh.element_count() > 0 && cad->count(2) == 5 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
