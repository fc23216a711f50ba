"""CAD, curving and checking."""
from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _camber
from ._errors import MeshError
from ._mesh import Mesh, Path, native

ProgressCallback = Callable[[str, float], object]


class Geometry:
    """The CAD of a .step, .stp, .iges, .igs or .brep file. Entities are numbered as Gmsh does.

    Without CAD: a finer surface mesh (.stl, .msh), or an analytic surface: "sphere:x,y,z,r",
    "ellipsoid:x,y,z,a,b,c", "cylinder:x,y,z,dx,dy,dz,r", "torus:x,y,z,dx,dy,dz,R,r".

    Raises:
        FileError: missing or unreadable.
        GeometryError: without faces.
    """

    def __init__(self, path: Path) -> None:
        self._model = _camber.GeometryModel(os.fspath(path))

    @property
    def path(self) -> str:
        return self._model.path

    def count(self, dim: int) -> int:
        """Vertices (0), curves (1) or faces (2)."""
        return self._model.count(dim)

    def name(self, dim: int, tag: int) -> str:
        """Name that the file gives the entity, "" if none."""
        return self._model.name(dim, tag)

    def __repr__(self) -> str:
        return f"<camber.Geometry {self.path!r}: {self.count(2)} faces, {self.count(1)} curves>"


class Report:
    """What a run found and did. print(report) is the text that the command line prints."""

    def __init__(self, report: _camber.Report) -> None:
        self._report = report

    @property
    def status(self) -> str:
        """ "ok", or what is short of it: see docs/report."""
        return self._report.status

    @property
    def ok(self) -> bool:
        """The exit code of the command line would be 0."""
        return self._report.exit_code == 0

    @property
    def data(self) -> Dict[str, Any]:
        """Everything, with the keys of docs/report (those of --json)."""
        data: Dict[str, Any] = json.loads(self._report.json())
        return data

    def __str__(self) -> str:
        return self._report.text()

    __repr__ = __str__


class Result:
    """A curved mesh and what is known of it. Arrays look at Camber's memory, without a copy, and
    are read-only; they keep the result alive."""

    def __init__(self, run: _camber.Run) -> None:
        self._run = run
        self._mesh: Optional[Mesh] = None

    @property
    def is_certified(self) -> bool:
        """Every cell is proved valid."""
        return self._run.is_certified

    @property
    def mesh(self) -> Mesh:
        """The curved mesh as it is written, with its element fields; made at the first use."""
        if self._mesh is None:
            self._mesh = Mesh._of(self._run.exported())
        return self._mesh

    @property
    def nodes(self) -> npt.NDArray[np.float64]:
        """(n, 3): nodes above order 1: those of edges, then of faces, then of cells."""
        return self._run.high_order_nodes

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """(n, 3): corners of the cells, where the linear mesh has them."""
        return self._run.vertices

    @property
    def orders(self) -> npt.NDArray[np.uint8]:
        """Order of every cell, 1 to 4."""
        return self._run.cell_orders

    @property
    def cells(self) -> npt.NDArray[np.int64]:
        """Number of every cell in the file of the linear mesh."""
        return self._run.cell_tags

    @property
    def certificates(self) -> npt.NDArray[np.float64]:
        """Proved lower bound of the scaled Jacobian of every cell: valid where positive."""
        return self._run.cell_bounds

    @property
    def costs(self) -> npt.NDArray[np.float64]:
        """Cost C of every cell, 1 is the straight cell: see docs/theory."""
        return self._run.cell_costs

    @property
    def deviations(self) -> npt.NDArray[np.float64]:
        """Largest Gauss-point distance to the CAD of every face of the mesh; NaN off the CAD."""
        return self._run.face_deviations

    def report(self) -> Report:
        """What the run found and did."""
        return Report(self._run.report)

    def write(self, path: Path, *, ascii: bool = False, allow_invalid: bool = False) -> None:
        """Writes .msh or .vtu. The file is replaced only when what was written has been read back
        and every element has been certified again (.vtu: compared byte by byte).

        Raises:
            MeshError: not every cell is certified and allow_invalid is false.
            FileError: the file cannot be written.
        """
        if not (self.is_certified or allow_invalid):
            validity = self.report().data["validity"]
            raise MeshError(
                f"{validity['invalid']} cells are invalid and {validity['undecided']} undecided, "
                "nothing was written", os.fspath(path),
                "see report() for where; allow_invalid=True writes all the same")
        native(self.mesh).write(os.fspath(path), ascii, self.is_certified)

    def write_page(self, path: Path) -> None:
        """Writes one HTML file to look at the result: the curved mesh with orders, bounds, costs
        and deviations, and the report; see docs/page. Written even if not every cell is certified.
        Takes turns with other runs on the same Geometry.

        Raises:
            FileError: the file cannot be written; an old one stays.
        """
        _camber.write_run_page(self._run, os.fspath(path))

    def __repr__(self) -> str:
        state = "certified" if self.is_certified else "NOT certified"
        return f"<camber.Result: {len(self.orders)} cells, {state}>"


