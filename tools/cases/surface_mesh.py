"""The CAD surface mesh that layers grow from: points, triangles, quads and their CAD entities."""
from dataclasses import dataclass, field

import gmsh
import numpy as np

TRIANGLE, QUAD, LINE, POINT = 2, 3, 1, 15


@dataclass
class SurfaceMesh:
    """Points (n,3), each on one CAD entity; elements as one row of point indices and one CAD tag each."""

    points: np.ndarray
    entity: np.ndarray  # (n,2): dimension and tag
    triangles: np.ndarray
    triangle_tag: np.ndarray
    quads: np.ndarray
    quad_tag: np.ndarray
    lines: np.ndarray
    line_tag: np.ndarray
    vertices: np.ndarray
    vertex_tag: np.ndarray
    edges: np.ndarray = field(init=False)

    def __post_init__(self):
        sides = [self.triangles[:, [i, (i + 1) % 3]] for i in range(3)]
        sides += [self.quads[:, [i, (i + 1) % 4]] for i in range(4)]
        self.edges = np.unique(np.sort(np.vstack(sides), axis=1), axis=0)

    def edge_lengths(self):
        return np.linalg.norm(self.points[self.edges[:, 1]] - self.points[self.edges[:, 0]], axis=1)

    def flipped(self):
        """The same mesh seen from the other side."""
        return SurfaceMesh(self.points, self.entity, self.triangles[:, ::-1], self.triangle_tag,
                           self.quads[:, ::-1], self.quad_tag, self.lines, self.line_tag,
                           self.vertices, self.vertex_tag)

    def enclosed_volume(self):
        """Signed by the orientation; meaningful for a closed surface only."""
        x = self.points
        parts = (self.triangles, self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]])
        return sum(np.einsum("ei,ei->", x[t[:, 0]], np.cross(x[t[:, 1]], x[t[:, 2]])) / 6
                   for t in parts)


def gather(faces):
    """Takes the current gmsh model's mesh on the CAD faces with the tags `faces`."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    coordinates = np.array(coordinates).reshape(-1, 3)
    row = np.full(int(tags.max()) + 1, -1)
    row[tags.astype(int)] = np.arange(len(tags))
    entity = np.zeros((len(tags), 2), int)
    for dim, tag in gmsh.model.getEntities():
        entity[row[gmsh.model.mesh.getNodes(dim, tag)[0].astype(int)]] = dim, tag

    curves = {abs(t) for f in faces for _, t in gmsh.model.getBoundary([(2, f)], oriented=False)}
    corners = {abs(t) for c in curves for _, t in gmsh.model.getBoundary([(1, c)], oriented=False)}
    found = {}
    for kind, dim, width, owners in ((TRIANGLE, 2, 3, faces), (QUAD, 2, 4, faces),
                                     (LINE, 1, 2, curves), (POINT, 0, 1, corners)):
        rows, owner = [np.zeros((0, width), int)], [np.zeros(0, int)]
        for tag in sorted(owners):
            for t, _, nodes in zip(*gmsh.model.mesh.getElements(dim, tag)):
                if t == kind:
                    rows.append(row[nodes.astype(int)].reshape(-1, width))
                    owner.append(np.full(len(rows[-1]), tag))
        found[kind] = np.vstack(rows), np.concatenate(owner)

    used = np.unique(np.concatenate([found[k][0].ravel() for k in (TRIANGLE, QUAD)]))
    new = np.full(len(tags), -1)
    new[used] = np.arange(len(used))
    columns = []
    for kind in (TRIANGLE, QUAD, LINE, POINT):
        columns += [new[found[kind][0]], found[kind][1]]
    return SurfaceMesh(coordinates[used], entity[used], *columns)
