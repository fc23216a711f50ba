#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/node_order.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/detail/prism_direction.hpp>
#include <camber/io/vtu/vtu_arrays.hpp>
#include <camber/io/vtu/vtu_reader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace camber::io {
namespace vtu {
namespace {

/// The five nodes that VTK's 19-node pyramid has beyond ours must lie on the polynomial of the
/// other 14, but for rounding: share of the cell's size.
constexpr double k_same = 1e-9;
/// Until version 2.1 hexahedra had their last two upright edges the other way round.
constexpr double k_new_hexahedra = 2.1;

struct CellType {
  Shape shape = Shape::point;
  int order = 1;
};

/// The order with that many nodes; 0 if there is none.
int order_of(Shape shape, std::size_t nodes) {
  for (int p = 1; p <= k_max_order; ++p) {
    if (static_cast<std::size_t>(node_count(shape, p)) == nodes) return p;
  }
  return 0;
}

/// Cells of surfaces and volumes; empty for those that cannot be represented.
std::optional<CellType> cell_type(long long type, std::size_t nodes) {
  const auto of = [&](Shape shape, int low, int high) -> std::optional<CellType> {
    const int order = order_of(shape, nodes);
    if (order < low || order > high) return std::nullopt;
    return CellType{shape, order};
  };
  switch (type) {
    case 5:
      return of(Shape::triangle, 1, 1);
    case 9:
      return of(Shape::quadrilateral, 1, 1);
    case 10:
      return of(Shape::tetrahedron, 1, 1);
    case 12:
      return of(Shape::hexahedron, 1, 1);
    case 13:
      return of(Shape::prism, 1, 1);
    case 14:
      return of(Shape::pyramid, 1, 1);
    case 22:  // quadratic triangle
      return of(Shape::triangle, 2, 2);
    case 28:  // biquadratic quadrilateral
      return of(Shape::quadrilateral, 2, 2);
    case 24:  // quadratic tetrahedron
      return of(Shape::tetrahedron, 2, 2);
    case 29:  // triquadratic hexahedron
      return of(Shape::hexahedron, 2, 2);
    case 32:  // biquadratic quadratic wedge
      return of(Shape::prism, 2, 2);
    case 37:  // triquadratic pyramid
      if (nodes == 19) return CellType{Shape::pyramid, 2};
      return std::nullopt;
    case 69:
      return of(Shape::triangle, 1, k_max_order);
    case 70:
      return of(Shape::quadrilateral, 1, k_max_order);
    case 71:
      return of(Shape::tetrahedron, 1, k_max_order);
    case 72:
      return of(Shape::hexahedron, 1, k_max_order);
    case 73:
      return of(Shape::prism, 1, k_max_order);
    default:
      return std::nullopt;
  }
}

bool is_left_out(long long type) {
  // Vertices, lines and their curved kin.
  constexpr std::array k_types{0LL, 1LL, 2LL, 3LL, 4LL, 21LL, 35LL, 68LL, 75LL};
  return std::find(k_types.begin(), k_types.end(), type) != k_types.end();
}

/// place in the file -> canonical node, for all but pyramids of order 2.
std::vector<int> node_order_of(CellType type, bool has_old_hexahedra) {
  const std::span<const int> order = file_to_canonical(NodeConvention::vtk, type.shape, type.order);
  std::vector<int> result(order.begin(), order.end());
  if (type.shape == Shape::hexahedron && has_old_hexahedra) {
    const std::ptrdiff_t n = type.order - 1, first = 8 + 10 * n;
    std::swap_ranges(result.begin() + first, result.begin() + first + n,
                     result.begin() + first + n);
  }
  return result;
}

class Reader {
 public:
  Reader(const std::string& path, std::string_view bytes)
      : document_(path, bytes), builder_(path) {}

