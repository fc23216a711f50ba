"""Opens a .msh file in Gmsh and compares the measure of each element with a list.

usage: check_with_gmsh.py MESH.msh EXPECTED.txt
EXPECTED: lines "number place shape order dimension measure tolerance". Ends with 77 if gmsh is not installed.
"""
import sys

try:
    import gmsh
    import numpy as np
except ImportError:
    sys.exit(77)

TOLERANCE = 1e-12  # relative


def rule(shape):
    """Points and weights in Gmsh's reference element, from collapsed Gauss-Legendre products.

    Volumes of polynomial cells are exact; lengths and areas are roots and need more points.
    """
    n = 16 if shape in ('line', 'tri', 'quad') else 8
    x, w = np.polynomial.legendre.leggauss(n)
    u, wu = 0.5 * (x + 1.0), 0.5 * w
    if shape == 'line':
        return np.array([[a, 0, 0] for a in x]), w
    if shape == 'quad':
        return (np.array([[a, b, 0] for a in x for b in x]),
                np.array([p * q for p in w for q in w]))
    if shape == 'hex':
        return (np.array([[a, b, c] for a in x for b in x for c in x]),
                np.array([p * q * r for p in w for q in w for r in w]))
    tri = [((a * (1 - b), b), p * q * (1 - b)) for a, p in zip(u, wu) for b, q in zip(u, wu)]
    if shape == 'tri':
        return np.array([[*a, 0] for a, _ in tri]), np.array([p for _, p in tri])
    if shape == 'prism':
        return (np.array([[*a, b] for a, _ in tri for b in x]),
                np.array([p * q for _, p in tri for q in w]))
    if shape == 'tet':
        return (np.array([[a[0] * (1 - c), a[1] * (1 - c), c] for a, _ in tri for c in u]),
                np.array([p * r * (1 - c) ** 2 for _, p in tri for c, r in zip(u, wu)]))
    if shape == 'pyramid':
        return (np.array([[a * (1 - c), b * (1 - c), c] for a in x for b in x for c in u]),
                np.array([p * q * r * (1 - c) ** 2 for p in w for q in w for c, r in zip(u, wu)]))
    return np.zeros((1, 3)), np.zeros(1)


def main():
    mesh_file, expected_file = sys.argv[1:3]
    expected = {}
    with open(expected_file) as f:
        for line in f:
            number, _, shape, order, dim, measure, _ = line.split()
            expected[int(number)] = (shape, int(order), int(dim), float(measure))
    gmsh.initialize()
    gmsh.option.setNumber('General.Terminal', 0)
    gmsh.open(mesh_file)
    problems = []
    seen = set()
    for dim, tag in gmsh.model.getEntities():
        types, numbers, _ = gmsh.model.mesh.getElements(dim, tag)
        for kind, of_kind in zip(types, numbers):
            shape = expected[int(of_kind[0])][0]
            points, weights = rule(shape)
            seen.update(int(n) for n in of_kind)
            # Gmsh 4.8 cannot evaluate prisms of order 3 and 4; they have a test of their own.
            if dim == 0 or (shape == 'prism' and expected[int(of_kind[0])][1] > 2):
                continue
            _, det, _ = gmsh.model.mesh.getJacobians(kind, points.flatten().tolist(), tag)
            measures = np.array(det).reshape(len(of_kind), -1) @ weights
            for number, measure in zip(of_kind, measures):
                wanted = expected[int(number)]
                if wanted[2] != dim or abs(measure - wanted[3]) > TOLERANCE * abs(wanted[3]):
                    problems.append(f'{wanted[0]} of order {wanted[1]}: {measure}, not {wanted[3]}')
    if seen != set(expected):
        problems.append(f'{len(seen)} elements instead of {len(expected)}')
    gmsh.finalize()
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
