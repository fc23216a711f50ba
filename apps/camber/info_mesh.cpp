#include <camber/pipeline/text_table.hpp>

#include <array>
#include <map>

#include <fmt/format.h>

#include "info.hpp"

namespace camber::app {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::array<const char*, 4> k_kind{"point", "curve", "surface", "volume"};

struct EntityContent {
  std::map<Shape, std::map<int, std::size_t>> counts;
  Box box;
};

std::map<EntityKey, EntityContent> contents(const MeshData& mesh) {
  std::map<EntityKey, EntityContent> entities;
  for (const ElementBlock& block : mesh.blocks) {
    EntityContent& content = entities[{dimension(block.shape), block.entity}];
    content.counts[block.shape][block.order] += block.size();
    for (Index node : block.nodes) content.box.add(mesh.points[at(node)]);
  }
  return entities;
}

std::string name_of(const MeshData& mesh, EntityKey key) {
  for (const EntityRecord& record : mesh.entities) {
    if (record.key == key) return record.name;
  }
  return "";
}

std::string text(const std::map<Shape, std::map<int, std::size_t>>& counts) {
  std::string out;
  for (const auto& [shape, by_order] : counts) {
    for (const auto& [order, count] : by_order) {
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, name(shape));
      if (shape != Shape::point) out += fmt::format(" Q{}", order);
    }
  }
  return out;
}

Json json_of(const std::map<Shape, std::map<int, std::size_t>>& counts) {
  Json json = Json::object();
  for (const auto& [shape, by_order] : counts) {
    for (const auto& [order, count] : by_order) {
      json[std::string(name(shape))][std::to_string(order)] = count;
    }
  }
  return json;
}

}  // namespace

Info mesh_info(const std::string& path, const io::ReadOptions& options) {
  const MeshData mesh = io::read_mesh(path, options);
  const std::map<EntityKey, EntityContent> entities = contents(mesh);
  std::map<Shape, std::map<int, std::size_t>> total;
  Box box;
  for (const auto& [key, content] : entities) {
    box.add(content.box);
    for (const auto& [shape, by_order] : content.counts) {
      for (const auto& [order, count] : by_order) total[shape][order] += count;
    }
  }
  Info info;
  info.text = fmt::format("mesh {}\n  {} nodes, {} elements: {}\n  box {}\n", path,
                          mesh.points.size(), mesh.element_count(), text(total), box_text(box));
  Json list = Json::array();
  TextTable table;
  table.add({"entity", "group", "elements", "box (mesh units)"});
  for (int dim = 3; dim >= 0; --dim) {
    for (const auto& [key, content] : entities) {
      if (key.dim != dim) continue;
      const char* kind = k_kind[static_cast<std::size_t>(dim)];
      const std::string group = name_of(mesh, key);
      if (dim >= 2) {
        table.add({fmt::format("{} {}", kind, key.tag), group.empty() ? "-" : group,
                   text(content.counts), box_text(content.box)});
      }
      list.push_back({{"kind", kind},
                      {"tag", key.tag},
                      {"name", group},
                      {"elements", json_of(content.counts)},
                      {"box", box_json(content.box)}});
    }
  }
  info.text += table.text();
  info.json["mesh"] = {{"path", path},
                       {"nodes", mesh.points.size()},
                       {"elements", json_of(total)},
                       {"box", box_json(box)},
                       {"entities", list}};
  return info;
}

}  // namespace camber::app
