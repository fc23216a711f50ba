#pragma once
#include <camber/io/detail/output_file.hpp>

#include <cstdint>

namespace camber::io::gmsh {

/// Writes the numbers of a .msh section in the flavour of the file.
class NumberWriter {
 public:
  NumberWriter(OutputFile& out, bool binary) : out_(out), binary_(binary) {}

  [[nodiscard]] bool is_binary() const { return binary_; }
  /// 4 bytes in binary.
  void int_value(std::int32_t value) { put(value); }
  /// 8 bytes in binary.
  void size_value(std::uint64_t value) { put(value); }
  void real(double value) { put(value); }
  /// Ends a line of text; nothing in binary.
  void end_line() {
    if (!binary_) out_.append("\n");
    line_start_ = true;
  }

 private:
  template <class T>
  void put(T value) {
    if (binary_) {
      out_.append_raw(value);
      return;
    }
    out_.print("{}{}", line_start_ ? "" : " ", value);
    line_start_ = false;
  }

  OutputFile& out_;
  bool binary_;
  bool line_start_ = true;
};

}  // namespace camber::io::gmsh
