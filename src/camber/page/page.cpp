#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/page/cut_table.hpp>
#include <camber/page/detail/page_template.hpp>
#include <camber/page/detail/payload.hpp>
#include <camber/page/face_deviation.hpp>
#include <camber/page/page.hpp>
#include <camber/pipeline/text_report.hpp>
#include <camber/pipeline/version.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace camber {
namespace {

using Json = nlohmann::ordered_json;
using detail::Payload;

/// Pieces along an edge when a curved cell is cut.
constexpr int k_cut_level = 4;

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

std::vector<float> floats(const Points& points, const Vec3& origin) {
  std::vector<float> result;
  result.reserve(points.size() * 3);
  for (const Vec3& x : points) {
    for (int d = 0; d < 3; ++d) result.push_back(static_cast<float>(x[d] - origin[d]));
  }
  return result;
}

std::vector<std::int16_t> shorts(const Points& normals) {
  std::vector<std::int16_t> result;
  result.reserve(normals.size() * 3);
  for (const Vec3& n : normals) {
    for (int d = 0; d < 3; ++d) {
      result.push_back(static_cast<std::int16_t>(std::lround(n[d] * 32767.0)));
    }
  }
  return result;
}

std::string patch_name(const MeshData& mesh, const ElementList& surfaces, Index surface) {
  if (surface == k_none) return "no surface element";
  const int entity = surfaces.entity(at(surface));
  for (const EntityRecord& record : mesh.entities) {
    if (record.key == EntityKey{2, entity} && !record.name.empty()) return record.name;
  }
  return fmt::format("surface {}", entity);
}

/// One page in the making: the parts of the payload, in the order of the calls.
class PageWriter {
 public:
  PageWriter(const PageContent& content, const GeometryModel* geometry, const PageOptions& options)
      : content_(content),
        geometry_(geometry),
        options_(options),
        cells_(content.mesh, 3),
        surfaces_(content.mesh, 2),
        faces_(boundary_faces(cells_, surfaces_)) {
    if (cells_.size() == 0) {
      throw MeshError("the mesh has no volume cells to show", content.mesh.source,
                      "give a mesh with tets, pyramids, prisms or hexes");
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      for (Index n : cells_.nodes(c)) box_.add(content.mesh.points[at(n)]);
    }
  }

  std::string run() {
    add_surface();
    add_cells();
    add_volume();
    Json about{{"version", version()},
               {"title", content_.title},
               {"origin", {box_.centre().x(), box_.centre().y(), box_.centre().z()}},
               {"size", box_.diagonal()},
               {"cells", cells_.size()},
               {"faces", faces_.size()},
               {"triangles", triangles_},
               {"patches", patches_},
               {"tables", tables_},
               {"has_deviation", has_deviation_},
               {"corners_only", corners_only_},
               {"notices", notices_}};
    payload_.add_json("about", about.dump());
    if (!content_.report.empty()) payload_.add_json("report", content_.report);
    std::string page(detail::page_template());
    const std::size_t place = page.find(detail::k_data_mark);
    page.replace(place, detail::k_data_mark.size(), payload_.text());
    return page;
  }

