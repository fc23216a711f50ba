#pragma once
// Numbers and names of the keywords of libMeshb (its header, version 7).
#include <camber/basis/shape.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace camber::io::meshb {

enum class Task {
  vertices,
  elements,
  on_geometry,  // a vertex and the number of a CAD entity
  refused,      // shapes that would be lost
  end,
  skipped,
};

struct Keyword {
  int code;
  std::string_view name;
  Task task;
  Shape shape = Shape::point;  // of elements
  int dim = 0;                 // on_geometry: of the CAD entity, which is also the count of
                               // parameters; a distance follows if there are any
};

inline constexpr std::array k_keywords{
    Keyword{4, "Vertices", Task::vertices},
    Keyword{5, "Edges", Task::elements, Shape::line},
    Keyword{6, "Triangles", Task::elements, Shape::triangle},
    Keyword{7, "Quadrilaterals", Task::elements, Shape::quadrilateral},
    Keyword{8, "Tetrahedra", Task::elements, Shape::tetrahedron},
    Keyword{9, "Prisms", Task::elements, Shape::prism},
    Keyword{10, "Hexahedra", Task::elements, Shape::hexahedron},
    Keyword{49, "Pyramids", Task::elements, Shape::pyramid},
    Keyword{40, "VerticesOnGeometricVertices", Task::on_geometry, Shape::point, 0},
    Keyword{41, "VerticesOnGeometricEdges", Task::on_geometry, Shape::point, 1},
    Keyword{42, "VerticesOnGeometricTriangles", Task::on_geometry, Shape::point, 2},
    Keyword{43, "VerticesOnGeometricQuadrilaterals", Task::on_geometry, Shape::point, 2},
    Keyword{24, "TrianglesP2", Task::refused},
    Keyword{25, "EdgesP2", Task::skipped},
    Keyword{27, "QuadrilateralsQ2", Task::refused},
    Keyword{30, "TetrahedraP2", Task::refused},
    Keyword{33, "HexahedraQ2", Task::refused},
    Keyword{46, "Polyhedra", Task::refused},
    Keyword{86, "PrismsP2", Task::refused},
    Keyword{87, "PyramidsP2", Task::refused},
    Keyword{88, "QuadrilateralsQ3", Task::refused},
    Keyword{89, "QuadrilateralsQ4", Task::refused},
    Keyword{90, "TrianglesP3", Task::refused},
    Keyword{91, "TrianglesP4", Task::refused},
    Keyword{96, "TetrahedraP3", Task::refused},
    Keyword{97, "TetrahedraP4", Task::refused},
    Keyword{98, "HexahedraQ3", Task::refused},
    Keyword{99, "HexahedraQ4", Task::refused},
    Keyword{100, "PyramidsP3", Task::refused},
    Keyword{101, "PyramidsP4", Task::refused},
    Keyword{102, "PrismsP3", Task::refused},
    Keyword{103, "PrismsP4", Task::refused},
    Keyword{13, "Corners", Task::skipped},
    Keyword{14, "Ridges", Task::skipped},
    Keyword{15, "RequiredVertices", Task::skipped},
    Keyword{16, "RequiredEdges", Task::skipped},
    Keyword{17, "RequiredTriangles", Task::skipped},
    Keyword{18, "RequiredQuadrilaterals", Task::skipped},
    Keyword{20, "NormalAtVertices", Task::skipped},
    Keyword{44, "EdgesOnGeometricEdges", Task::skipped},
    Keyword{54, "End", Task::end},
    Keyword{59, "Tangents", Task::skipped},
    Keyword{60, "Normals", Task::skipped},
    Keyword{126, "ByteFlow", Task::skipped},
};

/// The keyword of that number, or of that name.
[[nodiscard]] inline std::optional<Keyword> keyword(std::int64_t code) {
  for (const Keyword& known : k_keywords) {
    if (known.code == code) return known;
  }
  return std::nullopt;
}
[[nodiscard]] inline std::optional<Keyword> keyword(std::string_view name) {
  for (const Keyword& known : k_keywords) {
    if (known.name == name) return known;
  }
  return std::nullopt;
}

}  // namespace camber::io::meshb
