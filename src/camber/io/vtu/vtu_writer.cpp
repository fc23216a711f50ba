#include <camber/io/base64.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/detail/xml_text.hpp>
#include <camber/io/vtu/vtu_cells.hpp>
#include <camber/io/vtu/vtu_writer.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

namespace camber::io {
namespace vtu {
namespace {

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  return "UInt8";
}

/// Control characters, which XML does not know, become spaces.
std::string escaped(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return xml_escaped(text);
}

/// Writes data arrays: in text where they stand, in binary collected behind the XML.
class Arrays {
 public:
  Arrays(OutputFile& out, bool binary) : out_(out), binary_(binary) {}

  /// @param data  must live until append_data()
  template <class T>
  void write(const std::string& name, std::span<const T> data, int components = 1) {
    out_.print("        <DataArray type=\"{}\" Name=\"{}\"", type_name<T>(), escaped(name));
    if (components > 1) out_.print(" NumberOfComponents=\"{}\"", components);
    const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size_bytes());
    if (binary_) {
      out_.print(" format=\"appended\" offset=\"{}\"/>\n", offset_);
      offset_ += sizeof(std::uint64_t) + bytes.size();
      pending_.push_back(bytes);
      return;
    }
    if (!is_readable_text(data)) {
      // VTK's text reader stops at "nan": such arrays go inline in base64.
      const std::uint64_t size = bytes.size();
      const std::string_view header(reinterpret_cast<const char*>(&size), sizeof(size));
      out_.append(" format=\"binary\">\n");
      out_.append(encode_base64(header));
      out_.append(encode_base64(bytes));
    } else {
      out_.append(" format=\"ascii\">\n");
      const auto width = components > 1 ? static_cast<std::size_t>(components) : k_per_line;
      for (std::size_t i = 0; i < data.size(); ++i) {
        out_.print("{}{}", +data[i], (i + 1) % width == 0 ? '\n' : ' ');
      }
    }
    out_.append("\n        </DataArray>\n");
  }

  void append_data() {
    if (!binary_) return;
    out_.append("  <AppendedData encoding=\"raw\">\n_");
    for (const std::string_view bytes : pending_) {
      out_.append_raw(static_cast<std::uint64_t>(bytes.size()));
      out_.append(bytes);
    }
    out_.append("\n  </AppendedData>\n");
  }

 private:
  static constexpr std::size_t k_per_line = 12;

  template <class T>
  static bool is_readable_text(std::span<const T> data) {
    if constexpr (std::is_floating_point_v<T>) {
      return std::all_of(data.begin(), data.end(), [](T v) { return std::isfinite(v); });
    }
    return true;
  }

  OutputFile& out_;
  bool binary_;
  std::uint64_t offset_ = 0;
  std::vector<std::string_view> pending_;
};

/// Data of the cells, from their blocks and elements.
struct CellData {
  std::vector<std::int32_t> dim, order, entity, group;
  std::vector<std::int64_t> element;
  std::vector<std::vector<double>> fields;
};

CellData make_cell_data(const MeshData& mesh, const Cells& cells) {
  std::map<EntityKey, int> groups;
  for (const EntityRecord& e : mesh.entities) {
    if (!e.physical_tags.empty()) groups[e.key] = e.physical_tags.front();
  }
  std::vector<int> block2group;
  for (const ElementBlock& b : mesh.blocks) {
    const auto group = groups.find({dimension(b.shape), b.entity});
    block2group.push_back(group != groups.end() ? group->second : 0);
  }
  CellData data;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const ElementBlock& block = mesh.blocks[cells.cell2block[c]];
    data.dim.push_back(dimension(block.shape));
    data.order.push_back(block.order);
    data.entity.push_back(block.entity);
    data.group.push_back(block2group[cells.cell2block[c]]);
    data.element.push_back(static_cast<std::int64_t>(cells.cell2element[c]));
  }
  for (const Field& field : mesh.element_fields) {
    std::vector<double>& values = data.fields.emplace_back();
    for (const std::size_t e : cells.cell2element) {
      values.push_back(e < field.values.size() ? field.values[e]
                                               : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return data;
}

std::span<const double> flat(const Points& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {points.empty() ? nullptr : points.front().data(), 3 * points.size()};
}

}  // namespace
}  // namespace vtu

FileSummary write_vtu(const MeshData& mesh, const std::string& path, const VtuWriteOptions& options,
                      const std::string& display) {
  check_mesh(mesh, display);
  const vtu::Cells cells = vtu::make_cells(mesh);
  const vtu::CellData data = vtu::make_cell_data(mesh, cells);
  OutputFile out(path, display);
  vtu::Arrays arrays(out, options.binary);
  const bool little = std::endian::native == std::endian::little;
  out.print(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      little ? "LittleEndian" : "BigEndian", cells.points.size(), cells.types.size());
  out.append("      <Points>\n");
  arrays.write<double>("Points", vtu::flat(cells.points), 3);
  out.append("      </Points>\n      <Cells>\n");
  arrays.write<std::int64_t>("connectivity", cells.connectivity);
  arrays.write<std::int64_t>("offsets", cells.offsets);
  arrays.write<std::uint8_t>("types", cells.types);
  out.append("      </Cells>\n      <CellData>\n");
  arrays.write<std::int32_t>("dim", data.dim);
  arrays.write<std::int32_t>("order", data.order);
  arrays.write<std::int32_t>("entity", data.entity);
  arrays.write<std::int32_t>("group", data.group);
  arrays.write<std::int64_t>("element", data.element);
  for (std::size_t f = 0; f < data.fields.size(); ++f) {
    arrays.write<double>(mesh.element_fields[f].name, data.fields[f]);
  }
  out.append("      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n");
  arrays.append_data();
  out.append("</VTKFile>\n");
  out.finish();
  return {out.size(), out.hash()};
}

}  // namespace camber::io