def curve(mesh: Mesh, geometry: Optional[Geometry] = None, *, order: int = 4, min_order: int = 1,
          deviation: float = 0.01, deviation_length: Union[str, float] = "face",
          uniform: bool = False, propagate: str = "layer", smooth: str = "auto",
          quality: Optional[float] = None, unit: str = "auto",
          link: Path = "auto",
          patches: Optional[Mapping[str, Union[str, Sequence[str]]]] = None, fit: bool = False,
          split_pinched: bool = False, strict: bool = False, feature_angle: float = 40.0,
          threads: int = 0, progress: Optional[ProgressCallback] = None) -> Result:
    """Curves a linear mesh onto its CAD, or, without one, onto a smooth surface through its own
    boundary vertices.

    The options are those of `camber curve --help`.

    Args:
        order, min_order: highest and lowest order of a cell.
        deviation: a face asks for more order while it is farther from the CAD than this share of
            the deviation length.
        deviation_length: "face", "cell", or a length.
        uniform: export every element at the highest order.
        propagate: "layer", "elastic" or "cell".
        smooth: "auto", "marching" or "none".
        quality: cost that smoothing aims at.
        unit: of the mesh: "auto", "m", "mm" or "in".
        link: what links mesh and CAD: "tags", "shape", "auto" (tags if they fit, else shape) or a
            MeshLink file (.xml).
        patches: {name or number: "free", "fixed", "plane" or "wall"}, or a list of the CAD faces
            that the patch may lie on (with the link "shape").
        fit: slide wall nodes until the faces follow the CAD as closely as their order can.
        split_pinched: cut cells that no curving can leave valid.
        strict: faces over the deviation count as failure in the report.
        feature_angle: without CAD, edges between faces turned by more stay sharp [degrees].
        threads: 0 for all. The result has the same bits for any number.
        progress: called with stage and fraction done; what it raises cancels the run and is raised
            here. Ctrl-C cancels too.

    Other Python threads run meanwhile; they must not change `mesh.points`. Runs on one Geometry
    take turns.

    Raises:
        MeshError, GeometryError, OptionError: with what, where and remedy.
    """
    options: Dict[str, object] = {
        "order": order, "min_order": min_order, "uniform": uniform, "deviation": deviation,
        "deviation_length": deviation_length, "propagate": propagate, "smooth": smooth,
        "quality": quality, "unit": unit, "link": os.fspath(link), "patches": dict(patches or {}), "fit": fit,
        "split_pinched": split_pinched, "strict": strict, "feature_angle": feature_angle}
    return Result(_camber.curve(native(mesh), geometry._model if geometry else None, options, threads,
                                progress))


def check(mesh: Mesh, geometry: Optional[Geometry] = None, *, deviation: float = 0.01,
          quality: bool = True, strict: bool = False, unit: str = "auto") -> Report:
    """Judges any linear or curved mesh: certificates, gaps, quality, and with a CAD the surface
    error of the patches that refer to it. The options are those of `camber check --help`;
    quality=False leaves the cost of the cells out.

    Raises:
        MeshError, GeometryError: there is nothing to check, or mesh and CAD do not fit.
    """
    model = None if geometry is None else geometry._model
    return Report(_camber.check(native(mesh), model, deviation, quality, strict, unit))


def page(mesh: Mesh, path: Path, geometry: Optional[Geometry] = None, *, deviation: float = 0.01,
         unit: str = "auto") -> None:
    """Writes one HTML file to look at any linear or curved mesh, as `camber report` does.

    With a CAD the page shows the deviation of the surface elements whose tags refer to it; with a
    geometry without CAD (.stl, .msh, "sphere:..") that of the elements whose corners lie on it.

    Args:
        deviation: a face is off the CAD over this share of its shortest edge.
        unit: of the mesh: "auto", "m", "mm" or "in".

    Raises:
        FileError: the file cannot be written; an old one stays.
        MeshError, GeometryError, OptionError: as check().
    """
    model = None if geometry is None else geometry._model
    _camber.write_mesh_page(native(mesh), os.fspath(path), model, deviation, unit)
