#!/usr/bin/python3
"""Curves a bundled case straight into a .vtu file and opens it with VTK.

usage: open_in_vtk.py CAMBER CASE_FOLDER OUT.vtu

Checked: cell arrays have different names (VTK 9.1 dies of two equal ones), every cell is there, and the file's
own order agrees with the number of nodes of each prism and tet. Exit code 77: VTK is not installed.
"""
import pathlib
import re
import subprocess
import sys

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("python3-vtk9 or python3-numpy is not installed")
    sys.exit(77)

LINEAR = {vtk.VTK_TETRA: 4, vtk.VTK_WEDGE: 6}
NODES = {vtk.VTK_LAGRANGE_TETRAHEDRON: lambda p: (p + 1) * (p + 2) * (p + 3) // 6,
         vtk.VTK_LAGRANGE_WEDGE: lambda p: (p + 1) ** 2 * (p + 2) // 2}


def main():
    camber, case, out = sys.argv[1:]
    case = pathlib.Path(case)
    subprocess.run([camber, "curve", str(case / "linear.msh"), "--geometry", str(case / "body.step"),
                    "--deviation", "0.001", "-q", "-o", out], check=True)
    header = pathlib.Path(out).read_bytes().split(b"<AppendedData")[0].decode()
    names = re.findall(r'Name="([^"]+)"', header)
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        sys.exit(f"array names that occur twice: {twice}")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(out)
    reader.Update()
    grid = reader.GetOutput()
    orders = vtk_to_numpy(grid.GetCellData().GetArray("order"))
    for cell, order in enumerate(orders):
        kind, count = grid.GetCellType(cell), grid.GetCell(cell).GetNumberOfPoints()
        expected = LINEAR.get(kind, NODES[kind](int(order)) if kind in NODES else count)
        if count != expected:
            sys.exit(f"cell {cell} of order {order} has {count} nodes, not {expected}")
    if not np.any(orders > 1):
        sys.exit("every cell is linear")
    print(f"{grid.GetNumberOfCells()} cells, orders {sorted(set(orders.tolist()))}, arrays {names}")


main()
