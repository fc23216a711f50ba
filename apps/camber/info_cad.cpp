#include <camber/geom_occ/cad_file.hpp>
#include <camber/pipeline/text_table.hpp>

#include <fmt/format.h>

#include "info.hpp"

namespace camber::app {

Info cad_info(const std::string& path, double scale) {
  const std::unique_ptr<GeometryModel> model = read_cad(path);
  model->set_scale(scale);
  Info info;
  info.text = fmt::format(
      "CAD {}\n  {} faces, {} curves, {} vertices\n  box {}\n  lengths are millimetres times "
      "{:g}\n",
      path, model->count(2), model->count(1), model->count(0), box_text(model->box()), scale);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  TextTable table;
  table.add({"face", "name", "kind", "curves", "box"});
  for (int tag = 1; tag <= model->count(2); ++tag) {
    const GeomEntity face{2, tag};
    const std::string name = model->name(face);
    const std::string kind = model->is_planar(tag) ? "plane" : "curved";
    const std::size_t curves = model->curves_of_face(tag).size();
    table.add({fmt::format("face {}", tag), name.empty() ? "-" : name, kind,
               fmt::format("{}", curves), box_text(model->box(face))});
    list.push_back({{"tag", tag},
                    {"name", name},
                    {"kind", kind},
                    {"curves", curves},
                    {"box", box_json(model->box(face))}});
  }
  info.text += table.text();
  info.json["cad"] = {{"path", path},
                      {"faces", model->count(2)},
                      {"curves", model->count(1)},
                      {"vertices", model->count(0)},
                      {"scale", scale},
                      {"box", box_json(model->box())},
                      {"face", list}};
  return info;
}

}  // namespace camber::app
