#include <camber/base/error.hpp>
#include <camber/geom_occ/cad_file.hpp>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pln.hxx>
#include <gp_Pnt.hxx>

#include "sample_bodies.hpp"

namespace camber {
namespace {

using test::temporary_path;
using test::write_shape;

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string write_text(const std::string& name, const std::string& text) {
  const std::string path = temporary_path(name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string message_of(const std::string& path) {
  try {
    static_cast<void>(read_cad(path));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ReadCad, ReadsAllThreeFormatsToTheSameNumbers) {
  const TopoDS_Shape body = test::drilled_plate();
  for (const char* extension : {".step", ".iges", ".brep"}) {
    const auto model = test::round_trip(body, extension);
    EXPECT_EQ(model->count(2), 7) << extension;
    EXPECT_EQ(model->count(1), 15) << extension;
    EXPECT_EQ(model->count(0), 10) << extension;
    EXPECT_NEAR(model->box().diagonal(), std::sqrt(33.0), 1e-6) << extension;
  }
}

TEST(ReadCad, IgnoresTheCaseOfTheExtension) {
  const std::string path = temporary_path("body.brep");
  write_shape(test::sphere(1), path);
  const std::string upper = path.substr(0, path.size() - 4) + "BREP";
  std::filesystem::rename(path, upper);
  EXPECT_EQ(read_cad(upper)->count(2), 1);
  std::filesystem::remove(upper);
}

TEST(ReadCad, NumbersSolidsBeforeFreeFaces) {
  // A free face is stored before the solid: plain exploring would give it tag 1.
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  builder.Add(
      compound,
      BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 9), gp_Dir(0, 0, 1)), 0, 1, 0, 1).Shape());
  builder.Add(compound, test::box(1, 2, 3));
  const auto model = test::round_trip(compound);
  ASSERT_EQ(model->count(2), 7);
  EXPECT_NEAR(model->box({2, 7}).lower[2], 9.0, 1e-6);
  for (int f = 1; f <= 6; ++f) EXPECT_LT(model->box({2, f}).upper[2], 3.1);
}

TEST(ReadCad, FindsTheNamesOfStepFaces) {
  const std::string path = temporary_path("named.step");
  write_shape(test::box(1, 2, 3), path);
  std::string text = read_text(path);
  const std::string face = "ADVANCED_FACE(''";
  const std::size_t second = text.find(face, text.find(face) + 1);
  ASSERT_NE(second, std::string::npos);
  text.replace(second, face.size(), "ADVANCED_FACE('wing upper'");
  std::ofstream(path, std::ios::binary) << text;

  const auto model = read_cad(path);
  std::filesystem::remove(path);
  std::vector<std::string> names;
  for (int f = 1; f <= 6; ++f) names.push_back(model->name({2, f}));
  EXPECT_EQ(names, (std::vector<std::string>{"", "wing upper", "", "", "", ""}));
  EXPECT_EQ(model->name({1, 1}), "");
}

TEST(ReadCad, ReadsLengthsAsMillimetres) {
  const std::string path = temporary_path("inch.step");
  write_shape(test::box(1, 1, 1), path);
  std::string text = read_text(path);
  const std::string unit = "SI_UNIT(.MILLI.,.METRE.)";
  const std::size_t at = text.find(unit);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, unit.size(), "SI_UNIT($,.METRE.)");  // the same numbers, now metres
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_NEAR(read_cad(path)->box().diagonal(), 1000.0 * std::sqrt(3.0), 1e-3);
  std::filesystem::remove(path);
}

TEST(ReadCad, RefusesWhatIsNotThere) {
  EXPECT_THROW(static_cast<void>(read_cad("/nowhere/body.step")), FileError);
  EXPECT_THROW(static_cast<void>(read_cad("/nowhere/body.brep")), FileError);
  EXPECT_NE(message_of("/nowhere/body.step").find("/nowhere/body.step"), std::string::npos);
  const std::string folder = temporary_path("folder.step");
  std::filesystem::create_directory(folder);
  EXPECT_THROW(static_cast<void>(read_cad(folder)), FileError);
  std::filesystem::remove(folder);
}

TEST(ReadCad, RefusesAnUnknownExtension) {
  const std::string path = write_text("body.stl", "solid");
  EXPECT_THROW(static_cast<void>(read_cad(path)), FileError);
  EXPECT_NE(message_of(path).find(".stl"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(ReadCad, RefusesGarbageAndEmptyFiles) {
  for (const char* extension : {".step", ".iges", ".brep"}) {
    for (const std::string& text :
         {std::string(), std::string("not a CAD file\n"), std::string(3000, '\xff')}) {
      const std::string path = write_text(std::string("garbage") + extension, text);
      EXPECT_THROW(static_cast<void>(read_cad(path)), FileError) << path << " " << text.size();
      std::filesystem::remove(path);
    }
  }
  const std::string closed = write_text("fake.step", "ISO-10303-21;\nHEADER;\nEND-ISO-10303-21;\n");
  EXPECT_THROW(static_cast<void>(read_cad(closed)), Error);
  std::filesystem::remove(closed);
}

TEST(ReadCad, RefusesFilesCutShort) {
  for (const char* extension : {".step", ".iges", ".brep"}) {
    const std::string path = temporary_path(std::string("cut") + extension);
    write_shape(test::drilled_plate(), path);
    const std::string text = read_text(path);
    for (const double part : {0.3, 0.7, 0.95}) {
      const auto length = static_cast<std::size_t>(part * static_cast<double>(text.size()));
      std::ofstream(path, std::ios::binary) << text.substr(0, length);
      EXPECT_THROW(static_cast<void>(read_cad(path)), Error) << extension << " " << part;
    }
    std::filesystem::remove(path);
  }
}

TEST(ReadCad, RefusesAModelWithoutFaces) {
  for (const char* extension : {".step", ".brep"}) {
    const std::string path = temporary_path(std::string("edge") + extension);
    write_shape(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape(), path);
    EXPECT_THROW(static_cast<void>(read_cad(path)), GeometryError) << extension;
    std::filesystem::remove(path);
  }
}

TEST(OccModel, RefusesEntitiesThatDoNotExist) {
  const auto model = test::round_trip(test::box(1, 1, 1));
  const auto projector = model->projector();
  EXPECT_THROW(static_cast<void>(projector->closest({2, 7}, Vec3::Zero())), GeometryError);
  EXPECT_THROW(static_cast<void>(projector->closest({3, 1}, Vec3::Zero())), GeometryError);
  EXPECT_THROW(static_cast<void>(projector->along_line(0, Vec3::Zero(), Vec3::UnitX(), 1.0)),
               GeometryError);
  EXPECT_THROW(static_cast<void>(model->range(13)), GeometryError);
  EXPECT_THROW(static_cast<void>(model->name({0, 9})), GeometryError);
}

TEST(OccModel, NamesAFaceThatHasNoBorderAtEveryQuestion) {
  const auto model = test::round_trip(BRepBuilderAPI_MakeFace(gp_Pln()).Shape());
  const auto projector = model->projector();
  for (int i = 0; i < 2; ++i)
    EXPECT_THROW(static_cast<void>(projector->closest({2, 1}, Vec3::Zero())), GeometryError);
}

}  // namespace
}  // namespace camber
