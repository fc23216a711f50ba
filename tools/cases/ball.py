#!/usr/bin/python3
"""cases/ball: a sphere in a box, with all four cell shapes (triangles and quads on the wall)."""
import gmsh
import numpy as np

import case
import hybrid_mesh
import msh_file
import surface_mesh

RADIUS, LAYERS, FIRST_OF_EDGE = 1.0, 6, 1e-3


def main():
    folder = case.start("ball")
    gmsh.model.add("make")
    gmsh.model.occ.addSphere(0, 0, 0, RADIUS)
    gmsh.model.occ.synchronize()
    case.save_cad(folder)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.42 * RADIUS)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.42 * RADIUS)
    gmsh.option.setNumber("Mesh.RecombineAll", 1)
    gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 0)  # leaves some triangles
    gmsh.model.mesh.generate(2)
    faces = [tag for _, tag in gmsh.model.getEntities(2)]
    surface, entities = surface_mesh.gather(faces), msh_file.cad_entities()
    if surface.enclosed_volume() < 0:
        surface = surface.flipped()
    first = FIRST_OF_EDGE * np.median(surface.edge_lengths())
    mesh, node = hybrid_mesh.build_layers(surface, LAYERS, first, 0.8, case.VOLUME)
    hull = np.vstack([node[surface.triangles, -1],
                      hybrid_mesh.cap_quads(mesh, node[surface.quads, -1], case.VOLUME)])
    far = case.add_far_box(mesh, hull, entities, 1.5 * RADIUS, 4 * RADIUS, 2 * RADIUS)
    case.finish(folder, mesh, entities, {"ball": (2, faces), "far": (2, far)}, surface, first)


main()
