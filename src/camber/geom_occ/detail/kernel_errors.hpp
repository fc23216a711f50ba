#pragma once
// Private: OpenCASCADE's exceptions become ours at the module's border.
#include <camber/base/error.hpp>

#include <string>

#include <Standard_Failure.hxx>

namespace camber::occ {

inline std::string message_of(const Standard_Failure& failure) {
  const char* text = failure.GetMessageString();
  const std::string type = failure.DynamicType()->Name();
  return text != nullptr && *text != '\0' ? type + ": " + text : type;
}

/// Runs f; a kernel exception becomes a GeometryError that names `where`.
template <class F>
auto guarded(const std::string& where, const F& f) -> decltype(f()) {
  try {
    return f();
  } catch (const Standard_Failure& failure) {
    throw GeometryError("OpenCASCADE failed: " + message_of(failure), where,
                        "heal the CAD model, or export it again from its CAD system");
  }
}

}  // namespace camber::occ
