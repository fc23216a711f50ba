"""Reads a Nektar++ geometry (XML, text) by that format's own rules and compares sizes and nodes with a list.

usage: read_nektar.py MESH.xml ORDER EXPECTED.txt
Faces are known by their edges and cells by their faces, as in the file; corners follow from what they share.
Checks that collapsed corners agree and that cells are right-handed; a cell's volume is the flux of x/3 through
its faces, as there is nothing else that shapes it. Ends with 77 without NumPy.
"""
import sys
import xml.etree.ElementTree as ET

try:
    import numpy as np
    import high_order
except ImportError:
    sys.exit(77)

# Corners of the local faces; triangles collapse into their last corner.
FACES = {
    'A': ['012', '013', '123', '023'],
    'P': ['0123', '014', '124', '324', '034'],
    'R': ['0123', '014', '1254', '325', '0354'],
    'H': ['0123', '0154', '1265', '3267', '0374', '4567'],
}


def numbers(text, kind=int):
    return [kind(w) for w in text.split()]


def corners_of_face(edges, edge_vertices):
    """Corners of a face from its edges: corner i is where edge i - 1 meets edge i."""
    n = len(edges)
    corners = []
    for i in range(n):
        common = set(edge_vertices[edges[i - 1]]) & set(edge_vertices[edges[i]])
        assert len(common) == 1, edges
        corners.append(common.pop())
    return corners


def corners_of_cell(kind, faces, face_corners):
    """Each local corner is the one vertex that exactly its faces share."""
    count = 1 + max(int(c) for f in FACES[kind] for c in f)
    corners = []
    for c in range(count):
        with_it = [set(face_corners[g]) for f, g in zip(FACES[kind], faces) if str(c) in f]
        without = [set(face_corners[g]) for f, g in zip(FACES[kind], faces) if str(c) not in f]
        common = set.intersection(*with_it).difference(*without)
        assert len(common) == 1, (kind, c, common)
        corners.append(common.pop())
    for f, g in zip(FACES[kind], faces):
        assert {corners[int(c)] for c in f} == set(face_corners[g])
        if len(f) == 3:
            assert corners[int(f[2])] == face_corners[g][2], 'collapsed corners differ'
    return corners


def face_points(kind, p):
    """Reference points of the nodes of a curved face in the file's order."""
    if kind == 'Q':
        return [(i / p, j / p, 0) for j in range(p + 1) for i in range(p + 1)]
    points = [(0, 0), (p, 0), (0, p)]
    points += [(i, 0) for i in range(1, p)]
    points += [(p - i, i) for i in range(1, p)]
    points += [(0, p - i) for i in range(1, p)]
    points += [(i, j) for j in range(1, p) for i in range(1, p - j)]
    return [(i / p, j / p, 0) for i, j in points]


class Solid:
    def __init__(self, shape, flux):
        self.shape, self.flux = shape, flux

    def measure(self):
        return self.flux


def flux(face, sign):
    """Integral of x . n / 3 over the face."""
    x, w, d = high_order.X, high_order.W, high_order.D
    r, s = (c.ravel() for c in np.meshgrid(x, x, indexing='ij'))
    xi = np.stack(np.broadcast_arrays(*high_order.collapse(face.shape, r, s, 0.0 * r)), 1)
    values = face.at(xi).reshape(len(x), len(x), 3)
    normal = np.cross(np.einsum('ai,ijc->ajc', d, values), np.einsum('aj,ijc->iac', d, values))
    return sign * (w @ np.einsum('ijc,ijc->ij', normal, values) @ w) / 3.0


def outward(kind, face, corners, x):
    """Sign that makes the local face's own normal point out, for a right-handed cell."""
    a, b, c = (x[corners[int(face[i])]] for i in (0, 1, len(face) - 1))
    centre = np.mean([x[v] for v in corners], axis=0)
    return 1.0 if np.dot(np.cross(b - a, c - a), a - centre) > 0 else -1.0


