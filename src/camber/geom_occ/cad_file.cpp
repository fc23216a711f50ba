#include <camber/base/error.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/geom_occ/detail/kernel_errors.hpp>
#include <camber/geom_occ/detail/occ_model.hpp>

namespace camber {

std::unique_ptr<GeometryModel> read_cad(const std::string& path) {
  const occ::ShapeFile file = occ::read_shape_file(path);
  return occ::guarded(path, [&]() -> std::unique_ptr<GeometryModel> {
    auto model = file.shape.IsNull() ? nullptr : std::make_unique<occ::OccModel>(file);
    if (!model || model->count(2) == 0)
      throw GeometryError("the CAD file holds no faces", path,
                          "export the surfaces or solids that the mesh was made on");
    return model;
  });
}

}  // namespace camber
