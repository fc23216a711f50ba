#include <camber/base/error.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/gmsh/element_types.hpp>
#include <camber/io/gmsh/gmsh_writer.hpp>
#include <camber/io/gmsh/number_writer.hpp>
#include <camber/io/gmsh/write_plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

namespace camber::io {
namespace gmsh {
namespace {

void write_format(OutputFile& out, const char* version, bool binary) {
  out.print("$MeshFormat\n{} {} 8\n", version, binary ? 1 : 0);
  if (binary) {
    out.append_raw(std::int32_t{1});
    out.append("\n");
  }
  out.append("$EndMeshFormat\n");
}

void write_physical_names(OutputFile& out, const MeshData& mesh) {
  if (mesh.physical_names.empty()) return;
  out.print("$PhysicalNames\n{}\n", mesh.physical_names.size());
  for (const PhysicalName& p : mesh.physical_names) {
    std::string name = p.name;
    // A name ends with its line.
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    out.print("{} {} \"{}\"\n", p.dim, p.tag, name);
  }
  out.append("$EndPhysicalNames\n");
}

/// Text that ends a section: binary data needs a line feed of its own.
void end_section(OutputFile& out, bool binary, const char* name) {
  out.print("{}$End{}\n", binary ? "\n" : "", name);
}

// --- version 4.1 ---

void write_box_corner(NumberWriter& to, const Vec3& x) {
  for (int c = 0; c < 3; ++c) to.real(x[c]);
}

void write_entities(OutputFile& out, const WritePlan& plan, bool binary) {
  out.append("$Entities\n");
  NumberWriter to(out, binary);
  for (int dim = 0; dim < 4; ++dim) {
    to.size_value(static_cast<std::uint64_t>(
        std::count_if(plan.entities.begin(), plan.entities.end(),
                      [&](const EntityRecord& e) { return e.key.dim == dim; })));
  }
  to.end_line();
  for (const EntityRecord& e : plan.entities) {
    to.int_value(e.key.tag);
    write_box_corner(to, e.box.lower);
    if (e.key.dim > 0) write_box_corner(to, e.box.upper);
    to.size_value(e.physical_tags.size());
    for (const int tag : e.physical_tags) to.int_value(tag);
    if (e.key.dim > 0) to.size_value(0);
    to.end_line();
  }
  end_section(out, binary, "Entities");
}

/// Blocks, items, lowest and highest number.
void write_totals(NumberWriter& to, std::size_t blocks, std::size_t items, GlobalId lowest,
                  GlobalId highest) {
  to.size_value(blocks);
  to.size_value(items);
  to.size_value(static_cast<std::uint64_t>(lowest));
  to.size_value(static_cast<std::uint64_t>(highest));
  to.end_line();
}

void write_nodes_v4(OutputFile& out, const MeshData& mesh, const WritePlan& plan, bool binary) {
  out.append("$Nodes\n");
  NumberWriter to(out, binary);
  const auto [low, high] = std::minmax_element(plan.point_tags.begin(), plan.point_tags.end());
  const bool any = !plan.point_tags.empty();
  write_totals(to, plan.node_blocks.size(), mesh.points.size(), any ? *low : 0, any ? *high : 0);
  for (const NodeBlock& block : plan.node_blocks) {
    to.int_value(block.entity.dim);
    to.int_value(block.entity.tag);
    to.int_value(block.parametric ? 1 : 0);
    to.size_value(block.end - block.begin);
    to.end_line();
    for (std::size_t k = block.begin; k < block.end; ++k) {
      to.size_value(static_cast<std::uint64_t>(plan.point_tags[at(plan.point_order[k])]));
      to.end_line();
    }
    for (std::size_t k = block.begin; k < block.end; ++k) {
      const Index i = plan.point_order[k];
      write_box_corner(to, mesh.points[at(i)]);
      for (int c = 0; block.parametric && c < block.entity.dim; ++c) {
        to.real(mesh.point_parameters[at(i)][c]);
      }
      to.end_line();
    }
  }
  end_section(out, binary, "Nodes");
}

/// Node numbers of the elements of one block in Gmsh's order.
class ElementNodes {
 public:
  ElementNodes(const ElementBlock& block, const WritePlan& plan)
      : block_(block), plan_(plan), order_(gmsh_to_canonical(block.shape, block.order)) {}

  template <class Put>
  void for_each(std::size_t element, const Put& put) const {
    const Index* const nodes = block_.nodes.data() + element * order_.size();
    for (const int canonical : order_) put(plan_.point_tags[at(nodes[canonical])]);
  }

