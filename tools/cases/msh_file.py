"""Writes Gmsh 4.1 binary files: nodes and elements classified on CAD entities, named groups."""
import struct

import gmsh
import numpy as np


def cad_entities():
    """(dimension, tag) -> box and signed boundary tags, of the current gmsh model without volumes."""
    entities = {}
    for dim, tag in gmsh.model.getEntities():
        if dim < 3:
            # A degenerated edge has no box of its own; gmsh answers with its end point's.
            box = gmsh.model.getBoundingBox(dim, tag)
            below = [t for _, t in gmsh.model.getBoundary([(dim, tag)], oriented=True)] if dim else []
            entities[dim, tag] = box, below
    return entities


def box_of(points):
    return tuple(points.min(axis=0)) + tuple(points.max(axis=0))


def write(path, mesh, entities, groups):
    """mesh: HybridMesh; entities: as cad_entities(), with any further ones added;
    groups: name -> (dimension, tags)."""
    number = {name: i + 1 for i, name in enumerate(groups)}
    held = {}
    for name, (dim, tags) in groups.items():
        for tag in tags:
            held.setdefault((dim, tag), []).append(number[name])
    with open(path, "wb") as out:
        pack = lambda form, *values: out.write(struct.pack("<" + form, *values))  # noqa: E731
        out.write(b"$MeshFormat\n4.1 1 8\n")
        pack("i", 1)
        out.write(b"\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(groups))
        for name, (dim, _) in groups.items():
            out.write(b'%d %d "%s"\n' % (dim, number[name], name.encode()))
        out.write(b"$EndPhysicalNames\n$Entities\n")
        by_dim = [sorted(t for d, t in entities if d == dim) for dim in range(4)]
        pack("4Q", *(len(tags) for tags in by_dim))
        for dim, tags in enumerate(by_dim):
            for tag in tags:
                box, below = entities[dim, tag]
                mine = held.get((dim, tag), [])
                pack("i", tag)
                pack("3d", *box[:3]) if dim == 0 else pack("6d", *box)
                pack(f"Q{len(mine)}i", len(mine), *mine)
                if dim:
                    pack(f"Q{len(below)}i", len(below), *below)
        out.write(b"\n$EndEntities\n")
        renumbered = write_nodes(out, pack, mesh)
        write_elements(out, pack, mesh, renumbered)


def write_nodes(out, pack, mesh):
    """One block an entity; returns the node number of every point (0: unused)."""
    used = np.zeros(len(mesh.points), bool)
    for rows in mesh.cells.values():
        used[rows.ravel()] = True
    owners, owner = np.unique(mesh.entity, axis=0, return_inverse=True)
    owner = owner.ravel()
    for rows in mesh.boundary.values():
        assert used[rows].all(), "a boundary element has a point of no cell"
    numbers, start = np.zeros(len(mesh.points), np.uint64), 1
    blocks = [(d, t, np.flatnonzero(used & (owner == i))) for i, (d, t) in enumerate(owners)]
    blocks = [b for b in blocks if len(b[2])]
    out.write(b"$Nodes\n")
    pack("4Q", len(blocks), int(used.sum()), 1, int(used.sum()))
    for dim, tag, points in blocks:
        numbers[points] = np.arange(start, start + len(points))
        start += len(points)
        pack("3iQ", dim, tag, 0, len(points))
        out.write(numbers[points].astype("<u8").tobytes())
        out.write(mesh.points[points].astype("<f8").tobytes())
    out.write(b"\n$EndNodes\n")
    return numbers


def write_elements(out, pack, mesh, numbers):
    """Boundary elements first, by dimension, then the cells; numbered from 1."""
    ((volume_tag,),) = np.unique(mesh.entity[mesh.entity[:, 0] == 3, 1:], axis=0)
    blocks = [(*key, rows) for key, rows in sorted(mesh.boundary.items())]
    blocks += [(3, volume_tag, kind, rows) for kind, rows in sorted(mesh.cells.items()) if len(rows)]
    total = sum(len(rows) for *_, rows in blocks)
    out.write(b"$Elements\n")
    pack("4Q", len(blocks), total, 1, total)
    start = 1
    for dim, tag, kind, rows in blocks:
        pack("3iQ", dim, tag, kind, len(rows))
        element = np.arange(start, start + len(rows), dtype=np.uint64)[:, None]
        out.write(np.hstack([element, numbers[rows]]).astype("<u8").tobytes())
        start += len(rows)
    out.write(b"\n$EndElements\n")
