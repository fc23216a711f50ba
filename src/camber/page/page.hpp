#pragma once
// The page: a curved mesh and its report as one HTML file that a browser opens without a server.
#include <camber/base/progress.hpp>
#include <camber/geom/geometry_model.hpp>
#include <camber/page/tessellation.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/curve.hpp>

#include <string>
#include <vector>

namespace camber {

/// What the page shows.
struct PageContent {
  MeshData mesh;                              // elements of mixed order
  CellFindings findings;                      // by volume element of `mesh`
  std::vector<GeometryGroup> surface_groups;  // by surface element: its CAD faces; may be empty
  // By surface element: its largest distance to the geometry [length], NaN for none; may be empty.
  // Shown where the geometry itself is not given.
  std::vector<double> surface_deviation;
  std::string title;   // of the window: mostly the file's name
  std::string report;  // of json_report(), "" for none
};

struct PageOptions {
  TessellationOptions tessellation;
  std::size_t max_volume_bytes = 96'000'000;  // cells' nodes for the cut; above it corners only
};

/// Content for a mesh as it stands in a file. Surface tags that are numbers of CAD faces link a
/// surface element to the CAD, as in check(). @param geometry may be null
[[nodiscard]] PageContent page_content(MeshData mesh, CellFindings findings, const Report& report,
                                       const GeometryModel* geometry);
/// Content for what curve() made: its own orders and its own link to the CAD.
[[nodiscard]] PageContent page_content(const CurveResult& result, const std::string& title);

/// The text of the page. Self-contained: script, style and data are inside, nothing is loaded.
/// Data: points and normals of the surface (32 and 16 bits, about the centre of the mesh's box),
/// what is known of every face and cell, nodes of all cells for the cut. About 60 bytes a triangle
/// and 150 bytes a cell.
/// @param geometry  null: content.surface_deviation is shown, if there; else its scale is that of
/// the mesh
/// @throws MeshError if there is no volume element. Threads: parallel inside, the same bytes for
///         any number of them.
[[nodiscard]] std::string page_html(const PageContent& content, const GeometryModel* geometry,
                                    const PageOptions& options = {});

}  // namespace camber
