#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/detail/shared_entities.hpp>
#include <camber/io/detail/xml_text.hpp>
#include <camber/io/nektar/nektar_writer.hpp>
#include <camber/io/nektar/vertex_order.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace camber::io {
namespace nektar {
namespace {

/// A face is straight if its points lie where the straight one has them, but for rounding: share of
/// its size.
constexpr double k_straight = 1e-13;

using LocalFaces =
    std::array<std::array<int, 4>, 6>;  // -1 beyond the corners, {-1} beyond the faces

constexpr LocalFaces k_tet_faces{{{0, 1, 2, -1},
                                  {0, 1, 3, -1},
                                  {1, 2, 3, -1},
                                  {0, 2, 3, -1},
                                  {-1, -1, -1, -1},
                                  {-1, -1, -1, -1}}};
constexpr LocalFaces k_pyramid_faces{
    {{0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 4, -1}, {3, 2, 4, -1}, {0, 3, 4, -1}, {-1, -1, -1, -1}}};
constexpr LocalFaces k_prism_faces{
    {{0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 5, 4}, {3, 2, 5, -1}, {0, 3, 5, 4}, {-1, -1, -1, -1}}};
constexpr LocalFaces k_hex_faces{
    {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {3, 2, 6, 7}, {0, 3, 7, 4}, {4, 5, 6, 7}}};

const LocalFaces& local_faces(Shape shape) {
  if (shape == Shape::tetrahedron) return k_tet_faces;
  if (shape == Shape::pyramid) return k_pyramid_faces;
  return shape == Shape::prism ? k_prism_faces : k_hex_faces;
}

char letter(Shape shape) {
  if (shape == Shape::tetrahedron) return 'A';
  if (shape == Shape::pyramid) return 'P';
  return shape == Shape::prism ? 'R' : 'H';
}

/// The corners of a cell as Nektar++ counts them, from Camber's: the collapsed corners (highest
/// numbers) where they belong, and right-handed.
std::vector<Index> local_corners(Shape shape, const std::vector<Index>& v) {
  if (shape == Shape::tetrahedron) {
    std::vector<Index> sorted = v;
    std::sort(sorted.begin(), sorted.end());
    // An odd permutation would turn the cell inside out: swap the two that are not collapsed.
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) inversions += v[i] > v[k] ? 1 : 0;
    }
    if (inversions % 2 == 1) std::swap(sorted[0], sorted[1]);
    return sorted;
  }
  if (shape == Shape::prism) {
    const auto top =
        static_cast<std::size_t>(std::max_element(v.begin(), v.begin() + 3) - v.begin());
    const std::size_t a = (top + 1) % 3, b = (top + 2) % 3;
    return {v[b], v[a], v[a + 3], v[b + 3], v[top], v[top + 3]};
  }
  return v;
}

class Writer {
 public:
  Writer(const NamedMesh& named, const std::string& path, const std::string& display)
      : mesh_(named.mesh),
        number_(number_vertices(mesh_, display)),
        shared_(mesh_, number_, display),
        out_(path, display) {}

  FileSummary run() {
    out_.append(
        "<?xml version=\"1.0\" encoding=\"utf-8\" ?>\n<NEKTAR>\n  <GEOMETRY DIM=\"3\" "
        "SPACE=\"3\">\n");
    write_vertices();
    write_edges_and_faces();
    write_elements();
    write_curves();
    write_composites();
    out_.append("  </GEOMETRY>\n</NEKTAR>\n");
    out_.finish();
    return {out_.size(), out_.hash()};
  }

 private:
  void write_vertices() {
    std::vector<Index> point(mesh_.points.size());
    Index count = 0;
    for (std::size_t i = 0; i < number_.size(); ++i) {
      if (number_[i] == k_none) continue;
      point[at(number_[i])] = static_cast<Index>(i);
      ++count;
    }
    out_.append("    <VERTEX>\n");
    for (Index v = 0; v < count; ++v) {
      const Vec3& x = mesh_.points[at(point[at(v)])];
      out_.print("      <V ID=\"{}\">{} {} {}</V>\n", v, x.x(), x.y(), x.z());
    }
    out_.append("    </VERTEX>\n");
  }

