"""Assembles wall layers, pyramid caps and tets into one linear hybrid mesh."""
from dataclasses import dataclass, field

import gmsh
import numpy as np

import layers

# Gmsh element types.
TET, HEX, PRISM, PYRAMID = 4, 5, 6, 7
TRIANGLE, QUAD, LINE, POINT = 2, 3, 1, 15


@dataclass
class HybridMesh:
    """Points with the CAD entity each lies on; cells and boundary elements by Gmsh type and tag."""

    points: np.ndarray
    entity: np.ndarray  # (n,2): dimension and tag
    cells: dict  # type -> (m,k)
    boundary: dict = field(default_factory=dict)  # (dimension, tag, type) -> (m,k)

    def add_boundary(self, dim, tag, kind, rows):
        if len(rows):
            old = self.boundary.get((dim, tag, kind))
            self.boundary[dim, tag, kind] = rows if old is None else np.vstack([old, rows])

    def add_points(self, points, dim, tag):
        """Appends points on one entity; returns their indices."""
        start = len(self.points)
        self.points = np.vstack([self.points, points])
        self.entity = np.vstack([self.entity, np.tile([dim, tag], (len(points), 1))])
        return np.arange(start, len(self.points))


def tet_volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum("ei,ei->e", np.cross(b - a, c - a), d - a) / 6


def build_layers(surface, count, first, reach, volume_tag, planes=None, side_face=None):
    """Grows the layers. The surface's normals point into the mesh.

    planes: vertex -> unit normal of the plane its column stays in (rims of an open surface);
    side_face: vertex -> tag of that plane's CAD face.
    Returns the mesh and the index array node[vertex, level].
    """
    planes, side_face = planes or {}, side_face or {}
    levels = layers.grow(surface, count, first, reach, planes)
    n = len(surface.points)
    node = np.arange(n * (count + 1)).reshape(n, count + 1)
    entity = np.tile([3, volume_tag], (n * (count + 1), 1))
    entity[node[:, 0]] = surface.entity
    for vertex, tag in side_face.items():
        entity[node[vertex, 1:]] = 2, tag
    stack = lambda faces: np.vstack(  # noqa: E731
        [np.hstack([node[faces, k], node[faces, k + 1]]) for k in range(count)])
    cells = {PRISM: stack(surface.triangles), HEX: stack(surface.quads)}
    mesh = HybridMesh(levels.reshape(-1, 3), entity, cells)
    for tag in np.unique(np.concatenate([surface.triangle_tag, surface.quad_tag])):
        # Boundary elements look out of the mesh.
        tri, quad = (f[t == tag][:, ::-1] for f, t in ((surface.triangles, surface.triangle_tag),
                                                       (surface.quads, surface.quad_tag)))
        mesh.add_boundary(2, tag, TRIANGLE, node[tri, 0])
        mesh.add_boundary(2, tag, QUAD, node[quad, 0])
    for tag in np.unique(surface.line_tag):
        mesh.add_boundary(1, tag, LINE, node[surface.lines[surface.line_tag == tag], 0])
    for vertex, tag in zip(surface.vertices, surface.vertex_tag):
        mesh.add_boundary(0, tag, POINT, node[vertex, 0].reshape(1, 1))
    return mesh, node


def cap_quads(mesh, quads, volume_tag):
    """Puts a pyramid on every quad (normals into the unfilled space); returns the new triangles."""
    if not len(quads):
        return np.zeros((0, 3), int)
    x = mesh.points[quads]
    normal = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])
    twice_area = np.linalg.norm(normal, axis=1)[:, None]
    apex = x.mean(axis=1) + 0.4 * normal / twice_area * np.sqrt(twice_area / 2)
    ids = mesh.add_points(apex, 3, volume_tag)
    mesh.cells[PYRAMID] = np.hstack([quads, ids[:, None]])
    return np.vstack([np.stack([quads[:, i], quads[:, (i + 1) % 4], ids], axis=1)
                      for i in range(4)])


