"""Meshes as arrays."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _camber
from ._errors import MeshError

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Block:
    """Elements of one shape, one order and one entity.

    Attributes:
        shape: "point", "line", "tri", "quad", "tet", "pyramid", "prism" or "hex".
        order: polynomial order (degree), 1 to 4.
        entity: tag of the curve, surface or volume that the elements are on.
        nodes: (elements, nodes of one), indices into Mesh.points, in the order of node_order.
        tags: element numbers of the file; empty if there are none.
        node_order: "lattice" (Camber's own: first direction fastest) or "gmsh".
    """

    shape: str
    order: int
    entity: int
    nodes: npt.NDArray[np.int32]
    tags: npt.NDArray[np.int64]
    node_order: str = "lattice"

    def nodes_as(self, node_order: str) -> npt.NDArray[np.int32]:
        """The nodes in the order "gmsh" or "lattice": the array itself if it is in that order,
        else a copy. For order 1, Gmsh's corners are those of CGNS and VTK."""
        if node_order == self.node_order:
            return self.nodes
        here = _camber.canonical_places(self.shape, self.order, self.node_order)
        there = _camber.canonical_places(self.shape, self.order, node_order)
        columns = np.empty(len(here), dtype=np.intp)
        columns[there] = here
        return self.nodes[:, columns]


def block(shape: str, nodes: npt.ArrayLike, entity: int, order: int = 1,
          node_order: str = "gmsh") -> Block:
    """A block for Mesh, from an array (elements, nodes of one) of indices that count from 0."""
    given = np.asarray(nodes)
    largest = np.iinfo(np.int32).max
    if given.dtype.kind not in "iu" or (given.size and not 0 <= given.min() <= given.max() <= largest):
        raise MeshError(f"nodes of the {shape} block are no indices", "camber.block",
                        f"give integers from 0 to {largest}")
    return Block(shape, order, entity, np.asarray(given, dtype=np.int32),
                 np.empty(0, dtype=np.int64), node_order)


class Mesh:
    """A linear or curved mesh: points and blocks of elements.

    A mesh that was read looks at Camber's memory: `points` may be changed in place, which changes
    the mesh; the other arrays are read-only. A mesh made from arrays keeps the arrays it was given,
    without a copy; each call that uses it hands them to Camber as they are then (one copy).

    Args:
        points: (points, 3) float64.
        blocks: see camber.block(). Volume cells, and surface elements whose `entity` is the face of
            the CAD (1, 2, ...: see docs/geometry); other tags are patches without CAD.
        names: {(dimension, tag): name} of patches and regions.
        point_entity: (points, 2) dimension and tag of the entity each point lies on, -1 where it is
            not known; found from the elements if left out.
    """

    def __init__(self, points: npt.ArrayLike, blocks: Sequence[Block], *,
                 names: Optional[Mapping[Tuple[int, int], str]] = None,
                 point_entity: Optional[npt.ArrayLike] = None) -> None:
        self._points: npt.NDArray[np.float64] = np.asarray(points, dtype=np.float64)
        self._blocks = list(blocks)
        self._names = dict(names or {})
        self._point_entity = (np.empty((0, 2), dtype=np.int32) if point_entity is None
                              else np.asarray(point_entity, dtype=np.int32))
        self._fields: Dict[str, npt.NDArray[np.float64]] = {}
        self._data: Optional[_camber.MeshData] = None
        self._native()  # refuses wrong arrays here, where they were given

    @classmethod
    def _of(cls, data: _camber.MeshData) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._data = data
        mesh._points = data.points
        mesh._blocks = [Block(**entry) for entry in data.blocks]
        mesh._names = data.names
        mesh._point_entity = data.point_entity
        mesh._fields = data.fields
        return mesh

    def _native(self) -> _camber.MeshData:
        if self._data is not None:
            return self._data
        data = _camber.MeshData(self._points, "mesh from arrays")
        for b in self._blocks:
            data.add_block(b.shape, b.order, b.entity, b.nodes, b.node_order)
        if self._point_entity.size:
            data.set_point_entities(self._point_entity)
        for (dim, tag), name in self._names.items():
            data.add_name(dim, tag, name)
        return data

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """(points, 3): no copy."""
        return self._points

    @property
    def blocks(self) -> List[Block]:
        """All blocks; those of the volume are the ones with shape tet, pyramid, prism or hex."""
        return list(self._blocks)

    @property
    def names(self) -> Dict[Tuple[int, int], str]:
        """{(dimension, tag): name} of the entities that have a name."""
        return dict(self._names)

    @property
    def point_entity(self) -> npt.NDArray[np.int32]:
        """(points, 2): dimension and tag of the entity of each point; (0, 2) if not known."""
        return self._point_entity

    @property
    def fields(self) -> Dict[str, npt.NDArray[np.float64]]:
        """One value an element, over all blocks in order (of a curved mesh: scaled_jacobian, cost,
        patch, deviation; NaN where a value has no meaning)."""
        return dict(self._fields)

    def write(self, path: Path, *, ascii: bool = False) -> None:
        """Writes .msh or .vtu, replacing the file only when what was written has been verified.

        Raises:
            FileError: the file cannot be written.
        """
        self._native().write(os.fspath(path), ascii, False)

    def __repr__(self) -> str:
        counts: Dict[str, int] = {}
        for b in self._blocks:
            counts[b.shape] = counts.get(b.shape, 0) + len(b.nodes)
        elements = ", ".join(f"{count} {shape}" for shape, count in counts.items())
        return f"<camber.Mesh: {len(self._points)} points, {elements}>"


def read(path: Path) -> Mesh:
    """Reads a mesh (.msh 4.1 or 2.2, linear or curved up to order 4).

    Raises:
        FileError: missing, unreadable or broken; names line or byte.
    """
    return Mesh._of(_camber.read_mesh(os.fspath(path)))


def native(mesh: Any) -> _camber.MeshData:
    """The C++ mesh behind a Mesh."""
    if not isinstance(mesh, Mesh):
        raise TypeError(f"a camber.Mesh is needed, not {type(mesh).__name__}: see camber.read")
    return mesh._native()
