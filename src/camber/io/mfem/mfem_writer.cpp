#include <camber/base/by_key.hpp>
#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/mfem/mfem_nodes.hpp>
#include <camber/io/mfem/mfem_writer.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace camber::io {
namespace mfem {
namespace {

/// Neighbours agree on an edge or face if their nodes differ by no more than this share of the
/// element's size: far above the rounding of an elevation, far below any gap that matters.
constexpr double k_same = 1e-9;

class Writer {
 public:
  Writer(const NamedMesh& named, const std::string& display)
      : mesh_(named.mesh), display_(display), vertex_(named.mesh.points.size(), k_none) {}

  FileSummary run(const std::string& path) {
    find_order();
    number_vertices();
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) == 3) take(b);
    }
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) == 2) take(b);
    }
    return write(path);
  }

 private:
  void find_order() {
    for (const ElementBlock& b : mesh_.blocks) {
      if (order_ != 0 && b.order != order_) {
        throw FileError("elements of different orders in a format that holds one", display_,
                        "raise all to one order: camber convert --order");
      }
      order_ = b.order;
    }
  }

  /// Corners of cells, in the order of the points.
  void number_vertices() {
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) != 3) continue;
      const std::vector<int>& corner = lattice_map(b.shape, b.order).corner;
      const auto per = static_cast<std::size_t>(nodes_per_element(b.shape, b.order));
      for (std::size_t e = 0; e < b.nodes.size(); e += per) {
        for (const int c : corner) vertex_[at(b.nodes[e + static_cast<std::size_t>(c)])] = 0;
      }
    }
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
      if (vertex_[i] == k_none) continue;
      vertex_[i] = static_cast<Index>(vertices_.size());
      vertices_.push_back(mesh_.points[i]);
    }
  }

  /// Puts the nodes of the block's elements where they belong, or compares them.
  void take(const ElementBlock& block) {
    const ElementNodes& nodes = element_nodes(block.shape, order_);
    const MatX values = tabulate(block.shape, order_, nodes.xi).values;
    const auto per = static_cast<std::size_t>(nodes_per_element(block.shape, order_));
    const std::vector<int>& corner = lattice_map(block.shape, order_).corner;
    Points x(nodes.xi.size());
    std::vector<Index> v(corner.size());
    for (std::size_t e = 0; e < block.nodes.size(); e += per) {
      Box box;
      for (std::size_t k = 0; k < per; ++k) box.add(mesh_.points[at(block.nodes[e + k])]);
      const double far = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
      tolerance_ = k_same * box.diagonal() + 64.0 * std::numeric_limits<double>::epsilon() * far;
      for (std::size_t c = 0; c < v.size(); ++c) {
        v[c] = vertex_[at(block.nodes[e + static_cast<std::size_t>(corner[c])])];
        if (v[c] == k_none) fail_loose();
      }
      for (std::size_t n = 0; n < x.size(); ++n) {
        x[n] = Vec3::Zero();
        for (std::size_t k = 0; k < per; ++k) {
          x[n] += values(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k)) *
                  mesh_.points[at(block.nodes[e + k])];
        }
      }
      for (const NodeGroup& group : nodes.groups) {
        put(group, v, std::span(x).subspan(group.first, group.count), dimension(block.shape) == 3);
      }
    }
  }

  void put(const NodeGroup& group, const std::vector<Index>& v, std::span<const Vec3> x,
           bool is_cell) {
    const auto corner = [&](std::size_t i) {
      return v[static_cast<std::size_t>(group.corners[i])];
    };
    if (group.dim == 1) {
      const std::array<Index, 2> ends{corner(0), corner(1)};
      Points forward(x.begin(), x.end());
      if (ends[0] > ends[1]) std::reverse(forward.begin(), forward.end());
      if (add(edge_, corner_key(ends), forward, edge_nodes_, is_cell)) return;
      const std::size_t first = static_cast<std::size_t>(edge_.at(corner_key(ends)));
      for (std::size_t i = 0; i < forward.size(); ++i) {
        if ((edge_nodes_[first + i] - forward[i]).norm() > tolerance_) fail_gap("an edge");
      }
    } else if (group.dim == 2) {
      const bool is_triangle = group.shape == Shape::triangle;
      const CornerKey key =
          is_triangle ? corner_key(std::array{corner(0), corner(1), corner(2)})
                      : corner_key(std::array{corner(0), corner(1), corner(2), corner(3)});
      if (add(face_, key, x, face_nodes_, is_cell)) return;
      // The first element lists them; any other sees the same points in another order.
      const std::size_t first = static_cast<std::size_t>(face_.at(key));
      const std::span<const Vec3> known = std::span(face_nodes_).subspan(first, x.size());
      for (const Vec3& mine : x) {
        if (std::none_of(known.begin(), known.end(), [&](const Vec3& theirs) {
              return (mine - theirs).norm() <= tolerance_;
            })) {
          fail_gap("a face");
        }
      }
    } else if (group.dim == 3) {
      inner_nodes_.insert(inner_nodes_.end(), x.begin(), x.end());
    }
  }

  using Entities = std::unordered_map<CornerKey, std::int64_t, CornerKeyHash>;

  /// @return true if the entity is new; it now is known by the place of its first node
  bool add(Entities& entities, const CornerKey& key, std::span<const Vec3> x, Points& nodes,
           bool is_cell) {
    if (!is_cell) {
      if (!entities.contains(key)) fail_loose();
      return false;
    }
    if (!entities.try_emplace(key, static_cast<std::int64_t>(nodes.size())).second) return false;
    nodes.insert(nodes.end(), x.begin(), x.end());
    return true;
  }

  [[noreturn]] void fail_gap(const char* where) const {
    throw FileError(fmt::format("neighbours make different shapes of {} that they share", where),
                    display_, "write .msh or .cgns, which hold each element's own nodes");
  }
  [[noreturn]] void fail_loose() const {
    throw FileError("a surface element is no face of any cell", display_,
                    "take it out of the mesh: MFEM knows boundary elements only");
  }

  FileSummary write(const std::string& path) {
    OutputFile out(path, display_);
    out.append("MFEM mesh v1.0\n\n");
    for (const EntityRecord& e : mesh_.entities) {
      out.print("# {} {}: {}\n", e.key.dim == 3 ? "attribute" : "boundary attribute", e.key.tag,
                e.name);
    }
    out.append("\ndimension\n3\n");
    write_elements(out, "elements", 3);
    write_elements(out, "boundary", 2);
    out.print("\nvertices\n{}\n", vertices_.size());
    if (order_ > 1) {
      out.print(
          "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P{}\nVDim: 3\n"
          "Ordering: 1\n\n",
          order_);
    } else {
      out.append("3\n");
    }
    for (const Points* nodes : {&vertices_, &edge_nodes_, &face_nodes_, &inner_nodes_}) {
      for (const Vec3& x : *nodes) out.print("{} {} {}\n", x.x(), x.y(), x.z());
    }
    out.finish();
    return {out.size(), out.hash()};
  }

  void write_elements(OutputFile& out, const char* section, int dim) const {
    std::size_t count = 0;
    for (const ElementBlock& b : mesh_.blocks) count += dimension(b.shape) == dim ? b.size() : 0;
    out.print("\n{}\n{}\n", section, count);
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) != dim) continue;
      const std::vector<int>& corner = lattice_map(b.shape, b.order).corner;
      const auto per = static_cast<std::size_t>(nodes_per_element(b.shape, b.order));
      for (std::size_t e = 0; e < b.nodes.size(); e += per) {
        out.print("{} {}", b.entity, geometry_type(b.shape));
        for (const int c : corner) {
          out.print(" {}", vertex_[at(b.nodes[e + static_cast<std::size_t>(c)])]);
        }
        out.append("\n");
      }
    }
  }

  const MeshData& mesh_;
  const std::string& display_;
  int order_ = 0;
  double tolerance_ = 0.0;     // of the current element [length]
  std::vector<Index> vertex_;  // point -> vertex or k_none
  Points vertices_, edge_nodes_, face_nodes_, inner_nodes_;
  Entities edge_, face_;  // -> first node
};

}  // namespace
}  // namespace mfem

NameRules mfem_name_rules() { return {}; }

FileSummary write_mfem(const NamedMesh& named, const std::string& path,
                       const std::string& display) {
  check_mesh(named.mesh, display);
  return mfem::Writer(named, display).run(path);
}

}  // namespace camber::io