def fill_with_tets(mesh, hull, volume_tag, size, box=None, first_box_tag=0):
    """Fills the space that the triangles `hull` look into with tets; nodes of the hull stay.

    box: (centre, half width, edge length) of an outer box whose sides become the faces
    first_box_tag ... first_box_tag + 5; without it the hull itself is closed.
    """
    gmsh.model.add("fill")
    for option, value in (("MeshSizeFromCurvature", 0), ("MeshSizeMin", 0), ("MeshSizeMax", size),
                          ("RecombineAll", 0), ("Algorithm", 6), ("Algorithm3D", 1), ("Renumber", 0),
                          ("MeshSizeExtendFromBoundary", 1)):
        gmsh.option.setNumber("Mesh." + option, value)
    geo, sides = gmsh.model.geo, []
    if box:
        centre, half, edge = box
        corners = {}
        for s in np.ndindex(2, 2, 2):
            corners[s] = geo.addPoint(*(centre + half * (2 * np.array(s) - 1)), edge)
        lines = {}
        for a in corners:
            for b in corners:
                if a < b and sum(np.abs(np.subtract(a, b))) == 1:
                    lines[a, b] = geo.addLine(corners[a], corners[b])
                    lines[b, a] = -lines[a, b]
        for axis in range(3):
            for value in (0, 1):
                ring = [np.insert([u, v], axis, value) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
                ring = [tuple(int(c) for c in corner) for corner in ring]
                loop = [lines[ring[i], ring[(i + 1) % 4]] for i in range(4)]
                sides.append(geo.addPlaneSurface([geo.addCurveLoop(loop)]))
    geo.synchronize()
    ids, local = np.unique(hull, return_inverse=True)
    inner = gmsh.model.addDiscreteEntity(2, 1000)
    base = 10**7  # node tags above those gmsh gives to the box
    gmsh.model.mesh.addNodes(2, inner, [base + i for i in range(len(ids))],
                             mesh.points[ids].ravel().tolist())
    gmsh.model.mesh.addElementsByType(inner, TRIANGLE, [], (base + local.ravel()).tolist())
    loops = [geo.addSurfaceLoop(sides)] if box else []
    volume = geo.addVolume(loops + [geo.addSurfaceLoop([inner])])
    geo.synchronize()
    gmsh.model.mesh.generate(3)

    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    tags, coordinates = tags.astype(int), np.array(coordinates).reshape(-1, 3)
    of_tag = np.full(tags.max() + 1, -1)
    known = (tags >= base) & (tags < base + len(ids))
    assert known.sum() == len(ids)
    of_tag[tags[known]] = ids[tags[known] - base]
    of_tag[tags[~known]] = mesh.add_points(coordinates[~known], 3, volume_tag)
    (kind,), _, (nodes,) = gmsh.model.mesh.getElements(3, volume)
    assert kind == TET
    tets = of_tag[nodes.astype(int)].reshape(-1, 4)
    tets[tet_volumes(mesh.points, tets) < 0] = tets[tet_volumes(mesh.points, tets) < 0][:, [1, 0, 2, 3]]
    mesh.cells[TET] = tets
    for k, side in enumerate(sides):
        faces = of_tag[gmsh.model.mesh.getElements(2, side)[2][0].astype(int)].reshape(-1, 3)
        out = np.cross(mesh.points[faces[:, 1]] - mesh.points[faces[:, 0]],
                       mesh.points[faces[:, 2]] - mesh.points[faces[:, 0]])
        inward = np.einsum("ei,ei->e", out, mesh.points[faces[:, 0]] - box[0]) < 0
        faces[inward] = faces[inward][:, ::-1]
        mesh.entity[np.unique(faces)] = 2, first_box_tag + k
        mesh.add_boundary(2, first_box_tag + k, TRIANGLE, faces)
    gmsh.model.remove()
