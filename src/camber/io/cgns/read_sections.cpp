// Elements of an unstructured zone.
#include <camber/base/error.hpp>
#include <camber/basis/node_order.hpp>
#include <camber/io/cgns/detail/zone_reader.hpp>

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

namespace camber::io::cgns {
namespace {

/// Which condition a surface element belongs to.
class Patches {
 public:
  Patches(const File& file, int base, const Zone& zone)
      : conditions_(read_conditions(file, base, zone.number, 1)), first_(zone.first_point) {
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      const Condition& condition = conditions_[c];
      const std::vector<cgsize_t>& p = condition.points;
      if (condition.is_vertex) {
        std::vector<cgsize_t> nodes = p;
        if (condition.is_range) {
          nodes.clear();
          const cgsize_t last =
              std::min(std::max(p[0], p[1]), static_cast<cgsize_t>(zone.point_count));
          for (cgsize_t i = std::max<cgsize_t>(1, std::min(p[0], p[1])); i <= last; ++i) {
            nodes.push_back(i);
          }
        }
        std::sort(nodes.begin(), nodes.end());
        vertices_.emplace_back(c, std::move(nodes));
      } else if (condition.is_range) {
        ranges_.push_back({std::min(p[0], p[1]), std::max(p[0], p[1]), c});
      } else {
        for (const cgsize_t element : p) by_element_.try_emplace(element, c);
      }
    }
  }

  /// nullptr if no condition names the element.
  [[nodiscard]] const Condition* find(cgsize_t element, std::span<const Index> nodes) const {
    std::size_t best = conditions_.size();
    const auto listed = by_element_.find(element);
    if (listed != by_element_.end()) best = listed->second;
    for (const Range& r : ranges_) {
      if (r.first <= element && element <= r.last) best = std::min(best, r.condition);
    }
    if (best == conditions_.size()) {
      for (const auto& condition : vertices_) {
        const auto& set = condition.second;  // by name: clang 14 captures no structured bindings
        const bool has_all = std::all_of(nodes.begin(), nodes.end(), [&](Index n) {
          return std::binary_search(set.begin(), set.end(), static_cast<cgsize_t>(n - first_ + 1));
        });
        if (has_all) return &conditions_[condition.first];
      }
      return nullptr;
    }
    return &conditions_[best];
  }

 private:
  struct Range {
    cgsize_t first, last;
    std::size_t condition;
  };
  std::vector<Condition> conditions_;
  Index first_;
  std::vector<Range> ranges_;
  std::unordered_map<cgsize_t, std::size_t> by_element_;
  std::vector<std::pair<std::size_t, std::vector<cgsize_t>>> vertices_;
};

struct Section {
  std::string name, region;
  cgsize_t first = 0;
};

class SectionReader {
 public:
  SectionReader(const File& file, int base, const Zone& zone, NamedMeshBuilder& builder)
      : file_(file), base_(base), zone_(zone), builder_(builder), patches_(file, base, zone) {}

  void read_all() {
    int sections = 0;
    file_.require(cg_nsections(file_.number(), base_, zone_.number, &sections), "cannot be read");
    for (int s = 1; s <= sections; ++s) read(s);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw FileError(
        what,
        fmt::format("{}, zone '{}', section '{}'", file_.display(), zone_.name, section_.name),
        remedy);
  }

  void read(int number) {
    char name[k_name_room] = {};
    auto type = CGNS_ENUMV(ElementTypeNull);
    cgsize_t first = 0, last = 0;
    int boundary = 0, parents = 0;
    file_.require(cg_section_read(file_.number(), base_, zone_.number, number, name, &type, &first,
                                  &last, &boundary, &parents),
                  "a section cannot be read");
    section_ = {name, region_of(number), first};
    if (type == CGNS_ENUMV(NGON_n) || type == CGNS_ENUMV(NFACE_n)) {
      refuse("the cells are polyhedra (NGON_n, NFACE_n), expected tets, pyramids, prisms and hexes",
             "export the mesh with standard elements (in Pointwise, STAR-CCM+ and Fluent an option "
             "of the export)");
    }
    cgsize_t size = 0;
    file_.require(cg_ElementDataSize(file_.number(), base_, zone_.number, number, &size),
                  "a section cannot be read");
    if (first < 1 || last < first || size < 1)
      refuse("has no sensible range of elements", k_damaged);
    const cgsize_t count = last - first + 1;
    if (type == CGNS_ENUMV(MIXED)) {
      read_mixed(number, count, size);
      return;
    }
    const ElementType known = known_type(type);
    const auto per = static_cast<cgsize_t>(nodes_of(known));
    if (size / per < count) refuse("has fewer nodes than its elements need", k_damaged);
    std::vector<cgsize_t> nodes(static_cast<std::size_t>(size));
    file_.require(
        cg_elements_read(file_.number(), base_, zone_.number, number, nodes.data(), nullptr),
        "a section cannot be read");
    for (cgsize_t e = 0; e < count; ++e) add(known, first + e, nodes.data() + e * per);
  }

