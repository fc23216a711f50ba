#include <camber/base/error.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/gmsh/classification.hpp>
#include <camber/io/gmsh/node_numbers.hpp>
#include <camber/io/gmsh/write_plan.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace camber::io::gmsh {
namespace {

/// Classification of every node: as given, else the lowest entity of its elements, else the first
/// entity of the highest dimension.
std::vector<EntityKey> classify(const MeshData& mesh) {
  std::vector<EntityKey> lowest = lowest_entities(mesh);
  EntityKey fallback{3, 1};
  int highest = -1;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) <= highest) continue;
    highest = dimension(block.shape);
    fallback = {highest, block.entity};
  }
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    if (!mesh.point_entity.empty() && mesh.point_entity[i].dim >= 0) {
      lowest[i] = mesh.point_entity[i];
    } else if (lowest[i].dim < 0) {
      lowest[i] = fallback;
    }
  }
  return lowest;
}

std::vector<EntityRecord> list_entities(const MeshData& mesh,
                                        const std::vector<EntityKey>& of_point) {
  std::map<EntityKey, EntityRecord> records;
  for (const EntityRecord& e : mesh.entities) records.try_emplace(e.key, e);
  // Boxes that are not stated are taken from the nodes.
  std::map<EntityKey, Box> boxes;
  // Neighbours in a list mostly have one entity: it is looked up once a run.
  const EntityKey* last = nullptr;
  Box* grown = nullptr;  // null where the box is stated
  const auto grow = [&](const EntityKey& key, std::span<const Index> points) {
    if (!last || key != *last) {
      EntityRecord& record = records[key];
      record.key = key;
      last = &record.key;
      grown = record.box.is_empty() ? &boxes[key] : nullptr;
    }
    if (!grown) return;
    for (const Index i : points) grown->add(mesh.points[at(i)]);
  };
  for (const ElementBlock& b : mesh.blocks) {
    if (!b.nodes.empty()) grow({dimension(b.shape), b.entity}, b.nodes);
  }
  for (Index i = 0; at(i) < of_point.size(); ++i) grow(of_point[at(i)], {&i, 1});
  std::vector<EntityRecord> sorted;
  for (auto& [key, record] : records) {
    if (record.box.is_empty()) {
      const auto box = boxes.find(key);
      record.box = box != boxes.end() ? box->second : Box{Vec3::Zero(), Vec3::Zero()};
    }
    sorted.push_back(std::move(record));
  }
  return sorted;
}

void sort_nodes(const MeshData& mesh, const std::vector<EntityKey>& of_point, WritePlan& plan) {
  const auto parametric = [&](Index i) {
    const int dim = of_point[at(i)].dim;
    return !mesh.point_parameters.empty() && (dim == 1 || dim == 2) &&
           mesh.point_parameters[at(i)].allFinite();
  };
  plan.point_order.resize(mesh.points.size());
  std::iota(plan.point_order.begin(), plan.point_order.end(), Index{0});
  std::stable_sort(plan.point_order.begin(), plan.point_order.end(), [&](Index a, Index b) {
    if (of_point[at(a)] != of_point[at(b)]) return of_point[at(a)] < of_point[at(b)];
    return parametric(a) < parametric(b);
  });
  for (std::size_t k = 0; k < plan.point_order.size(); ++k) {
    const Index i = plan.point_order[k];
    const bool with = parametric(i);
    if (plan.node_blocks.empty() || plan.node_blocks.back().entity != of_point[at(i)] ||
        plan.node_blocks.back().parametric != with) {
      plan.node_blocks.push_back({of_point[at(i)], with, k, k});
    }
    plan.node_blocks.back().end = k + 1;
  }
}

void number(const MeshData& mesh, const std::string& display, WritePlan& plan) {
  plan.point_tags = mesh.point_tags;
  if (plan.point_tags.empty()) {
    plan.point_tags.resize(mesh.points.size());
    std::iota(plan.point_tags.begin(), plan.point_tags.end(), GlobalId{1});
  }
  for (const GlobalId tag : plan.point_tags) {
    if (tag < 1) throw std::invalid_argument("node numbers of 1 or more expected");
  }
  if (const auto twin = NodeNumbers(plan.point_tags).duplicate()) {
    throw FileError(fmt::format("node number {} occurs twice", plan.point_tags[at(*twin)]), display,
                    "");
  }
  GlobalId last = 0;
  for (const ElementBlock& b : mesh.blocks) {
    for (const GlobalId tag : b.tags) {
      if (tag < 1) throw std::invalid_argument("element numbers of 1 or more expected");
      last = std::max(last, tag);
    }
  }
  for (const ElementBlock& b : mesh.blocks) {
    std::vector<GlobalId> tags = b.tags;
    for (std::size_t e = tags.size(); e < b.size(); ++e) tags.push_back(++last);
    plan.element_tags.push_back(std::move(tags));
  }
}

}  // namespace

WritePlan plan_write(const MeshData& mesh, const std::string& display) {
  check_mesh(mesh, display);
  WritePlan plan;
  const std::vector<EntityKey> of_point = classify(mesh);
  plan.entities = list_entities(mesh, of_point);
  sort_nodes(mesh, of_point, plan);
  number(mesh, display, plan);
  return plan;
}

}  // namespace camber::io::gmsh