 private:
  [[nodiscard]] std::vector<GeometryGroup> groups() const {
    std::vector<GeometryGroup> result(faces_.size());
    if (!geometry_ || content_.surface_groups.empty()) return result;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].surface != k_none) {
        result[f] = content_.surface_groups[at(faces_[f].surface)];
      }
    }
    return result;
  }

  void add_surface() {
    const std::vector<GeometryGroup> group = groups();
    std::vector<int> finer(faces_.size(), 1);
    for (std::size_t f = 0; geometry_ && f < faces_.size(); ++f) {
      // Between the nodes, where the distance is largest, not on them.
      if (is_curved(group[f], *geometry_)) finer[f] = cells_.order(faces_[f].cell) + 2;
    }
    const Tessellation t = tessellate(cells_, faces_, finer, options_.tessellation);
    triangles_ = t.triangles.size();
    if (t.is_reduced) {
      notices_.push_back(fmt::format(
          "The surface would need more than {} triangles: its curved faces are drawn coarser.",
          options_.tessellation.max_triangles));
    }
    if (triangles_ > options_.tessellation.max_triangles) {
      notices_.push_back(fmt::format("{} triangles: a slow machine may stutter.", triangles_));
    }
    payload_.add("point", floats(t.points, box_.centre()));
    payload_.add("normal", shorts(t.normals));
    payload_.add("face_corners", t.corners);
    payload_.add("face_level", t.level);
    payload_.add("face_own_edges", t.own_edges);
    std::vector<std::uint16_t> triangles;
    triangles.reserve(t.triangles.size() * 3);
    for (const auto& triangle : t.triangles) {
      triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    }
    payload_.add("triangle", triangles);
    payload_.add("face_first_triangle", t.first_triangle);
    add_faces(t, group);
  }

  /// Measured where the geometry is at hand, else what the run that made the mesh found by face.
  [[nodiscard]] SurfaceDeviation deviations(const Tessellation& t,
                                            const std::vector<GeometryGroup>& group) const {
    if (geometry_) return surface_deviation(cells_, faces_, group, t, *geometry_);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    SurfaceDeviation result{std::vector<double>(faces_.size(), nan),
                            std::vector<double>(faces_.size(), nan),
                            std::vector<double>(t.points.size(), nan)};
    if (content_.surface_deviation.empty()) return result;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].surface == k_none) continue;
      result.face[f] = content_.surface_deviation[at(faces_[f].surface)];
      std::fill(result.point.begin() + t.first_point[f],
                result.point.begin() + t.first_point[f + 1], result.face[f]);
    }
    return result;
  }

  void add_faces(const Tessellation& t, const std::vector<GeometryGroup>& group) {
    std::map<std::string, std::uint16_t> patches;
    std::vector<std::uint32_t> cell;
    std::vector<std::uint16_t> patch;
    for (const BoundaryFace& face : faces_) {
      cell.push_back(static_cast<std::uint32_t>(face.cell));
      const std::string name = patch_name(content_.mesh, surfaces_, face.surface);
      const auto [place, is_new] =
          patches.try_emplace(name, static_cast<std::uint16_t>(patches.size()));
      if (is_new) patches_.push_back(name);
      patch.push_back(place->second);
    }
    payload_.add("face_cell", cell);
    payload_.add("face_patch", patch);
    cell_deviation_.assign(cells_.size(), std::numeric_limits<float>::quiet_NaN());
    const SurfaceDeviation deviation = deviations(t, group);
    has_deviation_ = std::any_of(deviation.face.begin(), deviation.face.end(),
                                 [](double d) { return std::isfinite(d); });
    if (!has_deviation_) return;
    payload_.add("point_deviation", floats(deviation.point));
    payload_.add("face_linear_deviation", floats(deviation.linear));
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      float& worst = cell_deviation_[faces_[f].cell];
      // A comparison with NaN is false: the first number replaces it.
      if (!(worst >= deviation.face[f])) worst = static_cast<float>(deviation.face[f]);
    }
  }

  void add_cells() {
    std::vector<double> number;
    std::vector<std::uint8_t> shape, order;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      number.push_back(static_cast<double>(cells_.tag(c)));
      shape.push_back(static_cast<std::uint8_t>(cells_.shape(c)));
      order.push_back(static_cast<std::uint8_t>(cells_.order(c)));
    }
    payload_.add("cell_number", number);
    payload_.add("cell_shape", shape);
    payload_.add("cell_order", order);
    payload_.add("cell_bound", floats(content_.findings.bound));
    payload_.add("cell_cost", floats(content_.findings.cost));
    payload_.add("cell_deviation", cell_deviation_);
  }

  /// Nodes of all cells, and for each kind of cell how it is cut.
  void add_volume() {
    std::size_t nodes = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c) nodes += cells_.nodes(c).size();
    const std::size_t bytes =
        nodes * sizeof(std::uint32_t) + content_.mesh.points.size() * 3 * sizeof(float);
    corners_only_ = bytes > options_.max_volume_bytes;
    if (corners_only_) {
      notices_.push_back(
          "The mesh is large: the cut shows cells by their corners, without their curvature.");
    }
    std::vector<std::uint32_t> node;
    std::vector<std::uint32_t> new_number(content_.mesh.points.size(),
                                          std::numeric_limits<std::uint32_t>::max());
    Points points;
    std::set<std::pair<Shape, int>> kinds;
    const auto put = [&](Index n) {
      if (new_number[at(n)] == std::numeric_limits<std::uint32_t>::max()) {
        new_number[at(n)] = static_cast<std::uint32_t>(points.size());
        points.push_back(content_.mesh.points[at(n)]);
      }
      node.push_back(new_number[at(n)]);
    };
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const LatticeMap& map = lattice_map(cells_.shape(c), cells_.order(c));
      kinds.insert({cells_.shape(c), corners_only_ ? 1 : cells_.order(c)});
      if (!corners_only_) {
        for (Index n : cells_.nodes(c)) put(n);
        continue;
      }
      // Lattice order of order 1, not corner order.
      const std::vector<int>& place = lattice_map(cells_.shape(c), 1).corner;
      std::vector<Index> in_order(place.size());
      for (std::size_t k = 0; k < place.size(); ++k) {
        in_order[static_cast<std::size_t>(place[k])] =
            cells_.nodes(c)[static_cast<std::size_t>(map.corner[k])];
      }
      for (Index n : in_order) put(n);
    }
    payload_.add("volume_point", floats(points, box_.centre()));
    payload_.add("volume_node", node);
    for (const auto& [shape, order] : kinds) add_table(shape, order);
  }

  /// Linear tets are flat; the quadrilaterals of other linear cells are bilinear, but little so.
  [[nodiscard]] int cut_level(Shape shape, int order) const {
    if (order > 1) return std::max(order, k_cut_level);
    return shape == Shape::tetrahedron || corners_only_ ? 1 : 2;
  }

  void add_table(Shape shape, int order) {
    const int level = cut_level(shape, order);
    const MatX& E = elevation_matrix(shape, order, level);
    std::vector<double> matrix;
    for (Eigen::Index r = 0; r < E.rows(); ++r) {
      for (Eigen::Index c = 0; c < E.cols(); ++c) {
        matrix.push_back(std::abs(E(r, c)) < 1e-14 ? 0.0 : E(r, c));
      }
    }
    const std::vector<std::array<int, 4>> tets = lattice_tetrahedra(shape, level);
    Json edge_list = Json::array();
    for (const std::vector<int>& edge : lattice_map(shape, level).edge) edge_list.push_back(edge);
    tables_.push_back({{"shape", static_cast<int>(shape)},
                       {"name", name(shape)},
                       {"order", order},
                       {"nodes", E.cols()},
                       {"points", E.rows()},
                       {"matrix", matrix},
                       {"corners", lattice_map(shape, order).corner},
                       {"corner_points", lattice_map(shape, level).corner},
                       {"tets", tets},
                       {"skin", skin(tets)},
                       {"edges", edge_list}});
  }

  const PageContent& content_;
  const GeometryModel* geometry_;
  const PageOptions& options_;
  ElementList cells_, surfaces_;
  std::vector<BoundaryFace> faces_;
  Box box_;
  Payload payload_;
  Json patches_ = Json::array(), tables_ = Json::array(), notices_ = Json::array();
  std::vector<float> cell_deviation_;
  std::size_t triangles_ = 0;
  bool has_deviation_ = false, corners_only_ = false;
};

}  // namespace