  void write_edges_and_faces() {
    out_.append("    <EDGE>\n");
    for (std::size_t e = 0; e < shared_.edges().size(); ++e) {
      const SharedEdge& edge = shared_.edges()[e];
      out_.print("      <E ID=\"{}\">{} {}</E>\n", e, edge.v[0], edge.v[1]);
    }
    out_.append("    </EDGE>\n    <FACE>\n");
    for (std::size_t f = 0; f < shared_.faces().size(); ++f) {
      const SharedFace& face = shared_.faces()[f];
      const char kind = face.shape == Shape::triangle ? 'T' : 'Q';
      out_.print("      <{} ID=\"{}\">", kind, f);
      for (std::size_t i = 0; i < sides(face); ++i) {
        out_.print("{}{}", i == 0 ? "" : " ", face.edges[i]);
      }
      out_.print("</{}>\n", kind);
    }
    out_.append("    </FACE>\n");
  }

  static std::size_t sides(const SharedFace& face) { return face.shape == Shape::triangle ? 3 : 4; }

  void write_elements() {
    out_.append("    <ELEMENT>\n");
    Index id = 0;
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) != 3) continue;
      const char kind = letter(b.shape);
      for (std::size_t e = 0; e < b.size(); ++e) {
        const std::vector<Index> v = local_corners(b.shape, corners_of(b, e));
        out_.print("      <{} ID=\"{}\">", kind, id++);
        for (const std::array<int, 4>& local : local_faces(b.shape)) {
          if (local[0] < 0) break;
          std::vector<Index> corners;
          for (const int c : local) {
            if (c >= 0) corners.push_back(v[static_cast<std::size_t>(c)]);
          }
          out_.print("{}{}", &local == &local_faces(b.shape).front() ? "" : " ",
                     shared_.face(corners));
        }
        out_.print("</{}>\n", kind);
      }
    }
    out_.append("    </ELEMENT>\n");
  }

  [[nodiscard]] std::vector<Index> corners_of(const ElementBlock& b, std::size_t e) const {
    const auto per = static_cast<std::size_t>(nodes_per_element(b.shape, b.order));
    std::vector<Index> v;
    for (const int c : lattice_map(b.shape, b.order).corner) {
      v.push_back(number_[at(b.nodes[e * per + static_cast<std::size_t>(c)])]);
    }
    return v;
  }

  [[nodiscard]] bool is_curved(const SharedFace& face) const {
    Points corner_points;
    Box box;
    for (const int c : lattice_map(face.shape, shared_.order()).corner) {
      corner_points.push_back(face.points[static_cast<std::size_t>(c)]);
    }
    for (const Vec3& x : face.points) box.add(x);
    const double far = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    const double tolerance =
        k_straight * box.diagonal() + 8.0 * std::numeric_limits<double>::epsilon() * far;
    const Points straight = straight_nodes(face.shape, shared_.order(), corner_points);
    for (std::size_t n = 0; n < straight.size(); ++n) {
      if ((straight[n] - face.points[n]).norm() > tolerance) return true;
    }
    return false;
  }

  void write_curves() {
    const int p = shared_.order();
    if (p == 1) return;
    std::vector<char> face_is_curved, edge_is_curved(shared_.edges().size(), 0);
    for (const SharedFace& face : shared_.faces()) {
      face_is_curved.push_back(is_curved(face) ? 1 : 0);
      if (face_is_curved.back() == 0) continue;
      for (std::size_t i = 0; i < sides(face); ++i) edge_is_curved[at(face.edges[i])] = 1;
    }
    out_.append("    <CURVED>\n");
    Index id = 0;
    for (std::size_t e = 0; e < edge_is_curved.size(); ++e) {
      if (edge_is_curved[e] == 0) continue;
      out_.print("      <E ID=\"{}\" EDGEID=\"{}\" TYPE=\"PolyEvenlySpaced\" NUMPOINTS=\"{}\">",
                 id++, e, p + 1);
      for (const Vec3& x : shared_.edges()[e].points) put(x);
      out_.append("</E>\n");
    }
    id = 0;
    for (std::size_t f = 0; f < face_is_curved.size(); ++f) {
      if (face_is_curved[f] == 0) continue;
      const SharedFace& face = shared_.faces()[f];
      const bool is_triangle = face.shape == Shape::triangle;
      out_.print("      <F ID=\"{}\" FACEID=\"{}\" TYPE=\"{}\" NUMPOINTS=\"{}\">", id++, f,
                 is_triangle ? "NodalTriEvenlySpaced" : "PolyEvenlySpaced", face.points.size());
      if (is_triangle) {
        for (const int n : triangle_order(p)) put(face.points[static_cast<std::size_t>(n)]);
      } else {
        for (const Vec3& x : face.points) put(x);  // rows, as here
      }
      out_.append("</F>\n");
    }
    out_.append("    </CURVED>\n");
  }

  void put(const Vec3& x) { out_.print("  {} {} {}", x.x(), x.y(), x.z()); }

  /// Corners, the edges 01, 12, 20 each walked that way, then the inside in rows.
  static std::vector<int> triangle_order(int p) {
    const LatticeMap& map = lattice_map(Shape::triangle, p);
    std::vector<int> order = map.corner;
    for (const std::vector<int>& edge : map.edge_interior) {
      order.insert(order.end(), edge.begin(), edge.end());
    }
    const std::span<const int> inside = interior_nodes(Shape::triangle, p);
    order.insert(order.end(), inside.begin(), inside.end());
    return order;
  }

  void write_composites() {
    // For each volume and shape, then for each patch: the numbers of elements or faces.
    std::map<std::pair<int, Shape>, std::vector<Index>> volumes;
    std::map<int, std::vector<Index>> patches;
    Index id = 0;
    for (const ElementBlock& b : mesh_.blocks) {
      for (std::size_t e = 0; e < b.size(); ++e) {
        if (dimension(b.shape) == 3) {
          volumes[{b.entity, b.shape}].push_back(id++);
        } else {
          patches[b.entity].push_back(shared_.face(corners_of(b, e)));
        }
      }
    }
    out_.append("    <COMPOSITE>\n");
    int composite = 0;
    for (auto& [key, list] : volumes)
      write_composite(composite++, {3, key.first}, letter(key.second), list);
    const int domain = composite;
    for (auto& [tag, list] : patches) write_composite(composite++, {2, tag}, 'F', list);
    out_.append("    </COMPOSITE>\n");
    out_.print("    <DOMAIN> C[0{}] </DOMAIN>\n", domain > 1 ? fmt::format("-{}", domain - 1) : "");
  }

  void write_composite(int id, EntityKey key, char kind, std::vector<Index>& list) {
    const auto entity = std::find_if(mesh_.entities.begin(), mesh_.entities.end(),
                                     [&](const EntityRecord& e) { return e.key == key; });
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    out_.print("      <C ID=\"{}\" NAME=\"{}\"> {}[", id, xml_escaped(entity->name), kind);
    for (std::size_t i = 0; i < list.size();) {
      std::size_t last = i;
      while (last + 1 < list.size() && list[last + 1] == list[last] + 1) ++last;
      out_.print("{}{}", i == 0 ? "" : ",", list[i]);
      if (last > i) out_.print("-{}", list[last]);
      i = last + 1;
    }
    out_.append("] </C>\n");
  }

  const MeshData& mesh_;
  std::vector<Index> number_;  // point -> vertex
  SharedEntities shared_;
  OutputFile out_;
};

}  // namespace
}  // namespace nektar

NameRules nektar_name_rules() { return {}; }

FileSummary write_nektar(const NamedMesh& named, const std::string& path,
                         const std::string& display) {
  check_mesh(named.mesh, display);
  return nektar::Writer(named, path, display).run();
}

}  // namespace camber::io
