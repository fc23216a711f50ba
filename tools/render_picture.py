#!/usr/bin/python3
"""Linear mesh beside curved mesh, coloured by order: docs/images/wing.png (needs python3-vtk9, xvfb).

usage: xvfb-run -a tools/render_picture.py LINEAR.vtu CURVED.vtu OUT.png
           [--keep XMIN XMAX YMIN YMAX ZMIN ZMAX] [--from X Y Z] [--to X Y Z] [--height H]

Shown are the layer cells (prisms, hexes) whose corner centre lies in the --keep box, seen along --from
--to with a parallel projection of the given height. Curved surfaces and edges are drawn from the polynomials.
"""
import argparse

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

# Nodes of the full Lagrange cell of order p, by VTK cell type; linear types have order 1.
NODES = {vtk.VTK_LAGRANGE_TETRAHEDRON: lambda p: (p + 1) * (p + 2) * (p + 3) // 6,
         vtk.VTK_LAGRANGE_WEDGE: lambda p: (p + 1) ** 2 * (p + 2) // 2,
         vtk.VTK_LAGRANGE_HEXAHEDRON: lambda p: (p + 1) ** 3}
COLOURS = [(0.87, 0.88, 0.90), (0.55, 0.72, 0.86), (0.98, 0.75, 0.40), (0.86, 0.38, 0.32)]
SUBDIVISION = 4
CORNERS = {9: 6, 12: 8}  # of a prism, hex by its number of edges


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def cell_orders(grid):
    """The file's field "order" where it has one, else from the node counts."""
    field = grid.GetCellData().GetArray("order")
    if field:
        return vtk_to_numpy(field).astype(int)
    orders = np.ones(grid.GetNumberOfCells(), int)
    for c in range(grid.GetNumberOfCells()):
        count = NODES.get(grid.GetCellType(c))
        if count:
            n = grid.GetCell(c).GetNumberOfPoints()
            orders[c] = next(p for p in range(1, 8) if count(p) == n)
    return orders


def kept_cells(grid, box):
    """Prisms and hexes with the centre of their corners inside the box."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    low, high = np.array(box).reshape(3, 2).T
    keep = []
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        if cell.GetCellDimension() == 3:
            n = CORNERS.get(cell.GetNumberOfEdges(), 0)
            if not n:
                continue
            centre = points[[cell.GetPointId(i) for i in range(n)]].mean(axis=0)
            if (low <= centre).all() and (centre <= high).all():
                keep.append(c)
    assert keep, "no cell lies in the --keep box"
    ids = vtk.vtkIdTypeArray()
    for c in keep:
        ids.InsertNextValue(c)
    return ids


def extract(grid, ids):
    node = vtk.vtkSelectionNode()
    node.SetFieldType(vtk.vtkSelectionNode.CELL)
    node.SetContentType(vtk.vtkSelectionNode.INDICES)
    node.SetSelectionList(ids)
    selection = vtk.vtkSelection()
    selection.AddNode(node)
    pick = vtk.vtkExtractSelection()
    pick.SetInputData(0, grid)
    pick.SetInputData(1, selection)
    pick.Update()
    return pick.GetOutput()


def edge_lines(grid):
    """Every cell edge once, drawn as its polynomial through equidistant nodes."""
    points, lines, seen = vtk.vtkPoints(), vtk.vtkCellArray(), set()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        for e in range(cell.GetNumberOfEdges()):
            edge = cell.GetEdge(e)
            ids = [edge.GetPointId(i) for i in range(edge.GetNumberOfPoints())]
            key = tuple(sorted(ids))
            if key in seen:
                continue
            seen.add(key)
            x = np.array([grid.GetPoint(i) for i in [ids[0], *ids[2:], ids[1]]])
            nodes, t = np.linspace(0, 1, len(x)), np.linspace(0, 1, 2 if len(x) == 2 else 17)
            weights = np.linalg.solve(np.vander(nodes).T, np.vander(t, len(x)).T).T
            first = [points.InsertNextPoint(p) for p in weights @ x]
            lines.InsertNextCell(len(first), first)
    out = vtk.vtkPolyData()
    out.SetPoints(points)
    out.SetLines(lines)
    return out


def actor_of(data, colour_by_order):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if colour_by_order:
        table = vtk.vtkLookupTable()
        table.SetNumberOfTableValues(4)
        for i, colour in enumerate(COLOURS):
            table.SetTableValue(i, *colour)
        mapper.SetLookupTable(table)
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("drawn order")
        mapper.SetScalarRange(0.5, 4.5)
        actor.GetProperty().SetAmbient(0.45)
        actor.GetProperty().SetDiffuse(0.6)
    else:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(0.12, 0.14, 0.18)
        actor.GetProperty().SetLineWidth(1.4)
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0, -40)
    return actor


def scene(path, box, title):
    """A renderer of the kept cells; returns it and the orders that occur."""
    grid = read(path)
    orders = cell_orders(grid)
    array = numpy_to_vtk(orders.astype(float), deep=True)
    array.SetName("drawn order")
    grid.GetCellData().AddArray(array)
    part = extract(grid, kept_cells(grid, box))
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(part)
    surface.SetNonlinearSubdivisionLevel(SUBDIVISION)
    surface.Update()
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(surface.GetOutput())
    normals.SetFeatureAngle(25)
    normals.Update()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor_of(normals.GetOutput(), True))
    renderer.AddActor(actor_of(edge_lines(part), False))
    renderer.AddActor2D(label(f"  {title}  ", 0.5, 0.92, 26))
    return renderer, sorted(set(orders))


def label(text, x, y, size, background=(1, 1, 1)):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontSize(size)
    style.SetColor(0.1, 0.1, 0.12)
    style.SetBackgroundColor(*background)
    style.SetBackgroundOpacity(1.0)
    style.SetJustificationToCentered()
    return actor


def add_legend(renderer, orders):
    for k, order in enumerate(orders):
        x = 0.5 + 0.1 * (k - (len(orders) - 1) / 2)
        renderer.AddActor2D(label(f"  Q{order}  ", x, 0.03, 24, COLOURS[order - 1]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("linear")
    parser.add_argument("curved")
    parser.add_argument("out")
    parser.add_argument("--keep", type=float, nargs=6, default=[-9, 9, 0.62, 9, -9, 9])
    parser.add_argument("--from", dest="eye", type=float, nargs=3, default=[-0.9, -1.6, 0.7])
    parser.add_argument("--to", dest="focus", type=float, nargs=3, default=[0.48, 0.65, 0.0])
    parser.add_argument("--height", type=float, default=0.3)
    a = parser.parse_args()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1400, 640)
    for k, (path, title) in enumerate(((a.linear, "linear"), (a.curved, "curved, mixed order"))):
        renderer, orders = scene(path, a.keep, title)
        renderer.SetViewport(k / 2, 0, (k + 1) / 2, 1)
        camera = renderer.GetActiveCamera()
        camera.SetPosition(*a.eye)
        camera.SetFocalPoint(*a.focus)
        camera.SetViewUp(0, 0, 1)
        camera.ParallelProjectionOn()
        camera.SetParallelScale(a.height / 2)
        renderer.ResetCameraClippingRange()
        add_legend(renderer, orders)
        window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(a.out)
    writer.SetCompressionLevel(9)
    writer.Write()


main()
