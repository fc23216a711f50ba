#pragma once
// Bodies made with the kernel's own primitives, written to a file and read back by the code under
// test.
#include <camber/geom/geometry_model.hpp>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

namespace camber::test {

/// A path in the test's temporary folder that no other test uses.
std::string temporary_path(const std::string& name);

/// Writes by extension: .step, .iges or .brep.
void write_shape(const TopoDS_Shape& shape, const std::string& path);

/// Writes and reads back.
std::unique_ptr<GeometryModel> round_trip(const TopoDS_Shape& shape,
                                          const std::string& extension = ".brep");

TopoDS_Shape sphere(double radius);
TopoDS_Shape cylinder(double radius, double height);
/// Base circle of `radius` at z = 0, tip at z = height.
TopoDS_Shape cone(double radius, double height);
TopoDS_Shape torus(double major, double minor);
TopoDS_Shape box(double x, double y, double z);
/// Box (0, 0, 0) - (4, 4, 1) with a hole of radius 1 around (2, 2).
TopoDS_Shape drilled_plate();
/// Cylinder of radius 1 along z, |z| <= 2, with a hole of radius 0.4 along x through both sides.
TopoDS_Shape drilled_cylinder();
/// One face: a wavy B-spline surface of degree 3 over about (0, 0) - (3, 2).
TopoDS_Shape wavy_face();
/// That face without the disc of radius 0.6 around (1.5, 1).
TopoDS_Shape wavy_face_with_hole();

/// Points in the box enlarged by a quarter on each side.
std::vector<Vec3> random_points(const Box& box, int count, unsigned seed = 1);

/// Tags of the faces on which is_planar is as asked.
std::vector<int> faces(const GeometryModel& model, bool is_planar);

}  // namespace camber::test
