#include <camber/io/detail/output_file.hpp>
#include <camber/io/detail/xml_text.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/meshlink/meshlink.hpp>

#include <fmt/format.h>

namespace camber::io {
namespace {

std::string attribute(const char* name, const std::string& value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, xml_escaped(value));
}
std::string attribute(const char* name, int value) {
  return value == 0 ? "" : fmt::format(" {}=\"{}\"", name, value);
}

void write_group(const char* tag, const char* id, const MeshLink::Group& group, OutputFile& out) {
  out.print("  <{} {}=\"{}\"{}{}>{}</{}>\n", tag, id, group.id, attribute("name", group.name),
            attribute("aref", group.attributes), fmt::join(group.members, " "), tag);
}

void write_parameters(const std::vector<MeshLink::ParamVertex>& list, OutputFile& out) {
  for (const MeshLink::ParamVertex& p : list) {
    out.print("        <ParamVertex vref=\"{}\"{} dim=\"{}\">{}", p.vertex,
              attribute("gref", p.geometry), p.dimension, p.u);
    if (p.dimension == 2) out.print(" {}", p.v);
    out.print("</ParamVertex>\n");
  }
}

void write_elements(const std::string& tag, const MeshLink::Elements& list, OutputFile& out) {
  const std::size_t size = static_cast<std::size_t>(list.is_opaque ? 1 : list.corners);
  const char* type = list.corners == 2   ? " etype=\"Edge2\""
                     : list.corners == 3 ? " etype=\"Tri3\""
                     : list.corners == 4 ? " etype=\"Quad4\""
                                         : "";
  const std::string full = tag + (list.is_opaque || list.corners == 1 ? "Reference" : "");
  out.print("        <{}{} count=\"{}\"{}{}{}>\n", full, type, list.numbers.size() / size,
            attribute("name", list.name), attribute("gref", list.geometry),
            attribute("aref", list.attributes));
  for (std::size_t i = 0; i < list.numbers.size(); ++i) {
    out.print("{}{}", list.numbers[i], (i + 1) % size == 0 ? '\n' : ' ');
  }
  out.print("        </{}>\n", full);
}

void write_parts(const char* tag, const char* element, const std::vector<MeshLink::Part>& parts,
                 OutputFile& out) {
  for (const MeshLink::Part& part : parts) {
    out.print("      <{}{}{}{}>\n", tag, attribute("name", part.name),
              attribute("gref", part.geometry), attribute("aref", part.attributes));
    write_parameters(part.parameters, out);
    for (const MeshLink::Elements& list : part.elements) write_elements(element, list, out);
    out.print("      </{}>\n", tag);
  }
}

void write(const MeshLink& link, OutputFile& out) {
  out.print("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  out.print("<MeshLink xmlns=\"https://cadence.com\" version=\"1.0\">\n");
  for (const MeshLink::Attribute& a : link.attributes) {
    out.print("  <Attribute attid=\"{}\"{}>{}</Attribute>\n", a.id, attribute("name", a.name),
              xml_escaped(a.text));
  }
  for (const MeshLink::Group& g : link.attribute_groups) {
    write_group("AttributeGroup", "attid", g, out);
  }
  for (const MeshLink::GeometryFile& file : link.geometry) {
    out.print("  <GeometryFile filename=\"{}\"{}>\n", xml_escaped(file.path),
              attribute("aref", file.attributes));
    for (const MeshLink::Reference& r : file.references) {
      out.print("    <GeometryReference gid=\"{}\" ref=\"{}\"{}{}/>\n", r.id, xml_escaped(r.ref),
                attribute("name", r.name), attribute("aref", r.attributes));
    }
    out.print("  </GeometryFile>\n");
  }
  for (const MeshLink::Group& g : link.geometry_groups) write_group("GeometryGroup", "gid", g, out);
  for (const MeshLink::MeshFile& file : link.meshes) {
    out.print("  <MeshFile filename=\"{}\"{}>\n", xml_escaped(file.path),
              attribute("aref", file.attributes));
    for (const MeshLink::Model& model : file.models) {
      out.print("    <MeshModelReference ref=\"{}\"{}{}{}>\n", xml_escaped(model.ref),
                attribute("name", model.name), attribute("gref", model.geometry),
                attribute("aref", model.attributes));
      write_parts("MeshSheet", "MeshFace", model.sheets, out);
      write_parts("MeshString", "MeshEdge", model.strings, out);
      for (const MeshLink::Elements& points : model.points) {
        write_elements("MeshPoint", points, out);
      }
      write_parameters(model.parameters, out);
      out.print("    </MeshModelReference>\n");
    }
    out.print("  </MeshFile>\n");
  }
  for (const MeshLink::Transform& t : link.transforms) {
    out.print("  <Transform xid=\"{}\"{}{}>{}</Transform>\n", t.id, attribute("name", t.name),
              attribute("aref", t.attributes), fmt::join(t.matrix, " "));
  }
  for (const MeshLink::Linkage& l : link.linkages) {
    out.print("  <MeshElementLinkage sourceEntityRef=\"{}\" targetEntityRef=\"{}\"{}{}{}/>\n",
              xml_escaped(l.source), xml_escaped(l.target), attribute("name", l.name),
              attribute("xref", l.transform), attribute("aref", l.attributes));
  }
  out.print("</MeshLink>\n");
}

}  // namespace

void write_meshlink(const MeshLink& link, const std::string& path) {
  write_atomically(path, [&](const std::string& temporary) {
    OutputFile out(temporary, path);
    write(link, out);
    out.finish();
  });
}

}  // namespace camber::io
