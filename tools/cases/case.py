"""What the bundled cases share: the CAD file, far boxes, and the report of a finished mesh."""
import pathlib
import re
import sys

import gmsh
import numpy as np

import hybrid_mesh
import mesh_check
import msh_file

VOLUME = 1
NAMES = {hybrid_mesh.TET: "tet", hybrid_mesh.PYRAMID: "pyramid", hybrid_mesh.PRISM: "prism",
         hybrid_mesh.HEX: "hex"}


def start(default_folder):
    """Folder to write to: the first argument, or cases/<default_folder> of the repository."""
    root = pathlib.Path(__file__).resolve().parents[2]
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else root / "cases" / default_folder
    folder.mkdir(parents=True, exist_ok=True)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    return folder


def save_cad(folder):
    """Writes the current OCC model as body.step (without the date) and loads that file alone,

    so that gmsh's tags are the file's own."""
    step = folder / "body.step"
    gmsh.write(str(step))
    text = step.read_text()
    step.write_text(re.sub(r"'\d{4}-\d\d-\d\dT[\d:]+'", "'2000-01-01T00:00:00'", text))
    gmsh.model.remove()
    gmsh.model.add("cad")
    gmsh.model.occ.importShapes(str(step))
    gmsh.model.occ.synchronize()


def add_far_box(mesh, hull, entities, size, half_width, edge):
    """Tets from `hull` to a cube around the body; returns the tags of its sides."""
    first = max(tag for dim, tag in entities if dim == 2) + 1
    centre = (mesh.points.min(axis=0) + mesh.points.max(axis=0)) / 2
    hybrid_mesh.fill_with_tets(mesh, hull, VOLUME, size, (centre, half_width, edge), first)
    tags = list(range(first, first + 6))
    for tag in tags:
        points = np.unique(mesh.boundary[2, tag, hybrid_mesh.TRIANGLE])
        entities[2, tag] = msh_file.box_of(mesh.points[points]), []
    return tags


def finish(folder, mesh, entities, groups, surface, first):
    """Checks and writes linear.msh and prints what is in it."""
    mesh_check.check(mesh)
    faces = sorted(tag for dim, tag in entities if dim == 2)
    entities[3, VOLUME] = msh_file.box_of(mesh.points), faces
    path = folder / "linear.msh"
    msh_file.write(str(path), mesh, entities, {**groups, "fluid": (3, [VOLUME])})
    counts = ", ".join(f"{len(rows)} {NAMES[kind]}" for kind, rows in sorted(mesh.cells.items())
                       if len(rows))
    edge = np.median(surface.edge_lengths())
    print(f"{path}: {counts}; wall {len(surface.triangles)} triangles, {len(surface.quads)} quads; "
          f"first cell / median wall edge {first / edge:.2g}; {path.stat().st_size / 1e6:.2f} MB")
    gmsh.finalize()