  MeshData run() {
    pugi::xml_document xml;
    const pugi::xml_parse_result result =
        xml.load_buffer(document_.xml().data(), document_.xml().size());
    const pugi::xml_node root = xml.child("VTKFile");
    if (!result || !root) {
      document_.fail(fmt::format("no VTK file: {}",
                                 result ? "the root is not <VTKFile>" : result.description()),
                     "give a .vtu file");
    }
    document_.set_header(root);
    has_old_hexahedra_ = root.attribute("version").as_double() < k_new_hexahedra;
    for (const pugi::xml_node& piece : root.child("UnstructuredGrid").children("Piece")) {
      read_piece(piece);
    }
    if (cells_ == 0) document_.fail("no cells of a volume were found", "give a volume mesh");
    return builder_.finish();
  }

 private:
  void read_piece(const pugi::xml_node& piece) {
    const std::vector<double> x = document_.reals(piece.child("Points").child("DataArray"));
    const std::size_t first = builder_.points().size();
    const std::size_t count = x.size() / 3;
    if (x.size() % 3 != 0 || count != piece.attribute("NumberOfPoints").as_ullong()) {
      document_.fail(fmt::format("{} coordinates for {} points", x.size(),
                                 piece.attribute("NumberOfPoints").value()),
                     "three a point are needed");
    }
    if (first + count > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
      document_.fail("more points than can be numbered", "");
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 point(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
      if (!point.allFinite()) {
        document_.fail(fmt::format("point {} has a coordinate that is not finite", i), "");
      }
      builder_.points().push_back(point);
    }
    const pugi::xml_node cells = piece.child("Cells");
    const std::vector<long long> nodes = document_.integers(named(cells, "connectivity")),
                                 ends = document_.integers(named(cells, "offsets")),
                                 types = document_.integers(named(cells, "types"));
    if (types.size() != ends.size() ||
        types.size() != piece.attribute("NumberOfCells").as_ullong()) {
      document_.fail("the counts of cells, types and offsets differ", "write the file again");
    }
    const std::vector<long long> entity = entities(piece.child("CellData"), types.size());
    refuse_cut_pyramids(piece.child("CellData"), types.size());
    long long begin = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      if (ends[c] < begin || ends[c] > static_cast<long long>(nodes.size())) {
        document_.fail(fmt::format("cell {} ends at {}, outside of the connectivity", c, ends[c]),
                       "write the file again");
      }
      const auto size = static_cast<std::size_t>(ends[c] - begin);
      add_cell(c, types[c], std::span(nodes).subspan(static_cast<std::size_t>(begin), size), first,
               count, entity.empty() ? std::nullopt : std::optional(entity[c]));
      begin = ends[c];
    }
  }

  static pugi::xml_node named(const pugi::xml_node& parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
  }

  [[nodiscard]] std::vector<long long> entities(const pugi::xml_node& data,
                                                std::size_t cells) const {
    for (const char* name :
         {"entity", "CellEntityIds", "gmsh:geometrical", "attribute", "material"}) {
      const pugi::xml_node array = named(data, name);
      if (!array) continue;
      const std::string_view type = array.attribute("type").value();
      if (type.substr(0, 5) == "Float") continue;
      std::vector<long long> values = document_.integers(array);
      if (values.size() == cells) return values;
    }
    return {};
  }

  /// What write_vtu makes of pyramids of order 3 and 4 is good for the eye only.
  void refuse_cut_pyramids(const pugi::xml_node& data, std::size_t cells) const {
    const pugi::xml_node array = named(data, "element");
    if (!array || !named(data, "order") || !named(data, "dim")) return;
    const std::vector<long long> element = document_.integers(array);
    if (element.size() != cells) return;
    if (std::set<long long>(element.begin(), element.end()).size() < cells) {
      document_.fail("holds pyramids of order 3 or 4 that were cut into pieces for viewing",
                     "read the .msh or .cgns file of the mesh");
    }
  }

