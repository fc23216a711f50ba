#pragma once
// Reading numbers from a .msh file in memory, text or binary, with errors that say where.
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace camber::io::gmsh {

/// A place in the file. Every read function moves on, or throws a FileError that names the file,
/// the line (text) or byte (binary), what was found and what was expected; nothing is read past the
/// end.
class Cursor {
 public:
  Cursor(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {}

  /// From here on int_value, size_value and real read binary data.
  void use_binary(bool swap_bytes) {
    binary_ = true;
    swap_ = swap_bytes;
  }
  [[nodiscard]] bool is_binary() const { return binary_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t offset() const { return at_; }
  [[nodiscard]] std::size_t remaining() const { return text_.size() - at_; }

  // In the flavour of the file.

  /// Binary: a 4-byte integer. Text: any integer.
  [[nodiscard]] std::int64_t int_value(const char* expected);
  /// An int_value that fits an `int`: an entity's or a group's tag.
  [[nodiscard]] int tag(const char* expected);
  /// Binary: an 8-byte integer without sign, at most 2^63 - 1. Text: any integer.
  [[nodiscard]] std::int64_t size_value(const char* expected);
  /// A finite number.
  [[nodiscard]] double real(const char* expected);
  /// Binary: an 8-byte integer with sign. Text: any integer.
  [[nodiscard]] std::int64_t long_value(const char* expected);
  /// Binary: a finite number of 4 bytes. Text: any finite number.
  [[nodiscard]] double short_real(const char* expected);
  /// Goes to a place in the file, at most its end.
  void move_to(std::size_t offset) { at_ = offset < text_.size() ? offset : text_.size(); }
  /// Fails unless `count` items of at least the given number of bytes each can still follow;
  /// `start` is where the count stands. So no allocation is ever larger than a small multiple of
  /// the file.
  [[nodiscard]] std::size_t checked_count(std::int64_t count, std::size_t start,
                                          std::size_t text_bytes, std::size_t binary_bytes,
                                          const char* expected) const;
  /// Place of the next number: errors about its value point there.
  [[nodiscard]] std::size_t next();

  // Always text.

  /// Place of the next word or number.
  [[nodiscard]] std::size_t next_word();
  [[nodiscard]] std::int64_t text_integer(const char* expected);
  [[nodiscard]] double text_real(const char* expected);
  [[nodiscard]] std::string_view word(const char* expected);
  /// A name in double quotes, up to the last quote of the line.
  [[nodiscard]] std::string quoted(const char* expected);
  /// Moves behind the next line feed; only blanks may stand before it.
  void end_line(const char* expected);
  /// Moves to the start of the next line, or to the end of the file.
  void skip_line();
  /// True at the end of the file, blanks aside.
  [[nodiscard]] bool at_end();
  /// Moves behind the next occurrence of `mark`; false (and no move) if there is none.
  [[nodiscard]] bool skip_past(std::string_view mark);

  /// "NAME, line 12" or "NAME, byte 345".
  [[nodiscard]] std::string where(std::size_t offset) const;
  /// What stands at `offset`, quoted for a message.
  [[nodiscard]] std::string found(std::size_t offset) const;
  /// @throws FileError "found .., expected ..".
  [[noreturn]] void fail(std::size_t offset, const std::string& found,
                         const std::string& expected) const;

 private:
  void skip_blanks();
  template <class T>
  [[nodiscard]] T raw(const char* expected);
  template <class Real>
  [[nodiscard]] double finite(const char* expected);

  std::string path_;
  std::string_view text_;
  std::size_t at_ = 0;
  bool binary_ = false;
  bool swap_ = false;
};

}  // namespace camber::io::gmsh
