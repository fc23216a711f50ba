#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/elevate/apply_field.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace camber {
namespace {

constexpr std::size_t k_grain = 512;

void set_edge(const LayerField& field, CurvedMesh& curved, Index e) {
  const std::span<Vec3> nodes = curved.edge_nodes(e);
  if (nodes.empty()) return;
  std::array<Vec3, 8> u;
  const int q = curved.edge_order(e);
  field.edge(e, q, std::span(u.data(), nodes.size()));
  const std::array<Index, 2>& v = curved.topology().edge2vertex[at(e)];
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double s = static_cast<double>(k + 1) / q;
    const Vec3 straight = (1.0 - s) * curved.vertex(v[0]) + s * curved.vertex(v[1]);
    nodes[k] = field.constrained_edge_point(e, straight + u[k]);
  }
}

void set_face(const LayerField& field, CurvedMesh& curved, Index f) {
  const std::span<Vec3> nodes = curved.face_nodes(f);
  if (nodes.empty()) return;
  std::array<Vec3, 49> u;
  const int q = curved.face_order(f);
  field.face(f, q, std::span(u.data(), nodes.size()));
  curved.straight_inside_face(f, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    nodes[k] = field.constrained_face_point(f, nodes[k] + u[k]);
  }
}

void set_cell(const LayerField& field, CurvedMesh& curved, Index c, Points& u) {
  const std::span<Vec3> nodes = curved.cell_nodes(c);
  if (nodes.empty()) return;
  const int q = curved.cell_order(c);
  u.resize(nodes.size());
  field.cell(c, q, u);
  curved.straight_inside_cell(c, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] += u[k];
}

void set_all(const LayerField& field, CurvedMesh& curved, const std::vector<Index>& edges,
             const std::vector<Index>& faces, const std::vector<Index>& cells) {
  parallel_for(edges.size(), k_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) set_edge(field, curved, edges[i]);
  });
  parallel_for(faces.size(), k_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) set_face(field, curved, faces[i]);
  });
  parallel_for(cells.size(), k_grain, [&](std::size_t begin, std::size_t end) {
    Points u;
    for (std::size_t i = begin; i < end; ++i) set_cell(field, curved, cells[i], u);
  });
}

std::vector<Index> counted(std::size_t n) {
  std::vector<Index> items(n);
  std::iota(items.begin(), items.end(), 0);
  return items;
}

}  // namespace

void apply_field(const LayerField& field, CurvedMesh& curved) {
  set_all(field, curved, counted(curved.topology().edge_count()),
          counted(curved.topology().face_count()), counted(curved.linear().cell_count()));
}

void apply_field(const LayerField& field, CurvedMesh& curved, const std::vector<Index>& cells) {
  std::vector<Index> edges, faces, inside = cells;
  for (Index c : cells) {
    for (Index e : curved.topology().edges_of_cell(c)) edges.push_back(e);
    for (Index f : curved.topology().faces_of_cell(c)) faces.push_back(f);
  }
  make_sorted_set(edges);
  make_sorted_set(faces);
  make_sorted_set(inside);
  set_all(field, curved, edges, faces, inside);
}

}  // namespace camber
