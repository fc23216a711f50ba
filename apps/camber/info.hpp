#pragma once
#include <camber/base/vec.hpp>

#include <string>

#include <nlohmann/json.hpp>

#include "flags.hpp"

namespace camber::app {

/// What a file holds, for people and for programs.
struct Info {
  std::string text;
  nlohmann::ordered_json json;
};

[[nodiscard]] Info mesh_info(const std::string& path, const io::ReadOptions& options);
[[nodiscard]] Info cad_info(const std::string& path, double scale);

/// "(0, 0, 0) to (1, 1, 1)"; "none" if empty.
[[nodiscard]] std::string box_text(const Box& box);
[[nodiscard]] nlohmann::ordered_json box_json(const Box& box);

}  // namespace camber::app
