#pragma once
#include <stdexcept>
#include <string>

namespace camber {

/// What a user did wrong or the machine could not do: what happened, where, and what to do about
/// it. A numerical outcome is never an Error but a value (Verdict, Projection::status).
class Error : public std::runtime_error {
 public:
  Error(std::string what, std::string where, std::string remedy);
  [[nodiscard]] const std::string& message() const { return message_; }
  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] const std::string& remedy() const { return remedy_; }

 private:
  std::string message_, where_, remedy_;
};

/// A file cannot be read or written, or its content breaks its format. `where` holds path and
/// place.
struct FileError : Error {
  using Error::Error;
};
/// The mesh was read but cannot be curved (inverted, non-manifold, no boundary, ...).
struct MeshError : Error {
  using Error::Error;
};
/// The CAD was read but cannot be used, or does not fit the mesh.
struct GeometryError : Error {
  using Error::Error;
};
/// An option is unknown, out of range or contradicts another one.
struct OptionError : Error {
  using Error::Error;
};

}  // namespace camber
