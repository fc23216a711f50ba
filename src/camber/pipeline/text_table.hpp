#pragma once
#include <string>
#include <vector>

namespace camber {

/// Rows of text set in aligned columns: the first to the left, the others to the right.
class TextTable {
 public:
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// Every row on a line of its own, two spaces in front and between columns; no trailing spaces.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace camber
