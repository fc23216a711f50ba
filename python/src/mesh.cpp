// MeshData: files, arrays that look at it, and a mesh made from arrays.
#include <camber/base/error.hpp>
#include <camber/basis/node_order.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/pipeline/check.hpp>

#include <algorithm>
#include <cstring>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include "bindings.hpp"

namespace camber::python {
namespace {

using Shared = std::shared_ptr<MeshData>;
using PointArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using NodeArray = py::array_t<Index, py::array::c_style | py::array::forcecast>;
using EntityArray = py::array_t<int, py::array::c_style | py::array::forcecast>;

Shape shape_of(const std::string& text) {
  for (int s = 0; s < k_shape_count; ++s) {
    if (name(static_cast<Shape>(s)) == text) return static_cast<Shape>(s);
  }
  throw MeshError(fmt::format("'{}' is no shape of an element", text), "blocks",
                  "give point, line, tri, quad, tet, pyramid, prism or hex");
}

int nodes_per_element(Shape shape, int order) {
  return shape == Shape::point ? 1 : node_count(shape, order);
}

/// Places of the canonical nodes in an element's row: what row[place[i]] is canonical node i.
std::vector<int> canonical_places(Shape shape, int order, const std::string& convention) {
  const auto count = static_cast<std::size_t>(nodes_per_element(shape, order));
  std::vector<int> place(count);
  for (std::size_t i = 0; i < count; ++i) place[i] = static_cast<int>(i);
  if (convention == "lattice" || shape == Shape::point) return place;
  if (convention != "gmsh") {
    throw OptionError(fmt::format("'{}' is no order of nodes", convention), "node_order",
                      "give gmsh or lattice");
  }
  const std::span<const int> canonical = file_to_canonical(NodeConvention::gmsh, shape, order);
  for (std::size_t i = 0; i < count; ++i) {
    place[static_cast<std::size_t>(canonical[i])] = static_cast<int>(i);
  }
  return place;
}

void add_block(MeshData& mesh, const std::string& shape_name, int order, int entity,
               const NodeArray& rows, const std::string& convention) {
  ElementBlock block;
  block.shape = shape_of(shape_name);
  if (order < 1 || order > k_max_order) {
    throw MeshError(fmt::format("a block of order {}", order), mesh.source,
                    fmt::format("give an order from 1 to {}", k_max_order));
  }
  block.order = order;
  block.entity = entity;
  const int width = nodes_per_element(block.shape, order);
  if (rows.ndim() != 2 || rows.shape(1) != width) {
    throw MeshError(fmt::format("elements of shape {} and order {} need an array (elements, {})",
                                shape_name, order, width),
                    mesh.source, "give one row of node indices an element");
  }
  const std::vector<int> place = canonical_places(block.shape, order, convention);
  const auto count = static_cast<std::size_t>(rows.shape(0));
  const Index last = static_cast<Index>(mesh.points.size()) - 1;
  block.nodes.resize(count * place.size());
  for (std::size_t e = 0; e < count; ++e) {
    const Index* row = rows.data() + e * place.size();
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Index node = row[place[i]];
      if (node < 0 || node > last) {
        throw MeshError(fmt::format("element {} of the {} block has node {}, points are 0..{}", e,
                                    shape_name, node, last),
                        mesh.source, "count nodes from 0");
      }
      block.nodes[e * place.size() + i] = node;
    }
  }
  mesh.blocks.push_back(std::move(block));
}

Shared make_mesh(const PointArray& points, const std::string& source) {
  if (points.ndim() != 2 || points.shape(1) != 3) {
    throw MeshError("points need an array (points, 3)", source, "give x, y and z of every point");
  }
  auto mesh = std::make_shared<MeshData>();
  mesh->source = source;
  mesh->points.resize(static_cast<std::size_t>(points.shape(0)));
  if (!mesh->points.empty()) {
    std::memcpy(mesh->points.front().data(), points.data(), mesh->points.size() * sizeof(Vec3));
  }
  const auto* bad = std::find_if(mesh->points.data(), mesh->points.data() + mesh->points.size(),
                                 [](const Vec3& x) { return !x.allFinite(); });
  if (bad != mesh->points.data() + mesh->points.size()) {
    throw MeshError(fmt::format("point {} is not finite", bad - mesh->points.data()), source,
                    "give finite coordinates");
  }
  return mesh;
}

void set_point_entities(MeshData& mesh, const EntityArray& keys) {
  if (keys.ndim() != 2 || keys.shape(1) != 2 ||
      static_cast<std::size_t>(keys.shape(0)) != mesh.points.size()) {
    throw MeshError("point_entity needs an array (points, 2)", mesh.source,
                    "give dimension (-1: unknown) and tag of every point");
  }
  mesh.point_entity.resize(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    mesh.point_entity[i] = {keys.data()[2 * i], keys.data()[2 * i + 1]};
    if (mesh.point_entity[i].dim < -1 || mesh.point_entity[i].dim > 3) {
      throw MeshError(
          fmt::format("point {} is on an entity of dimension {}", i, mesh.point_entity[i].dim),
          mesh.source, "give a dimension from 0 to 3, or -1 where it is unknown");
    }
  }
}

void add_name(MeshData& mesh, int dim, int tag, const std::string& group) {
  if (dim < 0 || dim > 3) {
    throw MeshError(fmt::format("the name '{}' is for dimension {}", group, dim), mesh.source,
                    "give a dimension from 0 to 3");
  }
  const auto known =
      std::find_if(mesh.physical_names.begin(), mesh.physical_names.end(),
                   [&](const PhysicalName& n) { return n.dim == dim && n.name == group; });
  int number = known == mesh.physical_names.end() ? 0 : known->tag;
  if (number == 0) {
    number = static_cast<int>(mesh.physical_names.size()) + 1;
    mesh.physical_names.push_back({dim, number, group});
  }
  mesh.entities.push_back({EntityKey{dim, tag}, group, {number}, Box{}});
}

py::dict names_of(const MeshData& mesh) {
  py::dict names;
  for (const EntityRecord& entity : mesh.entities) {
    if (entity.name.empty()) continue;
    names[py::make_tuple(entity.key.dim, entity.key.tag)] = entity.name;
  }
  return names;
}

py::array point_entities(const MeshData& mesh, py::handle owner) {
  static_assert(sizeof(EntityKey) == 2 * sizeof(int));
  return view_of(reinterpret_cast<const int*>(mesh.point_entity.data()),
                 {static_cast<py::ssize_t>(mesh.point_entity.size()), 2}, owner, false);
}

py::dict block_of(const ElementBlock& block, py::handle owner) {
  py::dict entry;
  entry["shape"] = std::string(name(block.shape));
  entry["order"] = block.order;
  entry["entity"] = block.entity;
  entry["nodes"] =
      view_of(block.nodes.data(),
              {static_cast<py::ssize_t>(block.size()), nodes_per_element(block.shape, block.order)},
              owner, false);
  entry["tags"] = view_of(block.tags, owner);
  return entry;
}

void write(const MeshData& mesh, const std::string& path, bool is_ascii, bool expect_certified) {
  io::WriteOptions options;
  options.binary = !is_ascii;
  io::check_writable(path, options);
  io::write_mesh(mesh, path, options, [&](const MeshData& read_back) {
    verify_written(mesh, read_back, expect_certified);
  });
}

}  // namespace

