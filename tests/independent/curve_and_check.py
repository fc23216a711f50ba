#!/usr/bin/python3
"""Curves a bundled case with the camber program and judges the file with Gmsh, which knows nothing of Camber.

usage: curve_and_check.py CAMBER CASE_FOLDER ORDER OUT.msh VOLUME TOLERANCE

Checked: every Jacobian determinant at Gmsh's own Gauss points is positive; the cells' volumes add up to VOLUME
within the relative TOLERANCE; every node on a CAD face lies on that face; orders above 1 occur.
Exit code 77: Gmsh for Python is not installed.
"""
import json
import pathlib
import subprocess
import sys

try:
    import gmsh
    import numpy as np
except ImportError:
    print("python3-gmsh or python3-numpy is not installed")
    sys.exit(77)

# Distance of a node to its face, relative to the box: OpenCASCADE's own edges are not better.
ON_FACE = 1e-6
PYRAMID_VOLUME = 4 / 3  # of Gmsh's reference pyramid; version 4.8 has weights with another sum


def volume_and_smallest(faults):
    """Sum of the cells' volumes and the smallest ratio of determinants of a cell."""
    total, orders = 0.0, set()
    for kind in gmsh.model.mesh.getElementTypes(3):
        name, _, order, *_ = gmsh.model.mesh.getElementProperties(kind)
        orders.add(order)
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, f"Gauss{3 * order}")
        if name.startswith("Pyramid"):
            weights = np.array(weights) * PYRAMID_VOLUME / sum(weights)
        for _, tag in gmsh.model.getEntities(3):
            if kind not in gmsh.model.mesh.getElementTypes(3, tag):
                continue
            _, determinants, _ = gmsh.model.mesh.getJacobians(kind, points, tag)
            determinants = np.array(determinants).reshape(-1, len(weights))
            bad = int((determinants <= 0).any(axis=1).sum())
            if bad:
                faults.append(f"{bad} cells of type {name} have a determinant that is not positive")
            total += float((determinants @ weights).sum())
    return total, orders


def largest_distance(cad):
    """Of the nodes on CAD faces to those faces, over all faces of the CAD file."""
    nodes = {}
    for _, tag in gmsh.model.getEntities(2):
        nodes[tag] = np.array(gmsh.model.mesh.getNodes(2, tag, includeBoundary=True)[1])
    gmsh.model.add("cad")
    gmsh.model.occ.importShapes(cad)
    gmsh.model.occ.synchronize()
    worst = 0.0
    for _, tag in gmsh.model.getEntities(2):
        nearest = np.array(gmsh.model.getClosestPoint(2, tag, nodes[tag].tolist())[0])
        distance = np.linalg.norm((nodes[tag] - nearest).reshape(-1, 3), axis=1)
        worst = max(worst, float(distance.max()))
    return worst


def main():
    camber, case, order, out, volume, tolerance = sys.argv[1:]
    cad = str(pathlib.Path(case) / "body.step")
    report = pathlib.Path(out).with_suffix(".json")
    subprocess.run([camber, "curve", str(pathlib.Path(case) / "linear.msh"), "--geometry", cad, "--order", order,
                    "-o", out, "--json", str(report)], check=True)
    faults = []
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(out)
    found, orders = volume_and_smallest(faults)
    box = np.array(gmsh.model.getBoundingBox(-1, -1))
    size = float(np.linalg.norm(box[3:] - box[:3]))
    if abs(found / float(volume) - 1) > float(tolerance):
        faults.append(f"the cells' volumes add up to {found!r}, not to {volume}")
    if max(orders) < 2:
        faults.append("every cell is linear")
    worst = largest_distance(cad)
    if worst > ON_FACE * size:
        faults.append(f"a node is {worst} away from its CAD face")
    said = json.loads(report.read_text())
    if said["status"] != "ok" or said["validity"]["invalid"] or said["validity"]["undecided"]:
        faults.append(f"the report says {said['status']}, {said['validity']}")
    print(f"orders {sorted(orders)}, volume off by {found / float(volume) - 1:.2e}, "
          f"nodes off their faces by {worst:.2e}")
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


main()