std::string page_html(const PageContent& content, const GeometryModel* geometry,
                      const PageOptions& options) {
  return PageWriter(content, geometry, options).run();
}

PageContent page_content(MeshData mesh, CellFindings findings, const Report& report,
                         const GeometryModel* geometry) {
  PageContent content;
  content.title = std::filesystem::path(mesh.source).filename().string();
  content.mesh = std::move(mesh);
  content.findings = std::move(findings);
  content.report = json_report(report);
  if (!geometry) return content;
  const ElementList surfaces(content.mesh, 2);
  content.surface_groups.resize(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const int entity = surfaces.entity(i);
    if (entity >= 1 && entity <= geometry->count(2)) {
      content.surface_groups[i] = {{2, entity}};
    }
  }
  return content;
}

PageContent page_content(const CurveResult& result, const std::string& title) {
  PageContent content;
  content.title = title;
  ExportMap map;
  content.mesh = export_mesh(*result.curved, 0, &map);
  content.mesh.source = result.report.input.mesh;
  content.report = json_report(result.report);
  std::size_t element = 0;
  for (const ElementBlock& block : content.mesh.blocks) {
    for (std::size_t i = 0; i < block.size(); ++i, ++element) {
      if (dimension(block.shape) == 3) {
        const Index c = map.cell[element];
        content.findings.bound.push_back(result.cell_bound[at(c)]);
        content.findings.cost.push_back(result.cell_cost[at(c)]);
      } else if (dimension(block.shape) == 2) {
        const Index f = map.face[element];
        const Patch* patch = f == k_none ? nullptr : result.association.patch_of(f);
        content.surface_groups.push_back(patch ? patch->group : GeometryGroup{});
        content.surface_deviation.push_back(f == k_none ? std::numeric_limits<double>::quiet_NaN()
                                                        : result.face_deviation[at(f)]);
      }
    }
  }
  return content;
}

}  // namespace camber
