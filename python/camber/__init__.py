"""Camber curves linear hybrid meshes onto their CAD: mixed orders, every cell certified.

    import camber
    mesh = camber.read("wing.msh")
    geometry = camber.Geometry("wing.step")
    result = camber.curve(mesh, geometry, order=4)
    result.write("wing_curved.msh")
    print(result.report())
"""
from ._camber import __version__
from ._errors import Error, FileError, GeometryError, MeshError, OptionError
from ._mesh import Block, Mesh, block, read
from ._runs import Geometry, Report, Result, check, curve, page

__all__ = [
    "Block", "Error", "FileError", "Geometry", "GeometryError", "Mesh", "MeshError", "OptionError",
    "Report", "Result", "__version__", "block", "check", "curve", "page", "read"]
