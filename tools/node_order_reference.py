#!/usr/bin/env python3
"""Node orders as Gmsh and VTK themselves have them, for tests/basis/data/node_order_reference.txt.

Needs the Python modules of Gmsh (4.8 or later) and VTK (9.1 or later; not 9.0 and before, whose
hexahedron differs). A line is: convention, shape, order, then the lattice point (i j k, one digit
each) of every node. Gmsh: a linear element is raised by Mesh.setOrder and its nodes are read. VTK:
the node at a lattice point is the one whose weight is 1 there. Camber's own code is not involved.
"""
import sys

import gmsh
import vtk

CORNERS = {
    "line": [(0, 0, 0), (1, 0, 0)],
    "tri": [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
    "quad": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
    "tet": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "pyramid": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)],
    "prism": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    "hex": [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))],
}
DIMENSION = {"line": 1, "tri": 2, "quad": 2, "tet": 3, "pyramid": 3, "prism": 3, "hex": 3}
GMSH_LINEAR = {"line": 1, "tri": 2, "quad": 3, "tet": 4, "pyramid": 7, "prism": 6, "hex": 5}
VTK_CELLS = {
    "line": vtk.vtkLagrangeCurve,
    "tri": vtk.vtkLagrangeTriangle,
    "quad": vtk.vtkLagrangeQuadrilateral,
    "tet": vtk.vtkLagrangeTetra,
    "prism": vtk.vtkLagrangeWedge,
    "hex": vtk.vtkLagrangeHexahedron,
}


def lattice(shape, p):
    for k in range(p + 1 if DIMENSION[shape] == 3 else 1):
        for j in range(p + 1 if DIMENSION[shape] >= 2 else 1):
            for i in range(p + 1):
                if shape == "tri" and i + j > p or shape == "prism" and i + j > p:
                    continue
                if shape == "tet" and i + j + k > p:
                    continue
                yield i, j, k


def gmsh_order(shape, p):
    gmsh.clear()
    gmsh.model.add(shape)
    dim = DIMENSION[shape]
    corners = CORNERS[shape]
    gmsh.model.addDiscreteEntity(dim, 1)
    tags = list(range(1, len(corners) + 1))
    gmsh.model.mesh.addNodes(dim, 1, tags, [float(x) for corner in corners for x in corner])
    gmsh.model.mesh.addElementsByType(1, GMSH_LINEAR[shape], [1], tags)
    gmsh.model.mesh.setOrder(p)
    tags, flat, _ = gmsh.model.mesh.getNodes()
    place = {tag: flat[3 * n : 3 * n + 3] for n, tag in enumerate(tags)}
    nodes = gmsh.model.mesh.getElements(dim, 1)[2][0]
    points = [[p * x for x in place[tag]] for tag in nodes]
    assert all(abs(x - round(x)) < 1e-9 for point in points for x in point)
    return [tuple(round(x) for x in point) for point in points]


def vtk_order(shape, p):
    points = list(lattice(shape, p))
    cell = VTK_CELLS[shape]()
    cell.GetPointIds().SetNumberOfIds(len(points))
    cell.GetPoints().SetNumberOfPoints(len(points))
    cell.Initialize()
    if hasattr(cell, "SetUniformOrderFromNumPoints"):
        cell.SetUniformOrderFromNumPoints(len(points))
    order = [None] * len(points)
    for point in points:
        weights = [0.0] * len(points)
        xi = [x / p for x in point]
        cell.EvaluateLocation(vtk.reference(0), xi, [0.0, 0.0, 0.0], weights)
        node = max(range(len(points)), key=lambda n: weights[n])
        assert abs(weights[node] - 1) < 1e-9 and order[node] is None
        order[node] = point
    return order


def main():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for convention, of, shapes, orders in (
        ("gmsh", gmsh_order, CORNERS, range(1, 5)),
        ("vtk", vtk_order, VTK_CELLS, range(1, 7)),
    ):
        for shape in shapes:
            for p in orders:
                points = ["%d%d%d" % point for point in of(shape, p)]
                print(convention, shape, p, *points)
    gmsh.finalize()


if __name__ == "__main__":
    sys.exit(main())
