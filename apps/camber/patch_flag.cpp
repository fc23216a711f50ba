// --patch, as curve and associate take it.
#include <camber/base/error.hpp>

#include <algorithm>
#include <map>

#include "flags.hpp"

namespace camber::app {
namespace {

/// The CAD faces of NAME=face_3,face_4 (numbers, or cad:NAME for a name of the CAD); empty for a
/// rule.
std::vector<std::string> faces_of(const std::string& text, std::size_t equals) {
  std::vector<std::string> faces;
  if (equals == std::string::npos || equals == 0) return faces;
  std::size_t begin = equals + 1;
  while (begin <= text.size()) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, comma - begin);
    if (name.starts_with("face_")) {
      faces.push_back(name);
    } else if (name.starts_with("cad:")) {
      faces.push_back(name.substr(4));
    } else {
      return {};
    }
    begin = comma + 1;
  }
  return faces;
}

}  // namespace

TagOptions association_of(const std::vector<std::string>& texts) {
  TagOptions association;
  static const std::map<std::string, PatchRule> rules{{"free", PatchRule::free},
                                                      {"fixed", PatchRule::fixed},
                                                      {"plane", PatchRule::plane},
                                                      {"wall", PatchRule::wall}};
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    if (const auto faces = faces_of(text, equals); !faces.empty()) {
      association.faces[text.substr(0, equals)] = faces;
      continue;
    }
    const auto rule =
        equals == std::string::npos ? rules.end() : rules.find(text.substr(equals + 1));
    if (rule == rules.end() || equals == 0) {
      throw OptionError("'" + text + "' is no rule for a patch", "--patch",
                        "give NAME=free, NAME=fixed, NAME=plane, NAME=wall or NAME=face_3,face_4");
    }
    association.patches[text.substr(0, equals)] = rule->second;
  }
  return association;
}

void add_patch_flag(CLI::App& verb, std::vector<std::string>& patches) {
  verb.add_option("--patch", patches,
                  "how a patch behaves, by name or surface number: free, fixed, plane or wall; "
                  "or the CAD faces it lies on: face_3,face_4 or cad:NAME; "
                  "may be given several times; default: by its tag and shape")
      ->type_name("NAME=RULE")
      ->expected(1)
      ->take_all();
}

}  // namespace camber::app
