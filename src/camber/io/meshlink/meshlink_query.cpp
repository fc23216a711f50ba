#include <camber/io/meshlink/meshlink.hpp>

#include <algorithm>

namespace camber::io {
namespace {

/// Sorted nodes; triangles get a 0 in front, which is no node number.
std::array<GlobalId, 4> face_key(std::span<const GlobalId> nodes) {
  std::array<GlobalId, 4> key{0, 0, 0, 0};
  std::copy(nodes.begin(), nodes.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::array<GlobalId, 2> edge_key(GlobalId a, GlobalId b) {
  return {std::min(a, b), std::max(a, b)};
}

template <class Map, class Key>
int find(const Map& map, const Key& key) {
  const auto found = map.find(key);
  return found == map.end() ? 0 : found->second;
}

/// Calls visit(geometry, nodes) for each element of the parts that names its nodes.
template <class Visit>
void for_each(const std::vector<MeshLink::Part>& parts, const Visit& visit) {
  for (const MeshLink::Part& part : parts) {
    for (const MeshLink::Elements& list : part.elements) {
      if (list.is_opaque) continue;
      const int geometry = list.geometry != 0 ? list.geometry : part.geometry;
      const std::size_t n = static_cast<std::size_t>(list.corners);
      for (std::size_t i = 0; i + n <= list.numbers.size(); i += n) {
        visit(geometry, std::span(list.numbers).subspan(i, n));
      }
    }
  }
}

}  // namespace

MeshLinkQuery::MeshLinkQuery(const MeshLink::Model& model) {
  for_each(model.strings, [&](int geometry, std::span<const GlobalId> nodes) {
    string_edges_.emplace(edge_key(nodes[0], nodes[1]), geometry);
    for (GlobalId node : nodes) points_.emplace(node, geometry);
  });
  for_each(model.sheets, [&](int geometry, std::span<const GlobalId> nodes) {
    faces_.emplace(face_key(nodes), geometry);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sheet_edges_.emplace(edge_key(nodes[i], nodes[(i + 1) % nodes.size()]), geometry);
      points_.emplace(nodes[i], geometry);
    }
  });
  for (const MeshLink::Elements& list : model.points) {
    for (GlobalId node : list.numbers) points_.emplace(node, list.geometry);
  }
}

int MeshLinkQuery::face(std::span<const GlobalId> nodes) const {
  return nodes.size() == 3 || nodes.size() == 4 ? find(faces_, face_key(nodes)) : 0;
}

int MeshLinkQuery::string_edge(GlobalId a, GlobalId b) const {
  return find(string_edges_, edge_key(a, b));
}

int MeshLinkQuery::edge(GlobalId a, GlobalId b) const {
  const auto key = edge_key(a, b);
  return string_edges_.contains(key) ? find(string_edges_, key) : find(sheet_edges_, key);
}

int MeshLinkQuery::point(GlobalId node) const { return find(points_, node); }

}  // namespace camber::io
