#include <camber/base/error.hpp>
#include <camber/io/base64.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/meshlink/meshlink.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace camber::io {
namespace {

constexpr std::string_view k_space = " \t\r\n";

/// Name without its namespace prefix.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Ids that were given and those that were asked for, with where.
struct Ids {
  std::set<int> known;
  std::vector<std::pair<int, std::ptrdiff_t>> wanted;
};

class Reader {
 public:
  Reader(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  MeshLink run() {
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(text_.data(), text_.size(), pugi::parse_default);
    if (!result) {
      fail(fmt::format("no well-formed XML: {}", result.description()), result.offset);
    }
    const pugi::xml_node root = document.document_element();
    if (local_name(root) != "MeshLink") {
      fail(fmt::format("the file starts with <{}>, not with <MeshLink>", root.name()),
           root.offset_debug());
    }
    for (const pugi::xml_node& node : root.children()) {
      if (node.type() == pugi::node_element) read_top(node);
    }
    check(attribute_ids_, "attribute (aref)");
    check(geometry_ids_, "geometry (gref)");
    check(transform_ids_, "transform (xref)");
    return std::move(link_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, std::ptrdiff_t offset) const {
    const std::size_t end =
        std::min(text_.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw FileError(what, fmt::format("{}, line {}", path_, line),
                    "the file must be MeshLink XML, version 1");
  }

  [[nodiscard]] std::string text(const pugi::xml_node& node, const char* attribute) const {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) {
      fail(fmt::format("<{}> has no {}", node.name(), attribute), node.offset_debug());
    }
    return found.value();
  }

  template <class T>
  T number(std::string_view word, const pugi::xml_node& node) const {
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) {
      fail(fmt::format("'{}' in <{}> is no number that fits", word.substr(0, 40), node.name()),
           node.offset_debug());
    }
    return value;
  }

  /// Positive whole number of an attribute; 0 if it is absent.
  [[nodiscard]] int id(const pugi::xml_node& node, const char* attribute) const {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) return 0;
    const int value = number<int>(trimmed(found.value()), node);
    if (value < 1) {
      fail(fmt::format("{}=\"{}\" in <{}> must be 1 or more", attribute, value, node.name()),
           node.offset_debug());
    }
    return value;
  }

  int give(const pugi::xml_node& node, const char* attribute, Ids& ids) {
    const int value = id(node, attribute);
    if (value == 0) {
      fail(fmt::format("<{}> has no {}", node.name(), attribute), node.offset_debug());
    }
    if (!ids.known.insert(value).second) {
      fail(fmt::format("{}=\"{}\" is given twice", attribute, value), node.offset_debug());
    }
    return value;
  }

  int ask(const pugi::xml_node& node, const char* attribute, Ids& ids) {
    const int value = id(node, attribute);
    if (value != 0) ids.wanted.emplace_back(value, node.offset_debug());
    return value;
  }

  void check(const Ids& ids, const char* kind) const {
    for (const auto& [value, offset] : ids.wanted) {
      if (!ids.known.contains(value)) {
        fail(fmt::format("there is no {} with id {}", kind, value), offset);
      }
    }
  }