void bind_mesh(py::module_& module) {
  using NoGil = py::call_guard<py::gil_scoped_release>;
  py::class_<MeshData, Shared>(module, "MeshData")
      .def(py::init(&make_mesh), py::arg("points"), py::arg("source"))
      .def("add_block", &add_block, py::arg("shape"), py::arg("order"), py::arg("entity"),
           py::arg("nodes"), py::arg("node_order"))
      .def("set_point_entities", &set_point_entities, py::arg("keys"))
      .def("add_name", &add_name, py::arg("dim"), py::arg("tag"), py::arg("name"))
      .def_readonly("source", &MeshData::source)
      .def_property_readonly("names", &names_of)
      .def_property_readonly("points",
                             [](const py::object& self) {
                               auto& mesh = self.cast<MeshData&>();
                               return view_of(mesh.points.data(), mesh.points.size(), self, true);
                             })
      .def_property_readonly(
          "point_entity",
          [](const py::object& self) { return point_entities(self.cast<const MeshData&>(), self); })
      .def_property_readonly("blocks",
                             [](const py::object& self) {
                               py::list blocks;
                               for (const ElementBlock& block : self.cast<MeshData&>().blocks) {
                                 blocks.append(block_of(block, self));
                               }
                               return blocks;
                             })
      .def_property_readonly("fields",
                             [](const py::object& self) {
                               py::dict fields;
                               for (const Field& field : self.cast<MeshData&>().element_fields) {
                                 fields[py::str(field.name)] = view_of(field.values, self);
                               }
                               return fields;
                             })
      .def("write", &write, NoGil(), py::arg("path"), py::arg("ascii"),
           py::arg("expect_certified"));
  module.def(
      "read_mesh",
      [](const std::string& path) { return std::make_shared<MeshData>(io::read_mesh(path)); },
      NoGil(), py::arg("path"));
  module.def(
      "canonical_places",
      [](const std::string& shape, int order, const std::string& convention) {
        return canonical_places(shape_of(shape), order, convention);
      },
      py::arg("shape"), py::arg("order"), py::arg("node_order"));
}

}  // namespace camber::python
