"""Polynomial cells for the independent readers: nodes in, volumes, areas and points out.

Reference shapes: unit interval, triangle and tetrahedron with the corner 0 at the origin, unit square and
cube, prism = triangle x interval, pyramid with the unit square as base and the apex over the corner 0.
Nothing here knows Camber's tables: a cell is what interpolates its nodes in a space of polynomials.
"""
import numpy as np

N = 14  # Gauss points a direction


def gauss_01(n):
    x, w = np.polynomial.legendre.leggauss(n)
    x, w = 0.5 * (x + 1.0), 0.5 * w
    a = np.array([np.prod([x[i] - x[j] for j in range(n) if j != i]) for i in range(n)])
    d = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            if i != j:
                d[i, j] = a[i] / (a[j] * (x[i] - x[j]))
        d[i, i] = -d[i].sum()
    return x, w, d


X, W, D = gauss_01(N)


def collapse(shape, r, s, t):
    """Unit cube -> reference shape."""
    if shape == 'tri':
        return r * (1 - s), s, 0 * t
    if shape == 'prism':
        return r * (1 - s), s, t
    if shape == 'tet':
        return r * (1 - s) * (1 - t), s * (1 - t), t
    if shape == 'pyramid':
        return r * (1 - t), s * (1 - t), t
    return r, s, t


def _powers(x, n):
    return np.power.outer(x, np.arange(n + 1))


def _pyramid_space(p, bergot):
    """Rows: coefficients of x^a y^b t^c on the unit cube (base coordinates, height) of a basis.

    Bergot, Cohen and Durufle: X^i Y^j (1-t)^max(i,j) t^k, k <= p - max(i,j). Fuentes et al.: all of degree
    p a direction that are one value at the apex and have the triangle's polynomials as traces.
    """
    n = p + 1

    def side(i, k):  # coefficients of (1-t)^i t^k
        c = np.polynomial.polynomial.polypow([1.0, -1.0], i)
        return np.concatenate([np.zeros(k), c, np.zeros(n)])[:n]

    if bergot:
        rows = []
        for i in range(n):
            for j in range(n):
                for k in range(p - max(i, j) + 1):
                    c = np.zeros((n, n, n))
                    c[i, j] = side(max(i, j), k)
                    rows.append(c.ravel())
        return np.array(rows)
    # Constraints on a coefficient array: what is left of a trace outside of the allowed span is zero.
    allowed = []
    for i in range(n):
        for k in range(p - i + 1):
            c = np.zeros((n, n))
            c[i] = side(i, k)
            allowed.append(c.ravel())
    q, _ = np.linalg.qr(np.array(allowed).T)
    outside = np.eye(n * n) - q @ q.T
    blocks = []
    for a in range(n):
        for b in range(n):
            for c in range(n):
                e = np.zeros((n, n, n))
                e[a, b, c] = 1.0
                apex = e.sum(axis=2).ravel()[1:]  # at t = 1 nothing but the constant
                traces = [e[0], e.sum(axis=0), e[:, 0], e.sum(axis=1)]
                blocks.append(np.concatenate([apex] + [outside @ f.ravel() for f in traces]))
    _, sizes, v = np.linalg.svd(np.array(blocks).T)
    space = v[np.sum(sizes > 1e-10):]
    assert len(space) == p ** 3 + 3 * p + 1, len(space)
    return space


_spaces = {}


def basis(shape, p, xi, space='bergot'):
    """Values of a basis at points xi (n,3), (n,functions)."""
    x, y, z = np.asarray(xi, float).T
    if shape == 'pyramid':
        key = (p, space)
        if key not in _spaces:
            _spaces[key] = _pyramid_space(p, space == 'bergot')
        h = np.where(z < 1.0, 1.0 - z, 1.0)
        a, b, c = _powers(x / h, p), _powers(y / h, p), _powers(z, p)
        cube = np.einsum('ni,nj,nk->nijk', a, b, c).reshape(len(x), -1)
        return cube @ _spaces[key].T
    a, b, c = _powers(x, p), _powers(y, p), _powers(z, p)
    columns = []
    for i in range(p + 1):
        for j in range(p + 1):
            for k in range(p + 1):
                if shape in ('line', 'quad', 'tri') and k > 0 or shape == 'line' and j > 0:
                    continue
                if shape in ('tri', 'prism') and i + j > p or shape == 'tet' and i + j + k > p:
                    continue
                columns.append(a[:, i] * b[:, j] * c[:, k])
    return np.array(columns).T