  void read_mixed(int number, cgsize_t count, cgsize_t size) {
    std::vector<cgsize_t> data(static_cast<std::size_t>(size));
    std::vector<cgsize_t> offsets(static_cast<std::size_t>(count) + 1);
    file_.require(cg_poly_elements_read(file_.number(), base_, zone_.number, number, data.data(),
                                        offsets.data(), nullptr),
                  "a section cannot be read");
    std::size_t at_entry = 0;
    for (cgsize_t e = 0; e < count; ++e) {
      if (at_entry >= data.size()) refuse("ends inside its elements", k_damaged);
      const ElementType type = known_type(static_cast<CGNS_ENUMT(ElementType_t)>(data[at_entry]));
      const std::size_t per = nodes_of(type);
      if (data.size() - at_entry <= per) refuse("ends inside its elements", k_damaged);
      add(type, section_.first + e, data.data() + at_entry + 1);
      at_entry += per + 1;
    }
  }

  static std::size_t nodes_of(const ElementType& type) {
    return type.shape == Shape::point
               ? 1
               : static_cast<std::size_t>(node_count(type.shape, type.order));
  }

  [[nodiscard]] ElementType known_type(CGNS_ENUMT(ElementType_t) type) const {
    if (type == CGNS_ENUMV(NODE)) return {Shape::point, 1};
    if (const auto known = element_type(type)) return *known;
    const bool has_name = type > 0 && type < NofValidElementTypes;
    refuse(
        fmt::format("has elements of type {}, which Camber does not take",
                    has_name ? cg_ElementTypeName(type) : std::to_string(static_cast<int>(type))),
        "export linear or complete Lagrange elements (with nodes inside faces and cells)");
  }

  void add(const ElementType& type, cgsize_t element, const cgsize_t* nodes) {
    if (type.shape == Shape::point) return;
    const std::span<const int> order =
        file_to_canonical(NodeConvention::cgns, type.shape, type.order);
    canonical_.resize(order.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
      if (nodes[n] < 1 || nodes[n] > zone_.point_count) {
        refuse(fmt::format("element {} has node {}, expected 1 to {}", element, nodes[n],
                           zone_.point_count),
               k_damaged);
      }
      canonical_[static_cast<std::size_t>(order[n])] =
          zone_.first_point + static_cast<Index>(nodes[n]) - 1;
    }
    builder_.add(type.shape, type.order, entity_of(type, element), canonical_);
  }

  int entity_of(const ElementType& type, cgsize_t element) {
    const int dim = dimension(type.shape);
    if (dim == 3) return builder_.entity(3, section_.region);
    const Condition* condition = dim == 2 ? patches_.find(element, canonical_) : nullptr;
    if (!condition) return builder_.entity(dim, section_.name);
    const int entity = builder_.entity(2, condition->name);
    if (!condition->family.empty() && condition->family != condition->name) {
      builder_.add_to_group(2, entity, condition->family);
    }
    return entity;
  }

  std::string region_of(int section) const {
    if (cg_goto(file_.number(), base_, "Zone_t", zone_.number, "Elements_t", section, "end") !=
        CG_OK) {
      return zone_.name;
    }
    int descriptors = 0;
    if (cg_ndescriptors(&descriptors) != CG_OK) return zone_.name;
    for (int d = 1; d <= descriptors; ++d) {
      char name[k_name_room] = {};
      char* text = nullptr;
      if (cg_descriptor_read(d, name, &text) != CG_OK) continue;
      const std::string value = text ? text : "";
      cg_free(text);
      if (std::string(name) == "Region" && !value.empty()) return value;
    }
    return zone_.name;
  }

  static constexpr const char* k_damaged = "the file is damaged: save it again";
  const File& file_;
  int base_;
  const Zone& zone_;
  NamedMeshBuilder& builder_;
  Patches patches_;
  Section section_;
  std::vector<Index> canonical_;
};

}  // namespace

void read_sections(const File& file, int base, const Zone& zone, NamedMeshBuilder& builder) {
  SectionReader(file, base, zone, builder).read_all();
}

}  // namespace camber::io::cgns
