#!/usr/bin/python3
"""Curves a bundled case with the camber program and judges the file with Gmsh, which knows nothing of Camber.

usage: curve_and_check.py CAMBER CASE_FOLDER ORDER DEVIATION OUT.msh VOLUME TOLERANCE

Checked: every Jacobian determinant at Gmsh's own Gauss points is positive; the cells' volumes add up to VOLUME
within the relative TOLERANCE; every node of a CAD face is as near to it as the report says; orders above 1 occur.
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

# The report's largest distance is taken at Gauss points; nodes of a side shared with a lower order may be
# as far off, not much farther. Nodes exactly on the CAD are within the kernel's tolerance.
BEYOND_REPORT, ON_FACE = 2.0, 1e-7
PYRAMID_VOLUME = 4 / 3  # of Gmsh's reference pyramid; version 4.8 has weights with another sum
FAMILIES = ("Tetrahedron", "Pyramid", "Prism", "Hexahedron")


def prism_gradients(kind, order, points):
    """Gradients of the prism's basis at the points, (points, nodes, 3); Gmsh 4.8 has none above order 2.

    The nodes' order is read off a single reference prism that Gmsh elevates itself."""
    here = gmsh.model.getCurrent()
    gmsh.model.add("one prism")
    volume = gmsh.model.addDiscreteEntity(3)
    corners = [(0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
    gmsh.model.mesh.addNodes(3, volume, range(1, 7), np.ravel(corners).astype(float).tolist())
    gmsh.model.mesh.addElementsByType(volume, 6, [1], range(1, 7))
    gmsh.model.mesh.setOrder(order)
    tags, x, _ = gmsh.model.mesh.getNodes()
    place = dict(zip((int(t) for t in tags), np.array(x).reshape(-1, 3)))
    nodes = np.array([place[int(t)] for t in gmsh.model.mesh.getElementsByType(kind)[1]])
    gmsh.model.remove()
    gmsh.model.setCurrent(here)

    powers = [(i, j, k) for i in range(order + 1) for j in range(order + 1 - i) for k in range(order + 1)]

    def monomials(x, derived=None):
        columns = []
        for power in powers:
            factor, power = 1.0, list(power)
            if derived is not None:
                factor = float(power[derived])
                power[derived] = max(power[derived] - 1, 0)
            columns.append(factor * np.prod(x ** np.array(power), axis=1))
        return np.stack(columns, axis=1)

    to_nodes = np.linalg.inv(monomials(nodes))
    x = np.array(points).reshape(-1, 3)
    return np.stack([monomials(x, d) @ to_nodes for d in range(3)], axis=2)


def determinants_of(kind, name, order, points, tag, x):
    """Jacobian determinants (cells, points); x: coordinates by node tag."""
    if name == "Prism" and order > 2:
        gradients = prism_gradients(kind, order, points)
    else:
        values = gmsh.model.mesh.getBasisFunctions(kind, points, "GradLagrange")[1]
        gradients = np.array(values).reshape(len(points) // 3, -1, 3)
    nodes = gmsh.model.mesh.getElementsByType(kind, tag)[1].astype(int)
    cells = x[nodes].reshape(-1, gradients.shape[1], 3)
    return np.linalg.det(np.einsum("cni,pnj->cpij", cells, gradients))


def total_volume(faults):
    """Sum of the cells' volumes, and the orders that occur."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    x = np.zeros((int(max(tags)) + 1, 3))
    x[tags.astype(int)] = np.array(coordinates).reshape(-1, 3)
    total, orders = 0.0, set()
    known = {gmsh.model.mesh.getElementType(family, order): (family, order)
             for family in FAMILIES for order in range(1, 5)}
    for kind in gmsh.model.mesh.getElementTypes(3):
        name, order = known[kind]
        orders.add(order)
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, f"Gauss{3 * order}")
        if name == "Pyramid":
            weights = np.array(weights) * PYRAMID_VOLUME / sum(weights)
        for _, tag in gmsh.model.getEntities(3):
            if kind not in gmsh.model.mesh.getElementTypes(3, tag):
                continue
            determinants = determinants_of(kind, name, order, points, tag, x)
            bad = int((determinants <= 0).any(axis=1).sum())
            if bad:
                faults.append(f"{bad} cells ({name}, order {order}) have a determinant that is not positive")
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
    camber, case, order, deviation, out, volume, tolerance = sys.argv[1:]
    cad = str(pathlib.Path(case) / "body.step")
    report = pathlib.Path(out).with_suffix(".json")
    subprocess.run([camber, "curve", str(pathlib.Path(case) / "linear.msh"), "--geometry", cad, "--order", order,
                    "--deviation", deviation, "-o", out, "--json", str(report)], check=True)
    faults = []
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(out)
    found, orders = total_volume(faults)
    box = np.array(gmsh.model.getBoundingBox(-1, -1))
    size = float(np.linalg.norm(box[3:] - box[:3]))
    if abs(found / float(volume) - 1) > float(tolerance):
        faults.append(f"the cells' volumes add up to {found!r}, not to {volume}")
    if max(orders) < 2:
        faults.append("every cell is linear")
    worst = largest_distance(cad)
    said = json.loads(report.read_text())
    if worst > BEYOND_REPORT * said["surface"]["maximum"] + ON_FACE * size:
        faults.append(f"a node is {worst} away from its CAD face, the report says {said['surface']}")
    if said["status"] != "ok" or said["validity"]["invalid"] or said["validity"]["undecided"]:
        faults.append(f"the report says {said['status']}, {said['validity']}")
    print(f"orders {sorted(orders)}, volume off by {found / float(volume) - 1:.2e}, "
          f"nodes off their faces by {worst:.2e}")
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


main()
