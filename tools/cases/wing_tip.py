#!/usr/bin/python3
"""Half a wing of the ONERA M6's planform with a tip of revolution, in a box of tets: for measuring.

    tools/cases/wing_tip.py FOLDER [--size 0.028]     # FOLDER/body.step, FOLDER/linear.msh

The section is 10 % thick and sharp at the trailing edge; the tip is half of it turned about the chord,
which leaves the CAD a degenerate pole at the leading and at the trailing edge. No layers. Gmsh's own
high-order optimiser leaves tens of such tets invalid at the tip. Not bundled.
"""
import argparse
import math
import pathlib

import gmsh
import numpy as np

ROOT, TIP, SPAN, SWEEP = 0.8059, 0.4529, 1.1963, math.radians(30.0)
# Control points of the upper half section, chord 1, sharp at both ends of the chord.
SECTION = np.array([(0, 0), (0, .022), (.06, .052), (.25, .063), (.55, .050), (.85, .016), (1, 0)])


def half(leading_edge, chord, sign):
    """Upper (1) or lower (-1) half of a section, from its leading to its trailing edge."""
    points = [gmsh.model.occ.addPoint(*(leading_edge + chord * np.array((x, 0, sign * z))))
              for x, z in SECTION]
    return gmsh.model.occ.addBSpline(points, degree=3)


def make_body(far):
    occ = gmsh.model.occ
    tip_edge = np.array((SPAN * math.tan(SWEEP), SPAN, 0.0))
    wires = [occ.addWire([half(edge, chord, 1), half(edge, chord, -1)])
             for edge, chord in ((np.zeros(3), ROOT), (tip_edge, TIP))]
    occ.addThruSections(wires, makeSolid=True, makeRuled=True)
    upper = half(tip_edge, TIP, 1)
    start = occ.addPoint(*tip_edge)
    end = occ.addPoint(*(tip_edge + np.array((TIP, 0, 0))))
    face = occ.addPlaneSurface([occ.addWire([upper, occ.addLine(end, start)])])
    occ.revolve([(2, face)], *tip_edge, 1, 0, 0, -math.pi)
    occ.removeAllDuplicates()
    solids = occ.getEntities(3)
    body, _ = occ.fuse(solids[:1], solids[1:])
    box = occ.addBox(-far, 0, -far, 2 * far + 1, far + SPAN, 2 * far)
    occ.cut([(3, box)], body)
    for dim in (2, 1, 0):  # what was only a help; what bounds the box stays
        occ.remove(occ.getEntities(dim))
    occ.synchronize()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", type=float, default=0.028, help="of the tets on the wing")
    parser.add_argument("--far", type=float, default=3.0)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    make_body(arguments.far)
    gmsh.write(str(arguments.folder / "body.step"))
    for dim, tag in gmsh.model.getEntities(0):
        x = np.array(gmsh.model.getValue(dim, tag, []))
        is_far = np.abs(x[[0, 2]]).max() > 2.0 or x[1] > 2.0
        gmsh.model.mesh.setSize([(dim, tag)], 1.2 if is_far else arguments.size)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.model.mesh.generate(3)
    gmsh.write(str(arguments.folder / "linear.msh"))
    cells = sum(len(tags) for tags in gmsh.model.mesh.getElements(3)[1])
    print(f"{arguments.folder}: {cells} tets, {len(gmsh.model.getEntities(2))} faces")
    gmsh.finalize()


if __name__ == "__main__":
    main()
