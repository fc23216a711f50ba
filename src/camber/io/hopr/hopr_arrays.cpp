#include <camber/base/by_key.hpp>
#include <camber/base/error.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/hopr/hilbert_order.hpp>
#include <camber/io/hopr/hopr_arrays.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

namespace camber::io::hopr {
namespace {

constexpr std::int32_t k_inner_condition = 100;
constexpr std::array<std::int32_t, k_counted_types> k_types{104, 204, 105, 115, 205, 106,
                                                            116, 206, 108, 118, 208};

std::int32_t element_type(Shape shape, int order) {
  const int corners = corner_count(shape);
  if (order > 1) return 200 + corners;
  return (shape == Shape::tetrahedron ? 100 : 110) +
         corners;  // 11x: straight edges, maybe not flat
}

std::int32_t side_type(Shape shape, int order) {
  const int corners = corner_count(shape);
  if (order > 1) return 20 + corners;
  return shape == Shape::triangle ? 3 : 14;
}

class Maker {
 public:
  Maker(const NamedMesh& named, const std::string& display)
      : mesh_(named.mesh), display_(display) {}

  Arrays run() {
    check_sizes();
    for (const EntityRecord& e : mesh_.entities) {
      if (e.key.dim != 2) continue;
      arrays_.bc_names.push_back(e.name);
      arrays_.bc_types.insert(arrays_.bc_types.end(), {0, 0, 0, 0});
    }
    arrays_.elem_counter.resize(2 * k_counted_types, 0);
    for (std::size_t i = 0; i < k_counted_types; ++i) arrays_.elem_counter[2 * i] = k_types[i];
    node_id_.resize(mesh_.points.size(), 0);
    add_cells();
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) == 2) add_patch(b);
    }
    name_the_rest();
    return std::move(arrays_);
  }

 private:
  void check_sizes() {
    std::size_t nodes = 0;
    for (const ElementBlock& b : mesh_.blocks) {
      if (arrays_.order != 0 && b.order != arrays_.order) {
        throw FileError("elements of different orders in a format that holds one", display_,
                        "raise all to one order: camber convert --order");
      }
      arrays_.order = b.order;
      if (dimension(b.shape) == 3) nodes += b.nodes.size();
    }
    if (nodes > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw FileError("the mesh has more nodes than 32 bits can count", display_,
                      "write .msh or .cgns");
    }
  }

  struct Cell {
    const ElementBlock* block;
    std::size_t first;  // place of its nodes in the block
  };

  static std::size_t node_count_of(const ElementBlock& b) {
    return static_cast<std::size_t>(nodes_per_element(b.shape, b.order));
  }
  [[nodiscard]] static std::vector<Index> corners_of(const Cell& cell) {
    std::vector<Index> v;
    for (const int c : lattice_map(cell.block->shape, cell.block->order).corner) {
      v.push_back(cell.block->nodes[cell.first + static_cast<std::size_t>(c)]);
    }
    return v;
  }

  /// Along the curve: solvers give each process a range of the elements.
  void add_cells() {
    std::vector<Cell> cells;
    Points centres;
    for (const ElementBlock& b : mesh_.blocks) {
      if (dimension(b.shape) < 3) continue;
      for (std::size_t e = 0; e < b.nodes.size(); e += node_count_of(b)) {
        cells.push_back({&b, e});
        const std::vector<Index> v = corners_of(cells.back());
        Vec3 centre = Vec3::Zero();
        for (const Index i : v) centre += mesh_.points[at(i)] / static_cast<double>(v.size());
        centres.push_back(centre);
      }
    }
    for (const std::size_t c : hilbert_order(centres)) add_cell(cells[c], centres[c]);
  }

  void add_cell(const Cell& cell, const Vec3& centre) {
    const ElementBlock& b = *cell.block;
    const std::size_t per = node_count_of(b);
    const std::int32_t type = element_type(b.shape, b.order);
    const auto place = std::find(k_types.begin(), k_types.end(), type) - k_types.begin();
    const auto sides = static_cast<std::int32_t>(arrays_.sides());
    const auto nodes = static_cast<std::int32_t>(arrays_.nodes());
    ++arrays_.elem_counter[2 * static_cast<std::size_t>(place) + 1];
    const auto element = static_cast<std::int32_t>(arrays_.elements()) + 1;
    arrays_.elem_info.insert(arrays_.elem_info.end(),
                             {type, b.entity, sides, sides + face_count(b.shape), nodes,
                              nodes + static_cast<std::int32_t>(per)});
    arrays_.barycenters.insert(arrays_.barycenters.end(), {centre.x(), centre.y(), centre.z()});
    for (std::size_t n = 0; n < per; ++n) {
      const Index i = b.nodes[cell.first + n];
      const Vec3& x = mesh_.points[at(i)];
      arrays_.node_coords.insert(arrays_.node_coords.end(), {x.x(), x.y(), x.z()});
      if (node_id_[at(i)] == 0) node_id_[at(i)] = ++arrays_.unique_nodes;
      arrays_.node_ids.push_back(node_id_[at(i)]);
    }
    add_sides(b.shape, corners_of(cell), element);
  }

  static std::int32_t face_count(Shape shape) {
    return static_cast<std::int32_t>(faces(shape).size());
  }

  struct Side {
    std::size_t row = 0;  // of the first to see it
    std::int32_t element = 0, local = 0;
    std::vector<Index> corners;  // as the first walks it
    bool is_shared = false;
  };

  void add_sides(Shape shape, const std::vector<Index>& v, std::int32_t element) {
    std::int32_t local = 0;
    for (const LocalFace& face : faces(shape)) {
      ++local;
      std::vector<Index> corners;
      for (const int c : face.corners) {
        if (c >= 0) corners.push_back(v[static_cast<std::size_t>(c)]);
      }
      const std::size_t row = arrays_.sides();
      const auto [place, is_new] = side_of_.try_emplace(corner_key(corners));
      Side& side = place->second;
      std::int32_t number = 0, neighbour = 0, link = 0;
      if (is_new) {
        number = ++arrays_.unique_sides;
        side = {row, element, local, corners, false};
      } else {
        const std::int32_t flip = flip_of(side, corners);
        std::int32_t* const first = &arrays_.side_info[side.row * k_side_columns];
        first[2] = element;
        first[3] = 10 * local + flip;
        number = -first[1];
        neighbour = side.element;
        link = 10 * side.local + flip;
        side.is_shared = true;
      }
      arrays_.side_info.insert(arrays_.side_info.end(),
                               {side_type(face.shape, arrays_.order), number, neighbour, link, 0});
      if (!is_new) second_row_[side.row] = row;
    }
  }

  /// Place, from 1, of my first corner on the side as the neighbour walks it: the other way round.
  [[nodiscard]] std::int32_t flip_of(const Side& side, const std::vector<Index>& mine) const {
    const std::size_t n = mine.size();
    const auto found = std::find(side.corners.begin(), side.corners.end(), mine[0]);
    const auto k = static_cast<std::size_t>(found - side.corners.begin());
    bool is_reversed = !side.is_shared;
    for (std::size_t i = 0; i < n; ++i) {
      is_reversed = is_reversed && side.corners[(k + n - i) % n] == mine[i];
    }
    if (!is_reversed) {
      throw FileError("a face with more than two cells, or with both on one side", display_,
                      "repair the mesh, or write .msh");
    }
    return static_cast<std::int32_t>(k) + 1;
  }

  void add_patch(const ElementBlock& b) {
    const auto per = static_cast<std::size_t>(nodes_per_element(b.shape, b.order));
    const std::vector<int>& corner = lattice_map(b.shape, b.order).corner;
    for (std::size_t e = 0; e < b.nodes.size(); e += per) {
      std::vector<Index> v;
      for (const int c : corner) v.push_back(b.nodes[e + static_cast<std::size_t>(c)]);
      const auto found = side_of_.find(corner_key(v));
      if (found == side_of_.end()) {
        throw FileError("a surface element is no face of any cell", display_,
                        "take it out of the mesh: this format knows faces of cells only");
      }
      const Side& side = found->second;
      condition(side.row) = b.entity;
      if (!side.is_shared) continue;
      condition(second_row_.at(side.row)) = b.entity;
      arrays_.bc_types[k_type_columns * static_cast<std::size_t>(b.entity - 1)] = k_inner_condition;
    }
  }

  std::int32_t& condition(std::size_t row) { return arrays_.side_info[row * k_side_columns + 4]; }

  /// A boundary side must have a condition.
  void name_the_rest() {
    const auto next = static_cast<std::int32_t>(arrays_.bc_names.size()) + 1;
    bool is_needed = false;
    for (std::size_t row = 0; row < arrays_.sides(); ++row) {
      if (arrays_.side_info[row * k_side_columns + 2] != 0 || condition(row) != 0) continue;
      condition(row) = next;
      is_needed = true;
    }
    if (!is_needed) return;
    std::vector<std::string> used = arrays_.bc_names;
    arrays_.bc_names.push_back(unique_name("boundary", {.longest = k_name_length}, used));
    arrays_.bc_types.insert(arrays_.bc_types.end(), {0, 0, 0, 0});
  }

  const MeshData& mesh_;
  const std::string& display_;
  Arrays arrays_;
  std::vector<std::int32_t> node_id_;  // point -> number or 0
  std::unordered_map<CornerKey, Side, CornerKeyHash> side_of_;
  std::unordered_map<std::size_t, std::size_t> second_row_;  // row of the first -> of the second
};

}  // namespace

Arrays make_arrays(const NamedMesh& named, const std::string& display) {
  check_mesh(named.mesh, display);
  return Maker(named, display).run();
}

}  // namespace camber::io::hopr
