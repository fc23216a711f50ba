#include "sample_bodies.hpp"

#include <camber/geom_occ/cad_file.hpp>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax2.hxx>

namespace camber::test {

std::string temporary_path(const std::string& name) {
  static int count = 0;
  return testing::TempDir() + "camber_" + std::to_string(getpid()) + "_" + std::to_string(++count) +
         name;
}

void write_shape(const TopoDS_Shape& shape, const std::string& path) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const std::string extension = std::filesystem::path(path).extension().string();
  bool is_written = false;
  if (extension == ".step") {
    STEPControl_Writer writer;
    writer.Transfer(shape, STEPControl_AsIs);
    is_written = writer.Write(path.c_str()) == IFSelect_RetDone;
  } else if (extension == ".iges") {
    IGESControl_Writer writer("MM", 1);  // 1: boundary representation with solids
    writer.AddShape(shape);
    is_written = writer.Write(path.c_str());
  } else {
    is_written = BRepTools::Write(shape, path.c_str());
  }
  if (!is_written) throw std::runtime_error("cannot write " + path);
}

std::unique_ptr<GeometryModel> round_trip(const TopoDS_Shape& shape, const std::string& extension) {
  const std::string path = temporary_path("body" + extension);
  write_shape(shape, path);
  auto model = read_cad(path);
  std::filesystem::remove(path);
  return model;
}

TopoDS_Shape sphere(double radius) { return BRepPrimAPI_MakeSphere(radius).Shape(); }

TopoDS_Shape cylinder(double radius, double height) {
  return BRepPrimAPI_MakeCylinder(radius, height).Shape();
}

TopoDS_Shape cone(double radius, double height) {
  return BRepPrimAPI_MakeCone(radius, 0.0, height).Shape();
}

TopoDS_Shape torus(double major, double minor) {
  return BRepPrimAPI_MakeTorus(major, minor).Shape();
}

TopoDS_Shape box(double x, double y, double z) { return BRepPrimAPI_MakeBox(x, y, z).Shape(); }

TopoDS_Shape drilled_plate() {
  const gp_Ax2 axis(gp_Pnt(2, 2, -1), gp_Dir(0, 0, 1));
  return BRepAlgoAPI_Cut(box(4, 4, 1), BRepPrimAPI_MakeCylinder(axis, 1, 3).Shape()).Shape();
}

TopoDS_Shape drilled_cylinder() {
  const gp_Ax2 body(gp_Pnt(0, 0, -2), gp_Dir(0, 0, 1)), hole(gp_Pnt(-3, 0, 0), gp_Dir(1, 0, 0));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(body, 1, 4).Shape(),
                         BRepPrimAPI_MakeCylinder(hole, 0.4, 6).Shape())
      .Shape();
}

TopoDS_Shape wavy_face() {
  TColgp_Array2OfPnt points(1, 13, 1, 9);
  for (int i = 1; i <= 13; ++i)
    for (int j = 1; j <= 9; ++j)
      points(i, j) =
          gp_Pnt(0.25 * (i - 1), 0.25 * (j - 1), 0.3 * std::sin(0.7 * i) * std::cos(0.6 * j));
  GeomAPI_PointsToBSplineSurface fit;
  fit.Interpolate(points);
  const Handle(Geom_BSplineSurface) surface = fit.Surface();
  return BRepBuilderAPI_MakeFace(surface, 1e-7).Shape();
}

TopoDS_Shape wavy_face_with_hole() {
  const gp_Ax2 axis(gp_Pnt(1.5, 1, -2), gp_Dir(0, 0, 1));
  return BRepAlgoAPI_Cut(wavy_face(), BRepPrimAPI_MakeCylinder(axis, 0.6, 4).Shape()).Shape();
}

std::vector<Vec3> random_points(const Box& box, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.25, 1.25);
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) {
    const double u = uniform(random), v = uniform(random), w = uniform(random);
    result.push_back(box.lower + Vec3(u, v, w).cwiseProduct(box.upper - box.lower));
  }
  return result;
}

std::vector<int> faces(const GeometryModel& model, bool is_planar) {
  std::vector<int> result;
  for (int tag = 1; tag <= model.count(2); ++tag)
    if (model.is_planar(tag) == is_planar) result.push_back(tag);
  return result;
}

}  // namespace camber::test
