#include <camber/base/error.hpp>
#include <camber/io/gmsh/cursor.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace camber::io::gmsh {
namespace {

constexpr const char* k_remedy = "the file is damaged or incomplete: save it again";
constexpr std::size_t k_longest_excerpt = 40;

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void Cursor::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

std::size_t Cursor::next() { return binary_ ? at_ : next_word(); }

std::size_t Cursor::next_word() {
  skip_blanks();
  return at_;
}

bool Cursor::at_end() {
  skip_blanks();
  return at_ == text_.size();
}

template <class T>
T Cursor::raw(const char* expected) {
  if (remaining() < sizeof(T)) fail(at_, found(text_.size()), expected);
  char bytes[sizeof(T)];
  std::memcpy(bytes, text_.data() + at_, sizeof(T));
  if (swap_) std::reverse(bytes, bytes + sizeof(T));
  at_ += sizeof(T);
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

std::int64_t Cursor::int_value(const char* expected) {
  return binary_ ? raw<std::int32_t>(expected) : text_integer(expected);
}

int Cursor::tag(const char* expected) {
  const std::size_t start = next();
  const std::int64_t value = int_value(expected);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
    fail(start, std::to_string(value), std::string(expected) + " of at most 32 bits");
  }
  return static_cast<int>(value);
}

std::int64_t Cursor::size_value(const char* expected) {
  if (!binary_) return text_integer(expected);
  const std::size_t start = at_;
  const auto value = raw<std::uint64_t>(expected);
  if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    fail(start, std::to_string(value), std::string(expected) + " below 2^63");
  }
  return static_cast<std::int64_t>(value);
}

template <class Real>
double Cursor::finite(const char* expected) {
  if (!binary_) return text_real(expected);
  const std::size_t start = at_;
  const auto value = raw<Real>(expected);
  if (!std::isfinite(value)) fail(start, fmt::format("{}", value), expected);
  return value;
}

double Cursor::real(const char* expected) { return finite<double>(expected); }

double Cursor::short_real(const char* expected) { return finite<float>(expected); }

std::int64_t Cursor::long_value(const char* expected) {
  return binary_ ? raw<std::int64_t>(expected) : text_integer(expected);
}

std::size_t Cursor::checked_count(std::int64_t count, std::size_t start, std::size_t text_bytes,
                                  std::size_t binary_bytes, const char* expected) const {
  if (count < 0) fail(start, std::to_string(count), std::string(expected) + " (zero or more)");
  const std::size_t most = remaining() / (binary_ ? binary_bytes : text_bytes) + 1;
  if (static_cast<std::uint64_t>(count) > most) {
    fail(start, std::to_string(count),
         fmt::format("{} that fits into the {} bytes left in the file", expected, remaining()));
  }
  return static_cast<std::size_t>(count);
}

std::int64_t Cursor::text_integer(const char* expected) {
  skip_blanks();
  std::int64_t value = 0;
  const char* const end = text_.data() + text_.size();
  const auto [stop, error] = std::from_chars(text_.data() + at_, end, value);
  if (error != std::errc() || (stop != end && !is_blank(*stop))) fail(at_, found(at_), expected);
  at_ = static_cast<std::size_t>(stop - text_.data());
  return value;
}

double Cursor::text_real(const char* expected) {
  skip_blanks();
  const char* begin = text_.data() + at_;
  const char* const end = text_.data() + text_.size();
  if (end - begin > 1 && begin[0] == '+' && begin[1] != '-') ++begin;
  double value = 0.0;
  auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) {
    // Too large, or just too small for a double: the wider type tells which.
    long double wide = 0.0L;
    const auto again = std::from_chars(begin, end, wide);
    stop = again.ptr;
    error = again.ec;
    value = static_cast<double>(wide);
  }
  if (error != std::errc() || (stop != end && !is_blank(*stop)) || !std::isfinite(value)) {
    fail(at_, found(at_), expected);
  }
  at_ = static_cast<std::size_t>(stop - text_.data());
  return value;
}

std::string_view Cursor::word(const char* expected) {
  skip_blanks();
  if (at_ == text_.size()) fail(at_, found(at_), expected);
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string Cursor::quoted(const char* expected) {
  skip_blanks();
  const std::size_t line_end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view line = text_.substr(at_, line_end - at_);
  const std::size_t last = line.rfind('"');
  if (line.empty() || line.front() != '"' || last == 0) fail(at_, found(at_), expected);
  at_ += last + 1;
  return std::string(line.substr(1, last - 1));
}

void Cursor::end_line(const char* expected) {
  while (at_ < text_.size() && text_[at_] != '\n') {
    if (!is_blank(text_[at_])) fail(at_, found(at_), expected);
    ++at_;
  }
  if (at_ == text_.size()) fail(at_, found(at_), expected);
  ++at_;
}

void Cursor::skip_line() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }

bool Cursor::skip_past(std::string_view mark) {
  const std::size_t place = text_.find(mark, at_);
  if (place == std::string_view::npos) return false;
  at_ = place + mark.size();
  return true;
}

std::string Cursor::where(std::size_t offset) const {
  if (binary_) return fmt::format("{}, byte {}", path_, offset);
  const std::string_view before = text_.substr(0, offset);
  return fmt::format("{}, line {}", path_, 1 + std::count(before.begin(), before.end(), '\n'));
}

std::string Cursor::found(std::size_t offset) const {
  if (offset >= text_.size()) return "the end of the file";
  std::string excerpt;
  for (std::size_t i = offset; i < text_.size() && !is_blank(text_[i]); ++i) {
    if (excerpt.size() >= k_longest_excerpt) return "'" + excerpt + "...'";
    const char c = text_[i];
    if (c >= ' ' && c <= '~') {
      excerpt += c;
    } else {
      excerpt += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return "'" + excerpt + "'";
}

void Cursor::fail(std::size_t offset, const std::string& found, const std::string& expected) const {
  throw FileError(fmt::format("found {}, expected {}", found, expected), where(offset), k_remedy);
}

}  // namespace camber::io::gmsh
