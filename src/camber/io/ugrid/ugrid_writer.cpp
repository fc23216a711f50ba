#include <camber/base/error.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/ugrid/ugrid_layout.hpp>
#include <camber/io/ugrid/ugrid_writer.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace camber::io {
namespace ugrid {
namespace {

/// FUN3D's number of a far field: a valid entry that the user changes.
constexpr int k_far_field = 5000;

class Numbers {
 public:
  Numbers(OutputFile& out, const Layout& layout) : out_(out), layout_(layout) {}

  void integer(std::size_t value) { put(static_cast<std::int32_t>(value)); }
  void real(double value) { put(value); }
  void end_line() {
    if (!layout_.is_binary) out_.append("\n");
    is_line_start_ = true;
  }
  /// The length that stands before and after a Fortran record.
  void record_mark(std::uint64_t bytes) {
    if (layout_.has_records) put(static_cast<std::uint32_t>(bytes));
  }

 private:
  template <class T>
  void put(T value) {
    if (!layout_.is_binary) {
      out_.print("{}{}", is_line_start_ ? "" : " ", value);
      is_line_start_ = false;
      return;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (layout_.is_big_endian != (std::endian::native == std::endian::big)) {
      std::reverse(bytes, bytes + sizeof(T));
    }
    out_.append({bytes, sizeof(T)});
  }

  OutputFile& out_;
  Layout layout_;
  bool is_line_start_ = true;
};

template <class Visit>
void for_each_block(const MeshData& mesh, Shape shape, const Visit& visit) {
  for (const ElementBlock& block : mesh.blocks) {
    if (block.shape == shape) visit(block);
  }
}

std::size_t count(const MeshData& mesh, Shape shape) {
  std::size_t n = 0;
  for_each_block(mesh, shape, [&](const ElementBlock& block) { n += block.size(); });
  return n;
}

void write_elements(const MeshData& mesh, const Kind& kind, Numbers& to) {
  const std::vector<int>& corner = lattice_map(kind.shape, 1).corner;
  for_each_block(mesh, kind.shape, [&](const ElementBlock& block) {
    for (std::size_t e = 0; e < block.nodes.size(); e += corner.size()) {
      for (std::size_t i = 0; i < corner.size(); ++i) {
        const auto c = static_cast<std::size_t>(kind.corner_of_file[i]);
        const Index node = block.nodes[e + static_cast<std::size_t>(corner[c])];
        to.integer(static_cast<std::size_t>(node) + 1);
      }
      to.end_line();
    }
  });
}

void write_tags(const MeshData& mesh, const Kind& kind, Numbers& to) {
  for_each_block(mesh, kind.shape, [&](const ElementBlock& block) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      to.integer(static_cast<std::size_t>(block.entity));
      to.end_line();
    }
  });
}

/// Bytes of everything behind the counts.
std::uint64_t body_size(const MeshData& mesh) {
  std::uint64_t integers = 0;
  for (const Kind& kind : k_cells) {
    integers += count(mesh, kind.shape) * static_cast<std::uint64_t>(corner_count(kind.shape));
  }
  for (const Kind& kind : k_faces) {
    integers += count(mesh, kind.shape) * static_cast<std::uint64_t>(corner_count(kind.shape) + 1);
  }
  return 24 * static_cast<std::uint64_t>(mesh.points.size()) + 4 * integers;
}

}  // namespace
}  // namespace ugrid

NameRules ugrid_name_rules() { return {.forbidden = " \t", .keeps_volumes = false}; }

void write_ugrid(const NamedMesh& named, const std::string& path, const std::string& display) {
  const MeshData& mesh = named.mesh;
  check_mesh(mesh, display);
  const ugrid::Layout layout = ugrid::layout_of(display);
  std::vector<std::size_t> counts{mesh.points.size()};
  for (const ugrid::Kind& kind : ugrid::k_faces) counts.push_back(ugrid::count(mesh, kind.shape));
  for (const ugrid::Kind& kind : ugrid::k_cells) counts.push_back(ugrid::count(mesh, kind.shape));
  const auto most = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  const std::uint64_t body = ugrid::body_size(mesh);
  if (*std::max_element(counts.begin(), counts.end()) > most ||
      (layout.has_records && body > most)) {
    throw FileError("the mesh is too large for this kind of UGRID", display,
                    layout.has_records ? "write .b8.ugrid or .lb8.ugrid" : "write .msh or .cgns");
  }
  OutputFile out(path, display);
  ugrid::Numbers to(out, layout);
  const std::uint64_t head = 4 * counts.size();
  to.record_mark(head);
  for (const std::size_t n : counts) to.integer(n);
  to.end_line();
  to.record_mark(head);
  to.record_mark(body);
  for (const Vec3& x : mesh.points) {
    for (int d = 0; d < 3; ++d) to.real(x[d]);
    to.end_line();
  }
  for (const ugrid::Kind& kind : ugrid::k_faces) ugrid::write_elements(mesh, kind, to);
  for (const ugrid::Kind& kind : ugrid::k_faces) ugrid::write_tags(mesh, kind, to);
  for (const ugrid::Kind& kind : ugrid::k_cells) ugrid::write_elements(mesh, kind, to);
  to.record_mark(body);
  out.finish();
}

std::string mapbc_text(const NamedMesh& named) {
  std::string lines;
  int patches = 0;
  for (const EntityRecord& patch : named.mesh.entities) {
    if (patch.key.dim != 2) continue;
    ++patches;
    lines += fmt::format("{} {} {}\n", patch.key.tag, ugrid::k_far_field, patch.name);
  }
  return fmt::format("{}\n{}", patches, lines);
}

}  // namespace camber::io
