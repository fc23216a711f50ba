#!/usr/bin/python3
"""cases/wing: a swept, tapered wing in a box, prism layers and tets.

The section is a symmetric cubic B-spline with a blunt trailing edge; upper and lower half meet at the
leading edge with one tangent and one curvature. Both tips are flat.
"""
import gmsh
import numpy as np

import case
import hybrid_mesh
import msh_file
import surface_mesh

# Control points of the upper half section, chord 1; the first two lie on the vertical tangent.
SECTION = np.array([(0, 0), (0, .020), (.045, .050), (.18, .072), (.42, .074), (.72, .040), (1, .006)])
SPAN, SWEEP, TAPER = 1.8, 0.55, 0.55
CHORD_EDGES, SPAN_EDGES = 10, 12
GROWTH = 1.22  # of the chordwise edges from the leading edge on
LAYERS, FIRST_OF_EDGE = 7, 4e-3


def section(leading_edge, chord):
    """The closed wire of one section at the given leading edge."""
    occ = gmsh.model.occ

    def half(sign):
        ends = occ.addPoint(*leading_edge), trailing[sign]
        inner = [occ.addPoint(*(leading_edge + chord * np.array((x, 0, sign * z))))
                 for x, z in SECTION[1:-1]]
        return occ.addBSpline([ends[0], *inner, ends[1]], degree=3)

    x, z = SECTION[-1]
    trailing = {s: occ.addPoint(*(leading_edge + chord * np.array((x, 0, s * z)))) for s in (1, -1)}
    upper, lower = half(1), half(-1)
    blunt = occ.addLine(trailing[1], trailing[-1])
    return occ.addWire([upper, blunt, lower])


def make_cad():
    gmsh.model.add("make")
    wires = [section(np.array((y * SWEEP, y, 0.)), 1 - (1 - TAPER) * y / SPAN) for y in (0., SPAN)]
    gmsh.model.occ.addThruSections(wires, makeSolid=True, makeRuled=True)
    gmsh.model.occ.synchronize()


def set_mesh_sizes():
    """Stretched, structured triangles on the lifting faces; free triangles on the tips."""
    set_curve, set_face = gmsh.model.mesh.setTransfiniteCurve, gmsh.model.mesh.setTransfiniteSurface
    for _, tag in gmsh.model.getEntities(1):
        low, high = np.array(gmsh.model.getBoundingBox(1, tag)).reshape(2, 3)
        dx, dy, dz = high - low
        if dy > SPAN / 2:
            set_curve(tag, SPAN_EDGES + 1)
        elif dx > dz:
            ends = np.array(gmsh.model.getParametrizationBounds(1, tag)).ravel()
            start, end = np.array(gmsh.model.getValue(1, tag, ends)).reshape(2, 3)
            growth = GROWTH if start[0] < end[0] else 1 / GROWTH
            set_curve(tag, CHORD_EDGES + 1, "Progression", growth)
        else:
            set_curve(tag, 2)
    for _, tag in gmsh.model.getEntities(2):
        if len(gmsh.model.getBoundary([(2, tag)], combined=False)) == 4:
            set_face(tag, "AlternateLeft")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.12)
    gmsh.option.setNumber("Mesh.Algorithm", 6)


def main():
    folder = case.start("wing")
    make_cad()
    case.save_cad(folder)
    set_mesh_sizes()
    gmsh.model.mesh.generate(2)
    faces = [tag for _, tag in gmsh.model.getEntities(2)]
    surface, entities = surface_mesh.gather(faces), msh_file.cad_entities()
    if surface.enclosed_volume() < 0:
        surface = surface.flipped()
    first = FIRST_OF_EDGE * np.median(surface.edge_lengths())
    mesh, node = hybrid_mesh.build_layers(surface, LAYERS, first, 0.6, case.VOLUME)
    hull = node[surface.triangles, -1]
    far = case.add_far_box(mesh, hull, entities, 2.0, 5.0, 3.0)
    case.finish(folder, mesh, entities, {"wing": (2, faces), "far": (2, far)}, surface, first)


main()