 private:
  const ElementBlock& block_;
  const WritePlan& plan_;
  std::span<const int> order_;
};

void write_elements_v4(OutputFile& out, const MeshData& mesh, const WritePlan& plan, bool binary) {
  out.append("$Elements\n");
  NumberWriter to(out, binary);
  std::size_t blocks = 0;
  GlobalId low = std::numeric_limits<GlobalId>::max();
  GlobalId high = 0;
  for (const std::vector<GlobalId>& tags : plan.element_tags) {
    if (!tags.empty()) ++blocks;
    for (const GlobalId tag : tags) {
      low = std::min(low, tag);
      high = std::max(high, tag);
    }
  }
  write_totals(to, blocks, mesh.element_count(), std::min(low, high), high);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    if (block.nodes.empty()) continue;
    const ElementNodes nodes(block, plan);
    to.int_value(dimension(block.shape));
    to.int_value(block.entity);
    to.int_value(gmsh_number(block.shape, block.order));
    to.size_value(block.size());
    to.end_line();
    for (std::size_t e = 0; e < block.size(); ++e) {
      to.size_value(static_cast<std::uint64_t>(plan.element_tags[b][e]));
      nodes.for_each(e, [&](GlobalId tag) { to.size_value(static_cast<std::uint64_t>(tag)); });
      to.end_line();
    }
  }
  end_section(out, binary, "Elements");
}

// --- version 2.2 ---

/// Numbers of this version have 32 bits.
std::int32_t narrow(std::size_t number, const std::string& display) {
  if (number > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw FileError(fmt::format("the number {} does not fit into version 2.2", number), display,
                    "write version 4.1");
  }
  return static_cast<std::int32_t>(number);
}

void write_nodes_v2(OutputFile& out, const MeshData& mesh, const WritePlan& plan, bool binary,
                    const std::string& display) {
  out.print("$Nodes\n{}\n", mesh.points.size());
  NumberWriter to(out, binary);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    to.int_value(narrow(static_cast<std::size_t>(plan.point_tags[i]), display));
    write_box_corner(to, mesh.points[i]);
    to.end_line();
  }
  end_section(out, binary, "Nodes");
}

void write_elements_v2(OutputFile& out, const MeshData& mesh, const WritePlan& plan, bool binary,
                       const std::string& display) {
  std::map<EntityKey, int> physical;
  for (const EntityRecord& e : plan.entities) {
    if (!e.physical_tags.empty()) physical[e.key] = e.physical_tags.front();
  }
  out.print("$Elements\n{}\n", mesh.element_count());
  NumberWriter to(out, binary);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    if (block.nodes.empty()) continue;
    const ElementNodes nodes(block, plan);
    const int type = gmsh_number(block.shape, block.order);
    const auto group = physical.find({dimension(block.shape), block.entity});
    if (binary) {
      to.int_value(type);
      to.int_value(narrow(block.size(), display));
      to.int_value(2);
    }
    for (std::size_t e = 0; e < block.size(); ++e) {
      to.int_value(narrow(static_cast<std::size_t>(plan.element_tags[b][e]), display));
      if (!binary) {
        to.int_value(type);
        to.int_value(2);
      }
      to.int_value(group != physical.end() ? group->second : 0);
      to.int_value(block.entity);
      nodes.for_each(
          e, [&](GlobalId tag) { to.int_value(narrow(static_cast<std::size_t>(tag), display)); });
      to.end_line();
    }
  }
  end_section(out, binary, "Elements");
}

}  // namespace
}  // namespace gmsh

void write_gmsh(const MeshData& mesh, const std::string& path, const GmshWriteOptions& options,
                const std::string& display) {
  const gmsh::WritePlan plan = gmsh::plan_write(mesh, display);
  OutputFile out(path, display);
  out.leave_out_hash();  // the file is read back
  const bool is_v4 = options.version > 4.0;
  gmsh::write_format(out, is_v4 ? "4.1" : "2.2", options.binary);
  gmsh::write_physical_names(out, mesh);
  if (is_v4) {
    gmsh::write_entities(out, plan, options.binary);
    gmsh::write_nodes_v4(out, mesh, plan, options.binary);
    gmsh::write_elements_v4(out, mesh, plan, options.binary);
  } else {
    gmsh::write_nodes_v2(out, mesh, plan, options.binary, display);
    gmsh::write_elements_v2(out, mesh, plan, options.binary, display);
  }
  out.finish();
}

}  // namespace camber::io