  static std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(k_space);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(k_space) - begin + 1);
  }

  /// All text of a node: comments may cut it into pieces.
  static std::string content(const pugi::xml_node& node) {
    std::string all;
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        all += child.value();
        all += ' ';
      }
    }
    return all;
  }

  template <class T>
  std::vector<T> numbers(const pugi::xml_node& node) const {
    std::vector<T> values;
    const std::string all = content(node);
    const std::string_view rest = all;
    std::size_t begin = rest.find_first_not_of(k_space);
    while (begin != std::string_view::npos) {
      const std::size_t end = std::min(rest.find_first_of(k_space, begin), rest.size());
      values.push_back(number<T>(rest.substr(begin, end - begin), node));
      begin = rest.find_first_not_of(k_space, end);
    }
    return values;
  }

  void read_top(const pugi::xml_node& node) {
    const std::string_view name = local_name(node);
    if (name == "Attribute") {
      const int own = give(node, "attid", attribute_ids_);
      link_.attributes.push_back({own, node.attribute("name").value(), node.child_value()});
    } else if (name == "AttributeGroup") {
      link_.attribute_groups.push_back(group(node, "attid", attribute_ids_));
    } else if (name == "GeometryFile") {
      read_geometry(node);
    } else if (name == "GeometryGroup") {
      link_.geometry_groups.push_back(group(node, "gid", geometry_ids_));
    } else if (name == "MeshFile") {
      MeshLink::MeshFile file{text(node, "filename"), ask(node, "aref", attribute_ids_), {}};
      for (const pugi::xml_node& child : node.children()) {
        if (child.type() == pugi::node_element) file.models.push_back(model(child));
      }
      link_.meshes.push_back(std::move(file));
    } else if (name == "Transform") {
      MeshLink::Transform transform{give(node, "xid", transform_ids_),
                                    node.attribute("name").value(),
                                    ask(node, "aref", attribute_ids_),
                                    {}};
      const std::vector<double> values = numbers<double>(node);
      if (values.size() != transform.matrix.size() ||
          !std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) {
        fail(fmt::format("<Transform> needs 16 finite numbers, found {}", values.size()),
             node.offset_debug());
      }
      std::copy(values.begin(), values.end(), transform.matrix.begin());
      link_.transforms.push_back(std::move(transform));
    } else if (name == "MeshElementLinkage") {
      link_.linkages.push_back({text(node, "sourceEntityRef"), text(node, "targetEntityRef"),
                                node.attribute("name").value(), ask(node, "xref", transform_ids_),
                                ask(node, "aref", attribute_ids_)});
    } else {
      unknown(node, "MeshLink");
    }
  }

  [[noreturn]] void unknown(const pugi::xml_node& node, const char* parent) const {
    fail(fmt::format("<{}> has no place in <{}>", node.name(), parent), node.offset_debug());
  }

  MeshLink::Group group(const pugi::xml_node& node, const char* attribute, Ids& ids) {
    MeshLink::Group result{give(node, attribute, ids), node.attribute("name").value(),
                           ask(node, "aref", attribute_ids_), numbers<int>(node)};
    for (int member : result.members) ids.wanted.emplace_back(member, node.offset_debug());
    return result;
  }

  void read_geometry(const pugi::xml_node& node) {
    MeshLink::GeometryFile file{text(node, "filename"), ask(node, "aref", attribute_ids_), {}};
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      if (local_name(child) != "GeometryReference") unknown(child, "GeometryFile");
      const std::string ref = text(child, "ref");
      const pugi::xml_attribute shown = child.attribute("name");
      file.references.push_back({give(child, "gid", geometry_ids_), ref,
                                 shown ? shown.value() : ref, ask(child, "aref", attribute_ids_)});
    }
    link_.geometry.push_back(std::move(file));
  }

  MeshLink::Model model(const pugi::xml_node& node) {
    if (local_name(node) != "MeshModelReference") unknown(node, "MeshFile");
    MeshLink::Model model;
    model.ref = text(node, "ref");
    model.name = node.attribute("name").value();
    model.geometry = ask(node, "gref", geometry_ids_);
    model.attributes = ask(node, "aref", attribute_ids_);
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const std::string_view name = local_name(child);
      if (name == "MeshSheet" || name == "MeshSheetReference") {
        model.sheets.push_back(part(child, "MeshFace"));
      } else if (name == "MeshString" || name == "MeshStringReference") {
        model.strings.push_back(part(child, "MeshEdge"));
      } else if (name == "MeshPointReference" || name == "MeshPoint") {
        model.points.push_back(elements(child, 1, false));
      } else if (name == "ParamVertex") {
        model.parameters.push_back(parameters(child));
      } else {
        unknown(child, "MeshModelReference");
      }
    }
    return model;
  }

  MeshLink::Part part(const pugi::xml_node& node, const std::string& element) {
    MeshLink::Part part;
    part.name = node.attribute("name").value();
    part.ref = node.attribute("ref").value();
    part.geometry = ask(node, "gref", geometry_ids_);
    part.attributes = ask(node, "aref", attribute_ids_);
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const std::string_view name = local_name(child);
      if (name == "ParamVertex") {
        part.parameters.push_back(parameters(child));
      } else if (name == element || name == element + "Reference") {
        part.elements.push_back(elements(child, corners(child, element), name != element));
      } else {
        unknown(child, node.name());
      }
    }
    return part;
  }

  [[nodiscard]] int corners(const pugi::xml_node& node, const std::string& element) const {
    const std::string type = text(node, "etype");
    if (element == "MeshFace" && type == "Tri3") return 3;
    if (element == "MeshFace" && type == "Quad4") return 4;
    if (element == "MeshEdge" && type == "Edge2") return 2;
    fail(fmt::format("<{}> has etype=\"{}\"; known are Tri3, Quad4 (faces) and Edge2 (edges)",
                     node.name(), type),
         node.offset_debug());
  }

  MeshLink::Elements elements(const pugi::xml_node& node, int corners, bool is_opaque) {
    MeshLink::Elements list;
    list.corners = corners;
    list.is_opaque = is_opaque;
    list.geometry = ask(node, "gref", geometry_ids_);
    list.name = node.attribute("name").value();
    list.attributes = ask(node, "aref", attribute_ids_);
    const std::string_view format = node.attribute("format").value();
    if (format == "base64") {
      const auto values = decode_base64(content(node));
      if (!values) {
        fail(fmt::format("the text of <{}> is no base64 of 32-bit integers", node.name()),
             node.offset_debug());
      }
      list.numbers.assign(values->begin(), values->end());
    } else if (format.empty() || format == "text") {
      list.numbers = numbers<GlobalId>(node);
    } else {
      fail(fmt::format("format=\"{}\" is unknown; known are text and base64", format),
           node.offset_debug());
    }
    const int count = node.attribute("count") ? id(node, "count") : 1;
    const std::size_t size = static_cast<std::size_t>(is_opaque ? 1 : corners);
    if (list.numbers.size() != size * static_cast<std::size_t>(count)) {
      fail(fmt::format("<{}> says {} elements of {} numbers and holds {} numbers", node.name(),
                       count, size, list.numbers.size()),
           node.offset_debug());
    }
    if (std::any_of(list.numbers.begin(), list.numbers.end(), [](GlobalId n) { return n < 1; })) {
      fail(fmt::format("<{}> holds a number below 1", node.name()), node.offset_debug());
    }
    return list;
  }

  MeshLink::ParamVertex parameters(const pugi::xml_node& node) {
    MeshLink::ParamVertex vertex;
    vertex.vertex = number<GlobalId>(trimmed(text(node, "vref")), node);
    vertex.geometry = ask(node, "gref", geometry_ids_);
    vertex.dimension = id(node, "dim");
    const std::vector<double> values = numbers<double>(node);
    if (vertex.dimension < 1 || vertex.dimension > 2 ||
        values.size() < static_cast<std::size_t>(vertex.dimension) || values.size() > 2) {
      fail(fmt::format("<{}> needs dim=\"1\" or \"2\" and as many numbers", node.name()),
           node.offset_debug());
    }
    vertex.u = values[0];
    if (vertex.dimension == 2) vertex.v = values[1];
    return vertex;
  }

  std::string path_;
  std::string_view text_;
  MeshLink link_;
  Ids attribute_ids_, geometry_ids_, transform_ids_;
};

}  // namespace

MeshLink read_meshlink(const std::string& path) {
  const InputFile file(path);
  return parse_meshlink(path, file.text());
}

MeshLink parse_meshlink(const std::string& path, std::string_view text) {
  return Reader(path, text).run();
}

}  // namespace camber::io
