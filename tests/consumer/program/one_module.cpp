// A kernel without mesh, CAD or files.
#include <camber/basis/lattice.hpp>

#include <cstdio>

int main() {
  const int nodes = camber::node_count(camber::Shape::prism, 4);
  std::printf("a quartic prism has %d nodes\n", nodes);
  return nodes == 75 ? 0 : 1;
}
