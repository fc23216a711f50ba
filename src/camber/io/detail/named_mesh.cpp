#include <camber/base/error.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/gmsh/classification.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace camber::io {
namespace {

std::string name_of(const MeshData& mesh, EntityKey key) {
  for (const EntityRecord& record : mesh.entities) {
    if (record.key == key && !record.name.empty()) return record.name;
  }
  return fmt::format("{}_{}", key.dim == 3 ? "volume" : "surface", key.tag);
}

using BlockKey = std::tuple<int, std::string, Shape, int>;

std::map<BlockKey, const ElementBlock*> blocks_by_name(const MeshData& mesh) {
  std::map<EntityKey, std::string> names;
  for (const EntityRecord& record : mesh.entities) names[record.key] = record.name;
  std::map<BlockKey, const ElementBlock*> blocks;
  for (const ElementBlock& b : mesh.blocks) {
    const int dim = dimension(b.shape);
    if (dim >= 2) blocks[{dim, names[{dim, b.entity}], b.shape, b.order}] = &b;
  }
  return blocks;
}

}  // namespace

int NamedMeshBuilder::entity(int dim, const std::string& name) {
  const auto known = entity_.find({dim, name});
  return known != entity_.end() ? known->second : entity(dim, name, last_entity_[dim] + 1);
}

int NamedMeshBuilder::entity(int dim, const std::string& name, int tag) {
  const auto [place, is_new] = entity_.try_emplace({dim, name}, tag);
  if (!is_new) return place->second;
  if (entity_.size() > k_most_entities) {
    throw FileError(fmt::format("more than {} different patches and volumes", k_most_entities),
                    mesh_.source, "a number for each element is no patch: leave it out");
  }
  last_entity_[dim] = std::max(last_entity_[dim], tag);
  record_[{dim, tag}] = mesh_.entities.size();
  EntityRecord record;
  record.key = {dim, tag};
  record.name = name;
  mesh_.entities.push_back(record);
  add_to_group(dim, tag, name);
  return tag;
}

void NamedMeshBuilder::add_to_group(int dim, int entity, const std::string& group) {
  const auto [place, is_new] = group_.try_emplace({dim, group}, 0);
  if (is_new) {
    place->second = ++last_group_[dim];
    mesh_.physical_names.push_back({dim, place->second, group});
  }
  const auto record = record_.find({dim, entity});
  if (record == record_.end()) return;
  std::vector<int>& tags = mesh_.entities[record->second].physical_tags;
  if (std::find(tags.begin(), tags.end(), place->second) == tags.end()) {
    tags.push_back(place->second);
  }
}

void NamedMeshBuilder::add(Shape shape, int order, int entity, std::span<const Index> nodes) {
  const auto [place, is_new] =
      block_.try_emplace({dimension(shape), entity, shape, order}, mesh_.blocks.size());
  if (is_new) {
    ElementBlock& block = mesh_.blocks.emplace_back();
    block.shape = shape;
    block.order = order;
    block.entity = entity;
  }
  std::vector<Index>& all = mesh_.blocks[place->second].nodes;
  all.insert(all.end(), nodes.begin(), nodes.end());
}

MeshData NamedMeshBuilder::finish() {
  mesh_.point_entity = gmsh::lowest_entities(mesh_);
  std::map<EntityKey, Box> boxes;
  for (const ElementBlock& block : mesh_.blocks) {
    Box& box = boxes[{dimension(block.shape), block.entity}];
    for (const Index n : block.nodes) box.add(mesh_.points[at(n)]);
  }
  std::erase_if(mesh_.entities, [&](const EntityRecord& e) { return !boxes.contains(e.key); });
  for (EntityRecord& record : mesh_.entities) record.box = boxes[record.key];
  return std::move(mesh_);
}

std::string unique_name(const std::string& name, const NameRules& rules,
                        std::vector<std::string>& used) {
  std::string clean = name.substr(0, rules.longest);
  for (char& c : clean) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' || c == '\x7f';
    if (is_control || rules.forbidden.find(c) != std::string_view::npos) c = '_';
  }
  if (clean.empty()) clean.push_back('_');
  std::string candidate = clean;
  for (int n = 2; std::find(used.begin(), used.end(), candidate) != used.end(); ++n) {
    const std::string suffix = fmt::format("_{}", n);
    candidate = clean.substr(0, rules.longest - suffix.size()) + suffix;
  }
  used.push_back(candidate);
  return candidate;
}

