"""Proves a linear hybrid mesh sound before it is written."""
import numpy as np

import hybrid_mesh

# Faces and corner tets (corner, three neighbours in right-handed order) of each Gmsh cell type.
FACES = {
    hybrid_mesh.TET: [(0, 2, 1), (0, 1, 3), (0, 3, 2), (3, 1, 2)],
    hybrid_mesh.PYRAMID: [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (0, 3, 2, 1)],
    hybrid_mesh.PRISM: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    hybrid_mesh.HEX: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6),
                      (3, 0, 4, 7)]}
CORNERS = {
    hybrid_mesh.TET: [(0, 1, 2, 3)],
    hybrid_mesh.PYRAMID: [(0, 1, 3, 4), (1, 2, 0, 4), (2, 3, 1, 4), (3, 0, 2, 4)],
    hybrid_mesh.PRISM: [(0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5), (3, 5, 4, 0), (4, 3, 5, 1),
                        (5, 4, 3, 2)],
    hybrid_mesh.HEX: [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7), (4, 7, 5, 0),
                      (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]}


def check(mesh):
    """Raises unless every corner is positive and the exposed faces are exactly the boundary."""
    owners = {}
    for kind, rows in mesh.cells.items():
        for corner in CORNERS[kind]:
            if (hybrid_mesh.tet_volumes(mesh.points, rows[:, corner]) <= 0).any():
                raise RuntimeError(f"a cell of Gmsh type {kind} has a flat or inverted corner")
        for face in FACES[kind]:
            for key in map(tuple, np.sort(rows[:, face], axis=1)):
                owners[key] = owners.get(key, 0) + 1
    boundary = set()
    for (dim, _, _), rows in mesh.boundary.items():
        if dim == 2:
            boundary.update(map(tuple, np.sort(rows, axis=1)))
    exposed = {key for key, count in owners.items() if count == 1}
    if exposed != boundary or max(owners.values()) > 2:
        raise RuntimeError(f"{len(exposed ^ boundary)} faces are exposed or on the boundary, not both")
