#include "isolation.hpp"

#include <camber/base/child_process.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/io/cgns/cgns_families.hpp>
#include <camber/io/cgns/cgns_reader.hpp>
#include <camber/pipeline/geometry_source.hpp>

#include "console.hpp"

namespace camber::app {
namespace {

constexpr double k_gigabyte = 1e9;

}  // namespace

void add_isolation_flags(CLI::App& verb, IsolationFlags& flags) {
  verb.add_flag("--isolate", flags.is_asked,
                "read CGNS and CAD files twice, first in a process of its own with limits: a crash "
                "of a library on a damaged file becomes an error (docs/formats.md)");
  verb.add_option("--isolate-memory", flags.memory, "limit of --isolate [GB]")
      ->check(CLI::PositiveNumber)
      ->type_name("GB")
      ->capture_default_str();
  verb.add_option("--isolate-time", flags.seconds, "limit of --isolate, of processor time [s]")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS")
      ->capture_default_str();
}

void try_inputs(const IsolationFlags& flags, const std::string& mesh,
                const io::ReadOptions& reading, const std::vector<std::string>& geometry) {
  if (!flags.is_asked) return;
  const ChildLimits limits{static_cast<std::size_t>(flags.memory * k_gigabyte), flags.seconds};
  const auto cancelled = [] { return interrupted() != 0; };
  const auto format_of = [&] {
    return reading.format == io::Format::automatic ? io::format_by_name(mesh) : reading.format;
  };
  if (!mesh.empty() && format_of() == io::Format::cgns) {
    const auto read = [&] {
      static_cast<void>(io::read_cgns(mesh));
      static_cast<void>(io::read_cgns_geometry(mesh));
    };
    try_in_child(mesh, limits, read, cancelled);
  }
  for (const std::string& cad : geometry) {
    if (cad == "auto" || is_geometry_without_cad(cad)) continue;
    try_in_child(
        cad, limits, [&] { static_cast<void>(read_cad(cad)); }, cancelled);
  }
}

}  // namespace camber::app