  void add_cell(std::size_t c, long long type, std::span<const long long> nodes, std::size_t first,
                std::size_t points, std::optional<long long> entity) {
    if (is_left_out(type)) return;
    const std::optional<CellType> kind = cell_type(type, nodes.size());
    if (!kind) {
      document_.fail(fmt::format("cell {} has VTK type {} and {} nodes", c, type, nodes.size()),
                     "linear, complete quadratic and Lagrange cells up to order 4 can be read");
    }
    std::vector<Index> global;
    for (const long long n : nodes) {
      if (n < 0 || n >= static_cast<long long>(points)) {
        document_.fail(fmt::format("cell {} has node {} of {} points", c, n, points),
                       "write the file again");
      }
      global.push_back(static_cast<Index>(first + static_cast<std::size_t>(n)));
    }
    const std::vector<Index> canonical = type == 37                 ? pyramid_nodes(c, global)
                                         : type == 13 || type == 32 ? wedge_nodes(*kind, global)
                                                                    : ordered(*kind, global);
    const int dim = dimension(kind->shape);
    const char* const stem = dim == 3 ? "volume" : "surface";
    const std::string name = entity ? fmt::format("{}_{}", stem, *entity) : stem;
    builder_.add(kind->shape, kind->order, builder_.entity(dim, name), canonical);
    cells_ += dim == 3 ? 1 : 0;
  }

  [[nodiscard]] std::vector<Index> ordered(CellType kind, const std::vector<Index>& file) const {
    const std::vector<int> order = node_order_of(kind, has_old_hexahedra_);
    std::vector<Index> canonical(order.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
      canonical[static_cast<std::size_t>(order[n])] = file[n];
    }
    return canonical;
  }

  /// By VTK's documentation the first triangle of a linear wedge looks outwards, by the habit of
  /// many programs inwards: the volume tells.
  [[nodiscard]] std::vector<Index> wedge_nodes(CellType kind, const std::vector<Index>& file) {
    std::vector<Index> nodes = ordered(kind, file);
    if (is_mirrored_prism(builder_.points(), kind.order, nodes)) mirror_prism(kind.order, nodes);
    return nodes;
  }

  [[nodiscard]] std::vector<Index> pyramid_nodes(std::size_t c, const std::vector<Index>& file) {
    const LatticeMap& map = lattice_map(Shape::pyramid, 2);
    std::vector<Index> canonical(static_cast<std::size_t>(node_count(Shape::pyramid, 2)));
    std::size_t next = 0;
    const auto put = [&](int n) { canonical[static_cast<std::size_t>(n)] = file[next++]; };
    for (const int n : map.corner) put(n);
    for (const std::vector<int>& edge : map.edge) put(edge[1]);
    put(lattice_index(Shape::pyramid, 2, {1, 1, 0}));
    Points nodes;
    Box box;
    for (const Index i : canonical) {
      nodes.push_back(builder_.points()[at(i)]);
      box.add(nodes.back());
    }
    // Centroids of the triangles 014, 124, 234, 304, then a quarter up the axis.
    const std::span<const Vec3> ends = corners(Shape::pyramid);
    std::vector<Vec3> xi;
    for (std::size_t i = 0; i < 4; ++i) xi.push_back((ends[i] + ends[(i + 1) % 4] + ends[4]) / 3.0);
    xi.push_back(0.1875 * (ends[0] + ends[1] + ends[2] + ends[3]) + 0.25 * ends[4]);
    for (const Vec3& at_xi : xi) {
      const Vec3 x = evaluate(Shape::pyramid, 2, nodes, at_xi);
      if ((x - builder_.points()[at(file[next++])]).norm() > k_same * box.diagonal()) {
        document_.fail(
            fmt::format("cell {}, a pyramid of 19 nodes, is no polynomial of order 2", c),
            "write pyramids of 14 nodes to .msh or .cgns");
      }
    }
    return canonical;
  }

  Document document_;
  NamedMeshBuilder builder_;
  bool has_old_hexahedra_ = false;
  std::size_t cells_ = 0;  // of volumes
};

}  // namespace
}  // namespace vtu

MeshData parse_vtu(const std::string& path, std::string_view bytes) {
  return vtu::Reader(path, bytes).run();
}

MeshData read_vtu(const std::string& path) { return parse_vtu(path, InputFile(path).text()); }

}  // namespace camber::io
