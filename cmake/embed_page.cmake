# cmake -DINPUT=page.html -DOUTPUT=page_template.cpp -P embed_page.cmake: the file as an array of bytes.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
file(WRITE ${OUTPUT} "// Generated from page.html.
#include <camber/page/detail/page_template.hpp>

namespace camber::detail {
namespace {
constexpr unsigned char k_bytes[] = {
${bytes}};
}  // namespace

std::string_view page_template() {
  return {reinterpret_cast<const char*>(k_bytes), sizeof(k_bytes)};
}

}  // namespace camber::detail
")