class Cell:
    """The polynomial that takes the values x (n,3) at the reference points xi (n,3)."""

    def __init__(self, shape, p, xi, x, space='bergot'):
        self.shape, self.p, self.space = shape, p, space
        matrix = basis(shape, p, xi, space)
        assert matrix.shape[0] == matrix.shape[1], (shape, p, matrix.shape)
        self.coefficients = np.linalg.solve(matrix, np.asarray(x, float))

    def at(self, xi):
        return basis(self.shape, self.p, xi, self.space) @ self.coefficients

    def measure(self):
        dim = 2 if self.shape in ('tri', 'quad') else 3
        return cube_measure(lambda r, s, t: self.at(
            np.stack([np.broadcast_to(c, r.shape) for c in collapse(self.shape, r, s, t)], 1)), dim)


def cube_measure(f, dim):
    """Volume or area of the image of the unit cube or square under f(r, s, t) -> (n,3)."""
    ts = X if dim == 3 else np.zeros(1)
    r, s, t = (c.ravel() for c in np.meshgrid(X, X, ts, indexing='ij'))
    values = f(r, s, t).reshape(N, N, len(ts), 3)
    dr = np.einsum('ai,ijkc->ajkc', D, values)
    ds = np.einsum('aj,ijkc->iakc', D, values)
    if dim == 2:
        return W @ np.linalg.norm(np.cross(dr, ds), axis=-1)[:, :, 0] @ W
    dt = np.einsum('ak,ijkc->ijac', D, values)
    return np.einsum('i,j,k,ijk', W, W, W, np.einsum('ijkc,ijkc->ijk', np.cross(dr, ds), dt))


def lattice(shape, p):
    """Equispaced points of the reference shape, (n,3)."""
    points = []
    for k in range(p + 1):
        for j in range(p + 1):
            for i in range(p + 1):
                flat = shape in ('tri', 'quad') and k > 0
                tri = shape in ('tri', 'prism') and i + j > p
                tet = shape == 'tet' and i + j + k > p
                pyramid = shape == 'pyramid' and max(i, j) + k > p
                if not (flat or tri or tet or pyramid):
                    points.append((i / p, j / p, k / p))
    return np.array(points)


def compare(cells, faces, order, expected_file, all_faces=None):
    """Compares with the lists of write_sizes (hybrid_mesh.hpp). Returns the number of problems.

    Formats without nodes inside of cells give all their faces; the nodes are looked for on these.
    """
    expected = {'volume': [], 'area': [], 'node': [], 'inner': []}
    with open(expected_file) as f:
        for line in f:
            kind, *numbers = line.split()
            expected[kind].append([float(n) for n in numbers])
    problems = 0
    for kind, elements in (('volume', cells), ('area', faces)):
        found = np.sort([e.measure() for e in elements])
        wanted = np.sort(np.ravel(expected[kind]))
        if len(found) != len(wanted):
            print(f'{kind}: {len(found)} elements instead of {len(wanted)}')
            problems += 1
            continue
        tolerance = 1e-11 if kind == 'volume' else 1e-9  # areas are no polynomials
        worst = np.max(np.abs(found / wanted - 1.0))
        if not worst <= tolerance:
            print(f'{kind}: differs by {worst}: {found} instead of {wanted}')
            problems += 1
    found = np.concatenate([e.at(lattice(e.shape, order)) for e in all_faces or cells])
    wanted = np.array(expected['node'] + ([] if all_faces else expected['inner']))
    gaps = np.linalg.norm(found[:, None] - wanted[None], axis=2)
    for gap, what in ((gaps.min(axis=1).max(), 'a point that is no node'),
                      (gaps.min(axis=0).max(), 'a node that is missing')):
        if not gap <= 1e-11:
            print(f'{what}: {gap} away')
            problems += 1
    return problems
