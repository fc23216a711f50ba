#pragma once
#include <camber/associate/by_tags.hpp>
#include <camber/elevate/order_rules.hpp>
#include <camber/io/meshlink/meshlink.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace camber {

struct SurfaceLink;  // pipeline/own_surface.hpp

/// How the wall's displacement is carried into the volume.
enum class Propagation {
  layer,    // through the whole boundary layer (default)
  elastic,  // by a linear solve over all curved cells (smooth/elastic.hpp)
  cell      // the paper's transfer (2.2.4): linearly decaying inside the elevated cells only
};

/// What is done for quality once every cell is certified.
enum class Smoothing {
  automatic,  // default
  marching,   // the paper's perturbations along the sensitivities of the cost (2.2.5)
  none
};

/// What links the mesh to the CAD.
enum class LinkBy {
  automatic,  // tags if they fit the CAD, else shape (default)
  tags,
  shape,       // place and shape alone, tags or not
  file,        // CurveOptions::mesh_link
  own_surface  // CurveOptions::surface_link
};

/// Everything a run of curve() depends on besides its files.
struct CurveOptions {
  OrderOptions orders;   // --order, --min-order, --deviation, --deviation-length
  bool uniform = false;  // write every cell at orders.max_order (exact elevation)
  Propagation propagation = Propagation::layer;
  LayerFieldOptions layer;
  Smoothing smoothing = Smoothing::automatic;
  double polish_below = 0.6;  // cells with a lower cost C are polished by Smoothing::automatic
  double quality = 0.95;      // --quality: cost C that every cell should have (paper's threshold)
  double scale = 0.0;         // --unit: mesh length per CAD length (read as mm); 0: found
  TagOptions association;     // --patch
  LinkBy link_by = LinkBy::automatic;
  io::MeshLink mesh_link;                           // --link FILE
  std::shared_ptr<const SurfaceLink> surface_link;  // set by curve_without_cad()
  bool fit = false;            // slide wall nodes until the faces follow the CAD best
  bool split_pinched = false;  // mend cells that no curved wall can leave valid (unpinch.hpp)
  bool allow_invalid = false;  // write even if something is not certified
  bool strict = false;         // faces over the deviation count as failure (exit code 3)
};

}  // namespace camber
