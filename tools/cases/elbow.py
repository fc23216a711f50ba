#!/usr/bin/python3
"""cases/elbow: the inside of a pipe with a 90-degree bend, prism layers on the wall, tets in the core.

Inlet and outlet are planes that the curved wall touches: rings of quads around a disc of triangles.
"""
import gmsh
import numpy as np

import case
import hybrid_mesh
import msh_file
import surface_mesh

RADIUS, BEND, LEG = 0.5, 1.2, 0.8
EDGE, LAYERS, FIRST_OF_EDGE = 0.24, 6, 5e-3


def make_cad():
    """A straight leg along +y, a quarter torus about the z axis' parallel, a leg along -x."""
    gmsh.model.add("make")
    occ = gmsh.model.occ
    bend = occ.addTorus(0, 0, 0, BEND, RADIUS, angle=np.pi / 2)
    legs = [occ.addCylinder(BEND, -LEG, 0, 0, LEG, 0, RADIUS),
            occ.addCylinder(0, BEND, 0, -LEG, 0, 0, RADIUS)]
    occ.fuse([(3, bend)], [(3, leg) for leg in legs])
    occ.synchronize()


def find_caps():
    """Tag of each planar face -> its outward normal."""
    caps = {}
    for _, tag in gmsh.model.getEntities(2):
        if gmsh.model.getType(2, tag) == "Plane":
            x = gmsh.model.occ.getCenterOfMass(2, tag)
            caps[tag] = np.array((0., -1, 0)) if x[1] < -LEG / 2 else np.array((-1., 0, 0))
    return caps


def rim_columns(surface, caps):
    """Vertex -> tag of the cap whose plane its column stays in."""
    rims = {}
    for cap in caps:
        curves = {abs(t) for _, t in gmsh.model.getBoundary([(2, cap)], oriented=False)}
        for vertex in surface.lines[np.isin(surface.line_tag, list(curves))].ravel():
            rims[int(vertex)] = cap
    return rims


def rim_edges(surface, rims, cap):
    """Edges of the cap's rim, directed as the wall's elements run along them."""
    sides = np.vstack([surface.triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    # Only the rim has edges with a single face: those whose reverse does not occur.
    seen = set(map(tuple, sides))
    return np.array([(a, b) for a, b in sides if (b, a) not in seen and rims.get(a) == cap])


def close_cap(mesh, node, edges, cap):
    """Quads between the rim's columns and a disc of triangles inside; returns the disc's triangles.

    The triangles look into the core, as the tops of the layers do."""
    for k in range(LAYERS):
        a, b = edges.T
        mesh.add_boundary(2, cap, hybrid_mesh.QUAD,
                          np.stack([node[a, k], node[b, k], node[b, k + 1], node[a, k + 1]], axis=1))
    ring = [edges[0, 0]]
    after = dict(edges)
    while after[ring[-1]] != ring[0]:
        ring.append(after[ring[-1]])
    tops = node[ring, -1]
    gmsh.model.add("disc")
    geo = gmsh.model.geo
    points = [geo.addPoint(*mesh.points[t]) for t in tops]
    lines = [geo.addLine(points[i - 1], points[i]) for i in range(len(points))]
    for line in lines:
        geo.mesh.setTransfiniteCurve(line, 2)
    face = geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes(2, face)
    of_tag = dict(zip((int(t) for t in tags),
                      mesh.add_points(np.array(coordinates).reshape(-1, 3), 2, cap)))
    for point, top in zip(points, tops):
        of_tag[int(gmsh.model.mesh.getNodes(0, point)[0][0])] = top
    rows = gmsh.model.mesh.getElements(2, face)[2][0].astype(int)
    disc = np.array([of_tag[t] for t in rows]).reshape(-1, 3)
    gmsh.model.remove()
    return disc


def towards(points, triangles, direction):
    """The triangles with their normals on the side of `direction`."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    against = np.cross(b - a, c - a) @ direction < 0
    return np.where(against[:, None], triangles[:, ::-1], triangles)


def main():
    folder = case.start("elbow")
    make_cad()
    case.save_cad(folder)
    caps, entities = find_caps(), msh_file.cad_entities()
    walls = [tag for _, tag in gmsh.model.getEntities(2) if tag not in caps]
    gmsh.option.setNumber("Mesh.MeshSizeMax", EDGE)
    gmsh.option.setNumber("Mesh.MeshSizeMin", EDGE)
    gmsh.model.mesh.generate(2)
    everything = surface_mesh.gather(walls + list(caps))
    surface = surface_mesh.gather(walls)
    if everything.enclosed_volume() > 0:
        surface = surface.flipped()
    rims = rim_columns(surface, caps)
    first = FIRST_OF_EDGE * np.median(surface.edge_lengths())
    planes = {vertex: caps[cap] for vertex, cap in rims.items()}
    mesh, node = hybrid_mesh.build_layers(surface, LAYERS, first, 0.6, case.VOLUME, planes, rims)
    discs = []
    for cap, outward in caps.items():
        disc = close_cap(mesh, node, rim_edges(surface, rims, cap), cap)
        disc = towards(mesh.points, disc, -outward)
        mesh.add_boundary(2, cap, hybrid_mesh.TRIANGLE, disc[:, ::-1])
        discs.append(disc)
    hull = np.vstack([node[surface.triangles, -1], *discs])
    hybrid_mesh.fill_with_tets(mesh, hull, case.VOLUME, 1.3 * EDGE)
    inlet, outlet = sorted(caps, key=lambda cap: caps[cap][0], reverse=True)
    groups = {"wall": (2, walls), "inlet": (2, [inlet]), "outlet": (2, [outlet])}
    case.finish(folder, mesh, entities, groups, surface, first)


main()