NamedMesh by_names(const MeshData& mesh, const NameRules& rules) {
  // Entities of each dimension by name, in the order of their tags.
  std::map<EntityKey, std::string> names;
  for (const ElementBlock& b : mesh.blocks) {
    const EntityKey key{dimension(b.shape), b.entity};
    if (key.dim == 3 && !rules.keeps_volumes)
      names[key] = "volume";
    else if (key.dim >= 2)
      names.try_emplace(key, name_of(mesh, key));
  }
  NamedMesh named;
  std::map<std::pair<int, std::string>, int> tag_of;
  std::map<int, int> last;
  std::array<std::vector<std::string>, 4> used;
  for (const auto& [key, name] : names) {
    const auto [place, is_new] = tag_of.try_emplace({key.dim, name}, 0);
    if (is_new) {
      place->second = ++last[key.dim];
      EntityRecord record;
      record.key = {key.dim, place->second};
      record.name = unique_name(name, rules, used[static_cast<std::size_t>(key.dim)]);
      named.mesh.entities.push_back(record);
    }
    named.source_tags[{key.dim, place->second}].push_back(key.tag);
  }
  // Blocks in the order: volumes first, then tag, shape and order.
  std::map<std::tuple<int, int, Shape, int>, std::vector<std::size_t>> parts;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const int dim = dimension(block.shape);
    if (dim < 2 || block.nodes.empty()) continue;
    const int tag = tag_of.at({dim, names.at({dim, block.entity})});
    parts[{-dim, tag, block.shape, block.order}].push_back(b);
  }
  named.mesh.source = mesh.source;
  named.mesh.points = mesh.points;
  for (const auto& [key, sources] : parts) {
    const auto& [minus_dim, tag, shape, order] = key;
    ElementBlock joined;
    joined.shape = shape;
    joined.order = order;
    joined.entity = tag;
    std::vector<std::pair<std::size_t, std::size_t>>& origin = named.origin.emplace_back();
    for (const std::size_t b : sources) {
      const ElementBlock& block = mesh.blocks[b];
      joined.nodes.insert(joined.nodes.end(), block.nodes.begin(), block.nodes.end());
      for (std::size_t e = 0; e < block.size(); ++e) origin.emplace_back(b, e);
    }
    named.mesh.blocks.push_back(std::move(joined));
  }
  return named;
}

MeshData relabel(const MeshData& source, const NamedMesh& named, const MeshData& read) {
  const auto differs = [&](const std::string& what) {
    throw FileError("what was written differs from the mesh: " + what, read.source,
                    "check the disk");
  };
  if (read.points.size() != source.points.size()) differs("other number of nodes");
  const std::map<BlockKey, const ElementBlock*> wanted = blocks_by_name(named.mesh),
                                                found = blocks_by_name(read);
  if (wanted.size() != found.size()) differs("other kinds of elements");
  MeshData result = source;
  result.source = read.source;
  result.points = read.points;
  for (const auto& [key, block] : wanted) {
    const auto twin = found.find(key);
    if (twin == found.end() || twin->second->nodes.size() != block->nodes.size()) {
      differs(fmt::format("other number of {} elements of order {} of '{}'", name(block->shape),
                          block->order, std::get<1>(key)));
    }
    const auto b = static_cast<std::size_t>(block - named.mesh.blocks.data());
    const auto per = static_cast<std::size_t>(nodes_per_element(block->shape, block->order));
    for (std::size_t e = 0; e < named.origin[b].size(); ++e) {
      const auto [to, place] = named.origin[b][e];
      std::copy_n(twin->second->nodes.begin() + static_cast<std::ptrdiff_t>(e * per), per,
                  result.blocks[to].nodes.begin() + static_cast<std::ptrdiff_t>(place * per));
    }
  }
  return result;
}

}  // namespace camber::io
