"""Lets Gmsh raise the order of a linear mesh.

usage: elevate_with_gmsh.py IN.msh ORDER OUT.msh
Ends with 77 if gmsh is not installed.
"""
import sys

try:
    import gmsh
except ImportError:
    sys.exit(77)

gmsh.initialize()
gmsh.option.setNumber('General.Terminal', 0)
gmsh.option.setNumber('Mesh.SaveAll', 1)
gmsh.option.setNumber('Mesh.Binary', 1)
gmsh.open(sys.argv[1])
gmsh.model.mesh.setOrder(int(sys.argv[2]))
gmsh.write(sys.argv[3])
gmsh.finalize()
