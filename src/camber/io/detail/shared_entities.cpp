#include <camber/base/error.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/shared_entities.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace camber::io {
namespace {

/// Neighbours agree on an edge or face if their nodes differ by no more than this share of the
/// element's size: far above the rounding of an elevation, far below any gap that matters.
constexpr double k_same = 1e-9;

CornerKey key_of(const std::vector<Index>& corners) { return corner_key(corners); }

/// Places of the frame's corners in the walk v.
std::vector<int> frame_of(const std::vector<Index>& v) {
  const std::size_t n = v.size();
  const auto first = static_cast<std::size_t>(std::min_element(v.begin(), v.end()) - v.begin());
  const bool is_forward = v[(first + 1) % n] < v[(first + n - 1) % n];
  std::vector<int> frame(n);
  for (std::size_t i = 0; i < n; ++i) {
    frame[i] = static_cast<int>((is_forward ? first + i : first + n - i) % n);
  }
  return frame;
}

}  // namespace

SharedEntities::SharedEntities(const MeshData& mesh, const std::vector<Index>& number,
                               std::string display)
    : display_(std::move(display)) {
  for (const ElementBlock& b : mesh.blocks) {
    if (order_ != 0 && b.order != order_) {
      throw FileError("elements of different orders in a format that holds one", display_,
                      "raise all to one order: camber convert --order");
    }
    order_ = b.order;
  }
  for (const int dim : {3, 2}) {
    for (const ElementBlock& b : mesh.blocks) {
      if (dimension(b.shape) == dim) take(mesh, b, number);
    }
  }
}

Index SharedEntities::edge(Index a, Index b) const {
  const auto found = edge_of_.find(corner_key(std::array{a, b}));
  return found == edge_of_.end() ? k_none : found->second;
}

Index SharedEntities::face(const std::vector<Index>& corners) const {
  const auto found = face_of_.find(key_of(corners));
  return found == face_of_.end() ? k_none : found->second;
}

void SharedEntities::take(const MeshData& mesh, const ElementBlock& block,
                          const std::vector<Index>& number) {
  const LatticeMap& map = lattice_map(block.shape, order_);
  const bool is_cell = dimension(block.shape) == 3;
  const auto per = at(nodes_per_element(block.shape, order_));
  for (std::size_t e = 0; e < block.nodes.size(); e += per) {
    const auto node = [&](int n) { return block.nodes[e + at(n)]; };
    const auto point = [&](int n) { return mesh.points[at(node(n))]; };
    const auto vertex = [&](int corner) { return number[at(node(map.corner[at(corner)]))]; };
    Box box;
    for (std::size_t n = 0; n < per; ++n) box.add(point(static_cast<int>(n)));
    const double far = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    tolerance_ = k_same * box.diagonal() + 64.0 * std::numeric_limits<double>::epsilon() * far;
    const std::span<const std::array<int, 2>> local_edges = camber::edges(block.shape);
    for (std::size_t i = 0; i < local_edges.size(); ++i) {
      Points points;
      for (const int n : map.edge[i]) points.push_back(point(n));
      take_edge({vertex(local_edges[i][0]), vertex(local_edges[i][1])}, std::move(points), is_cell);
    }
    const std::span<const LocalFace> local_faces = camber::faces(block.shape);
    for (std::size_t f = 0; f < local_faces.size(); ++f) {
      std::vector<Index> v;
      for (const int c : local_faces[f].corners) {
        if (c >= 0) v.push_back(vertex(c));
      }
      const std::vector<int> node_of = reorient(local_faces[f].shape, order_, frame_of(v));
      Points points;
      for (const int n : node_of) points.push_back(point(map.face[f][at(n)]));
      take_face(local_faces[f].shape, v, points, is_cell);
    }
  }
}

void SharedEntities::take_edge(std::array<Index, 2> v, Points points, bool is_cell) {
  if (v[0] > v[1]) {
    std::swap(v[0], v[1]);
    std::reverse(points.begin(), points.end());
  }
  const auto [place, is_new] =
      edge_of_.try_emplace(corner_key(v), static_cast<Index>(edges_.size()));
  if (!is_new) {
    require_same(edges_[at(place->second)].points, points, "an edge");
    return;
  }
  if (!is_cell) {
    throw FileError("a surface element is no face of any cell", display_,
                    "take it out of the mesh: this format knows faces of cells only");
  }
  edges_.push_back({v, std::move(points)});
}

void SharedEntities::take_face(Shape shape, const std::vector<Index>& v, const Points& points,
                               bool is_cell) {
  const auto [place, is_new] = face_of_.try_emplace(key_of(v), static_cast<Index>(faces_.size()));
  if (!is_new) {
    require_same(faces_[at(place->second)].points, points, "a face");
    return;
  }
  if (!is_cell) {
    throw FileError("a surface element is no face of any cell", display_,
                    "take it out of the mesh: this format knows faces of cells only");
  }
  SharedFace& face = faces_.emplace_back();
  face.shape = shape;
  face.points = points;
  const std::vector<int> frame = frame_of(v);
  for (std::size_t i = 0; i < v.size(); ++i) face.v[i] = v[at(frame[i])];
  for (std::size_t i = 0; i < v.size(); ++i) {
    face.edges[i] = edge(face.v[i], face.v[(i + 1) % v.size()]);
  }
}

void SharedEntities::require_same(const Points& a, const Points& b, const char* what) const {
  bool is_same = a.size() == b.size();
  for (std::size_t i = 0; is_same && i < a.size(); ++i) {
    is_same = (a[i] - b[i]).norm() <= tolerance_;
  }
  if (is_same) return;
  throw FileError(fmt::format("neighbours make different shapes of {} that they share", what),
                  display_, "write .msh or .cgns, which hold each element's own nodes");
}

}  // namespace camber::io