def main():
    path, order, expected = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    geometry = ET.parse(path).getroot().find('GEOMETRY')
    assert geometry.attrib == {'DIM': '3', 'SPACE': '3'}
    x = {int(v.get('ID')): np.array(numbers(v.text, float)) for v in geometry.find('VERTEX')}
    edge_vertices = {int(e.get('ID')): numbers(e.text) for e in geometry.find('EDGE')}
    kinds = {int(f.get('ID')): f.tag for f in geometry.find('FACE')}
    face_edges = {int(f.get('ID')): numbers(f.text) for f in geometry.find('FACE')}
    face_corners = {f: corners_of_face(e, edge_vertices) for f, e in face_edges.items()}
    edge_curve, face_curve = {}, {}
    curved = geometry.find('CURVED')
    for c in curved if curved is not None else []:
        points = np.array(numbers(c.text, float)).reshape(-1, 3)
        assert len(points) == int(c.get('NUMPOINTS'))
        if c.tag == 'E':
            assert c.get('TYPE') == 'PolyEvenlySpaced' and len(points) == order + 1
            edge = int(c.get('EDGEID'))
            for end, v in zip((0, -1), edge_vertices[edge]):
                assert np.array_equal(points[end], x[v])
            edge_curve[edge] = points
        else:
            face = int(c.get('FACEID'))
            assert c.get('TYPE') == ('NodalTriEvenlySpaced' if kinds[face] == 'T' else
                                     'PolyEvenlySpaced')
            face_curve[face] = points

    faces = {}
    for f, corners in face_corners.items():
        shape = 'tri' if kinds[f] == 'T' else 'quad'
        n = len(corners)
        ends = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)] if n == 3 else
                        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
        if f in face_curve:
            faces[f] = high_order.Cell(shape, order, face_points(kinds[f], order), face_curve[f])
        else:
            faces[f] = high_order.Cell(shape, 1, ends, [x[v] for v in corners])
        for i, e in enumerate(face_edges[f]):  # the edges that belong to it are its own
            a, b = corners[i], corners[(i + 1) % n]
            assert set((a, b)) == set(edge_vertices[e])
            if f in face_curve:
                assert e in edge_curve, 'a curved face without a curved edge'
            s = np.linspace(0, 1, order + 1)[:, None]
            on_face = faces[f].at((1 - s) * ends[i] + s * ends[(i + 1) % n])
            along = edge_curve.get(e, (1 - s) * x[edge_vertices[e][0]] + s * x[edge_vertices[e][1]])
            if edge_vertices[e][0] != a:
                along = along[::-1]
            assert np.abs(on_face - along).max() < 1e-11, np.abs(on_face - along).max()

    cells, element_kind, used = [], {}, set()
    for element in geometry.find('ELEMENT'):
        kind, own = element.tag, numbers(element.text)
        element_kind[int(element.get('ID'))] = kind
        used.update(own)
        corners = corners_of_cell(kind, own, face_corners)
        if kind == 'A':  # what Nektar++ asks of the first edges of a tet's faces
            assert face_edges[own[0]][0] == face_edges[own[1]][0]
            assert all(face_edges[f][0] in face_edges[own[0]] for f in own[1:])
        up = x[corners[{'A': 3, 'P': 4, 'R': 4, 'H': 4}[kind]]]
        side = x[corners[{'A': 2, 'P': 3, 'R': 3, 'H': 3}[kind]]]
        base = x[corners[0]]
        frame = np.array([x[corners[1]] - base, side - base, up - base])
        assert np.linalg.det(frame) > 0, (kind, 'left-handed')
        total = 0.0
        for f, g in zip(FACES[kind], own):
            mine, its = [corners[int(c)] for c in f], face_corners[g]
            n = len(its)
            along = mine[(mine.index(its[0]) + 1) % n] == its[1]
            total += flux(faces[g], outward(kind, f, corners, x) * (1.0 if along else -1.0))
        cells.append(Solid({'A': 'tet', 'P': 'pyramid', 'R': 'prism', 'H': 'hex'}[kind], total))

    patches, in_domain = [], set()
    domain = geometry.find('DOMAIN').text.strip()
    low, _, high = domain[2:-1].partition('-')
    for c in geometry.find('COMPOSITE'):
        kind, ids = c.text.strip()[0], []
        for part in c.text.strip()[2:-1].split(','):
            a, _, b = part.partition('-')
            ids += range(int(a), int(b or a) + 1)
        if kind == 'F':
            patches += [faces[i] for i in ids]
            assert c.get('NAME') in ('wall', 'far & <away>')
        else:
            assert all(element_kind[i] == kind for i in ids)
            assert c.get('NAME') in ('left', 'right')
            if int(low) <= int(c.get('ID')) <= int(high or low):
                in_domain.update(ids)
    assert in_domain == set(element_kind), 'the domain is not the mesh'
    return 1 if high_order.compare(cells, patches, order, expected, list(faces.values())) else 0


if __name__ == '__main__':
    sys.exit(main())
