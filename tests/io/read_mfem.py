"""Reads a curved MFEM mesh v1.0 by that format's own rules and compares sizes and nodes with a list.

usage: read_mfem.py MESH.mesh ORDER EXPECTED.txt
Edges and faces are numbered as they appear in the list of elements; unknowns are those of the vertices,
edges (from the smaller vertex to the larger), faces (as the first element sees them) and elements. Ends with
77 without NumPy.
"""
import sys

try:
    import numpy as np
    import high_order
except ImportError:
    sys.exit(77)

SHAPES = {2: 'tri', 3: 'quad', 4: 'tet', 5: 'hex', 6: 'prism', 7: 'pyramid'}
CORNERS = {
    'tri': [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
    'quad': [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
    'tet': [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    'hex': [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
    'prism': [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    'pyramid': [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)],
}
EDGES = {
    'tri': '01 12 20', 'quad': '01 12 23 30', 'tet': '01 02 03 12 13 23',
    'hex': '01 12 32 03 45 56 76 47 04 15 26 37', 'prism': '01 12 20 34 45 53 03 14 25',
    'pyramid': '01 12 32 03 04 14 24 34',
}
FACES = {
    'tri': '012', 'quad': '0123', 'tet': '123 032 013 021', 'hex': '3210 0154 1265 2376 3047 4567',
    'prism': '021 345 0143 1254 2035', 'pyramid': '3210 014 124 234 304',
}


def lobatto(p):
    inner = np.polynomial.legendre.Legendre.basis(p).deriv().roots()
    return np.concatenate([[0.0], 0.5 + 0.5 * np.sort(np.real(inner)), [1.0]])


def edge_points(p):
    return lobatto(p)[1:-1]


def face_points(n, p):
    """(i, j) and coordinates in the axes corner 0 -> 1 and 0 -> last of the points inside a face."""
    x = lobatto(p)
    for j in range(1, p):
        for i in range(1, p if n == 4 else p - j):
            w = 1.0 if n == 4 else x[i] + x[j] + x[p - i - j]
            yield (i, j), (x[i] / w, x[j] / w)


def inner_points(shape, p):
    x = lobatto(p)
    points = []
    for k in range(1, p):
        for j in range(1, p):
            for i in range(1, p):
                if shape == 'hex':
                    points.append((x[i], x[j], x[k]))
                elif shape == 'pyramid':
                    points.append((x[i] * (1 - x[k]), x[j] * (1 - x[k]), x[k]))
                elif shape == 'prism' and i + j < p:
                    w = x[i] + x[j] + x[p - i - j]
                    points.append((x[i] / w, x[j] / w, x[k]))
                elif shape == 'tet' and i + j + k < p:
                    w = x[i] + x[j] + x[k] + x[p - i - j - k]
                    points.append((x[i] / w, x[j] / w, x[k] / w))
    return points


class Numbers:
    """Edges or faces by the set of their vertices, with the view of who came first."""

    def __init__(self):
        self.first_view, self.place, self.size = {}, {}, 0

    def add(self, vertices, unknowns):
        key = frozenset(vertices)
        if key not in self.place:
            self.place[key], self.first_view[key] = self.size, tuple(vertices)
            self.size += unknowns


def face_index(view, first_view, i, j, p):
    """Place of the point (i, j) of a view among the points of the first view."""
    n = len(view)
    if n == 3:
        weight = dict(zip(view, (p - i - j, i, j)))
        wanted = (weight[first_view[1]], weight[first_view[2]])
    else:
        corner = {view[0]: (0, 0), view[1]: (p, 0), view[2]: (p, p), view[3]: (0, p)}
        origin, a, b = (np.array(corner[first_view[c]]) for c in (0, 1, 3))
        d = np.array((i, j)) - origin
        wanted = (d @ (a - origin) // p, d @ (b - origin) // p)
    return [at for at, _ in face_points(n, p)].index(tuple(int(w) for w in wanted))


def read(path):
    with open(path) as f:
        assert f.readline().strip() == 'MFEM mesh v1.0'
        words = [w for line in f for w in line.split('#')[0].split()]
    at = 0

    def take(n=1):
        nonlocal at
        at += n
        return words[at - n:at]

    assert take(2) == ['dimension', '3']
    groups = {}
    for section in ('elements', 'boundary'):
        assert take() == [section]
        groups[section] = []
        for _ in range(int(take()[0])):
            attribute, kind = (int(w) for w in take(2))
            shape = SHAPES[kind]
            groups[section].append((attribute, shape, [int(w) for w in take(len(CORNERS[shape]))]))
    assert take() == ['vertices']
    vertices = int(take()[0])
    p = 1
    if words[at] == 'nodes':
        assert take(2) == ['nodes', 'FiniteElementSpace']
        assert take() == ['FiniteElementCollection:']
        name = take()[0]
        assert name.startswith('H1_3D_P')
        p = int(name[7:])
        assert take(4) == ['VDim:', '3', 'Ordering:', '1']
    else:
        assert take() == ['3']
    values = np.array([float(w) for w in words[at:]]).reshape(-1, 3)
    return groups, vertices, p, values


def main():
    path, order, expected = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    groups, vertices, p, values = read(path)
    assert p == order, (p, order)
    edges, faces = Numbers(), Numbers()
    for _, shape, v in groups['elements']:
        for e in EDGES[shape].split():
            edges.add([v[int(c)] for c in e], p - 1)
        for f in FACES[shape].split():
            view = [v[int(c)] for c in f]
            faces.add(view, len(list(face_points(len(view), p))))
    inner = vertices + edges.size + faces.size

    def cell(shape, v):
        nonlocal inner
        corners = np.array(CORNERS[shape], float)
        xi, x = [c for c in corners], [values[i] for i in v]
        for e in EDGES[shape].split():
            a, b = int(e[0]), int(e[1])
            first = vertices + edges.place[frozenset((v[a], v[b]))]
            for i, s in enumerate(edge_points(p)):
                xi.append((1 - s) * corners[a] + s * corners[b])
                x.append(values[first + (i if v[a] < v[b] else p - 2 - i)])
        for f in FACES[shape].split():
            c = [int(d) for d in f]
            view = [v[d] for d in c]
            key = frozenset(view)
            for (i, j), (r, s) in face_points(len(c), p):
                xi.append(corners[c[0]] + r * (corners[c[1]] - corners[c[0]]) +
                          s * (corners[c[-1]] - corners[c[0]]))
                x.append(values[vertices + edges.size + faces.place[key] +
                                face_index(view, faces.first_view[key], i, j, p)])
        for point in inner_points(shape, p) if len(corners[0]) == 3 else []:
            xi.append(np.array(point))
            x.append(values[inner])
            inner += 1
        return high_order.Cell(shape, p, np.array(xi), np.array(x), 'fuentes')

    cells = [cell(shape, v) for _, shape, v in groups['elements']]
    assert inner == len(values), (inner, len(values))
    patches = [cell(shape, v) for _, shape, v in groups['boundary']]
    if expected == '-':  # what is in the file, for looking at files of others
        print(sum(c.measure() for c in cells), sum(c.measure() for c in patches))
        return 0
    return 1 if high_order.compare(cells, patches, order, expected) else 0


if __name__ == '__main__':
    sys.exit(main())
