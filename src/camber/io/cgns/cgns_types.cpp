#include <camber/base/error.hpp>
#include <camber/io/cgns/detail/cgns_types.hpp>
#include <camber/io/detail/hdf5_mutex.hpp>

#include <array>
#include <stdexcept>
#include <utility>

namespace camber::io::cgns {
namespace {

struct Row {
  CGNS_ENUMT(ElementType_t) type;
  Shape shape;
  int order;
};

/// SIDS, "Elements_t": the complete types; serendipity ones are left out.
constexpr std::array k_types{
    Row{CGNS_ENUMV(BAR_2), Shape::line, 1},
    Row{CGNS_ENUMV(BAR_3), Shape::line, 2},
    Row{CGNS_ENUMV(BAR_4), Shape::line, 3},
    Row{CGNS_ENUMV(BAR_5), Shape::line, 4},
    Row{CGNS_ENUMV(TRI_3), Shape::triangle, 1},
    Row{CGNS_ENUMV(TRI_6), Shape::triangle, 2},
    Row{CGNS_ENUMV(TRI_10), Shape::triangle, 3},
    Row{CGNS_ENUMV(TRI_15), Shape::triangle, 4},
    Row{CGNS_ENUMV(QUAD_4), Shape::quadrilateral, 1},
    Row{CGNS_ENUMV(QUAD_9), Shape::quadrilateral, 2},
    Row{CGNS_ENUMV(QUAD_16), Shape::quadrilateral, 3},
    Row{CGNS_ENUMV(QUAD_25), Shape::quadrilateral, 4},
    Row{CGNS_ENUMV(TETRA_4), Shape::tetrahedron, 1},
    Row{CGNS_ENUMV(TETRA_10), Shape::tetrahedron, 2},
    Row{CGNS_ENUMV(TETRA_20), Shape::tetrahedron, 3},
    Row{CGNS_ENUMV(TETRA_35), Shape::tetrahedron, 4},
    Row{CGNS_ENUMV(PYRA_5), Shape::pyramid, 1},
    Row{CGNS_ENUMV(PYRA_14), Shape::pyramid, 2},
    Row{CGNS_ENUMV(PYRA_30), Shape::pyramid, 3},
    Row{CGNS_ENUMV(PYRA_55), Shape::pyramid, 4},
    Row{CGNS_ENUMV(PENTA_6), Shape::prism, 1},
    Row{CGNS_ENUMV(PENTA_18), Shape::prism, 2},
    Row{CGNS_ENUMV(PENTA_40), Shape::prism, 3},
    Row{CGNS_ENUMV(PENTA_75), Shape::prism, 4},
    Row{CGNS_ENUMV(HEXA_8), Shape::hexahedron, 1},
    Row{CGNS_ENUMV(HEXA_27), Shape::hexahedron, 2},
    Row{CGNS_ENUMV(HEXA_64), Shape::hexahedron, 3},
    Row{CGNS_ENUMV(HEXA_125), Shape::hexahedron, 4},
};

}  // namespace

std::optional<ElementType> element_type(CGNS_ENUMT(ElementType_t) type) {
  for (const Row& row : k_types) {
    if (row.type == type) return ElementType{row.shape, row.order};
  }
  return std::nullopt;
}

CGNS_ENUMT(ElementType_t) cgns_type(Shape shape, int order) {
  for (const Row& row : k_types) {
    if (row.shape == shape && row.order == order) return row.type;
  }
  throw std::invalid_argument("CGNS has no such element");
}

std::mutex& library_mutex() { return hdf5_mutex(); }

File::File(const std::string& path, int mode, std::string display) : display_(std::move(display)) {
  require(cg_open(path.c_str(), mode, &number_),
          mode == CG_MODE_READ ? "cannot be read as CGNS" : "cannot be written");
  is_open_ = true;
}

File::~File() {
  if (is_open_) cg_close(number_);
}

void File::require(int status, const std::string& what) const {
  if (status == CG_OK) return;
  throw FileError(what + ": the CGNS library says '" + cg_get_error() + "'", display_,
                  "check the file with cgnscheck, and that the disk is not full");
}

void File::close() {
  is_open_ = false;
  require(cg_close(number_), "cannot be completed");
}

}  // namespace camber::io::cgns
