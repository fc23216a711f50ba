#pragma once
// Pictures of the page, made by a browser without a window.
#include <string>

namespace camber::app {

struct PictureSize {
  int width = 1600, height = 1000;  // [pixels]
};
/// "1600x1000". @throws OptionError
[[nodiscard]] PictureSize picture_size(const std::string& text);

/// Path of Chromium or Chrome: $CAMBER_BROWSER, else the first of the usual names in $PATH.
/// @throws OptionError that says what to install
[[nodiscard]] std::string find_browser();

/// Opens the page (a file) in the state that `state` describes, the part of its address after the
/// '#', and writes what it shows as PNG. Replaces `png` in one step.
/// @throws FileError if the browser fails, or takes longer than two minutes
void take_picture(const std::string& browser, const std::string& page, const std::string& state,
                  const PictureSize& size, const std::string& png);

}  // namespace camber::app
