"""Reads a HOPR mesh (HDF5) by that format's own rules and compares sizes and nodes with a list.

usage: read_hopr.py MESH.h5 ORDER EXPECTED.txt
Checks the links between sides: neighbours name each other, the flip leads to the same node, and the sides of
the two are one polynomial. Ends with 77 without NumPy and HDF5.
"""
import sys

try:
    import hdf5_arrays
    import high_order
    import numpy as np
except ImportError:
    sys.exit(77)

SHAPES = {4: 'tet', 5: 'pyramid', 6: 'prism', 8: 'hex'}
# Corners as in CGNS, from 1.
CORNERS = {
    'tet': [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    'pyramid': [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)],
    'prism': [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    'hex': [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
}
SIDES = {
    'tet': ['132', '124', '234', '314'],
    'pyramid': ['1432', '125', '235', '345', '415'],
    'prism': ['1254', '2365', '3146', '132', '456'],
    'hex': ['1432', '1265', '2376', '3487', '1584', '5678'],
}


class Side:
    """A side of a cell in its own coordinates: origin in its first corner."""

    def __init__(self, cell, corners):
        self.shape = 'tri' if len(corners) == 3 else 'quad'
        at = [np.array(CORNERS[cell.shape][int(c) - 1], float) for c in corners]
        self.cell, self.origin, self.a, self.b = cell, at[0], at[1] - at[0], at[-1] - at[0]

    def at(self, rs):
        return self.cell.at(self.origin + rs[:, :1] * self.a + rs[:, 1:2] * self.b)

    def corner(self, i):
        ends = [(0, 0, 0), (1, 0, 0), (0, 1, 0)] if self.shape == 'tri' else \
            [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        return self.at(np.array([ends[i]], float))[0]

    def measure(self):
        return high_order.cube_measure(lambda r, s, t: self.at(np.stack(
            np.broadcast_arrays(*high_order.collapse(self.shape, r, s, 0.0 * r)), 1)), 2)


def main():
    path, order, expected = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    try:
        sets, attributes = hdf5_arrays.read(path)
    except ImportError:
        return 77
    number = {k: v.ravel()[0] for k, v in attributes.items()}
    elements, sides = sets['ElemInfo'], sets['SideInfo']
    coordinates, ids = sets['NodeCoords'], sets['GlobalNodeIDs']
    assert number['Ngeo'] == order and number['FEMconnect'] == b'OFF'
    assert elements.shape == (number['nElems'], 6) and sides.shape == (number['nSides'], 5)
    assert coordinates.shape == (number['nNodes'], 3) and ids.shape == (number['nNodes'],)
    assert len(np.unique(ids)) == number['nUniqueNodes'] == ids.max() and ids.min() == 1
    assert len(np.unique(np.abs(sides[:, 1]))) == number['nUniqueSides']
    names = [n.decode().rstrip() for n in sets['BCNames']]
    assert names == ['wall', 'far & <away>'] and sets['BCNames'].dtype == 'S255', names
    assert sets['BCType'].shape == (number['nBCs'], 4) and len(names) == number['nBCs']
    # One number, one place.
    first = np.unique(ids, return_index=True)[1]
    assert np.array_equal(coordinates, coordinates[first][ids - 1])

    cells, own_sides, next_side, next_node = [], [], 0, 0
    counts = {}
    for kind, _, side_from, side_to, node_from, node_to in elements:
        shape = SHAPES[kind % 10]
        assert kind // 100 == (1 if order == 1 else 2)
        counts[kind] = counts.get(kind, 0) + 1
        assert (side_from, node_from) == (next_side, next_node)
        next_side, next_node = side_to, node_to
        assert side_to - side_from == len(SIDES[shape])
        cell = high_order.Cell(shape, order, high_order.lattice(shape, order), coordinates[node_from:node_to])
        cells.append(cell)
        own_sides.append([Side(cell, s) for s in SIDES[shape]])
    assert (next_side, next_node) == (len(sides), len(coordinates))
    assert {k: n for k, n in sets['ElemCounter'] if n} == counts

    patches = []
    lattices = {s: high_order.lattice(s, order + 1) for s in ('tri', 'quad')}
    for e, (_, _, side_from, side_to, _, _) in enumerate(elements):
        for local, (kind, name, neighbour, link, condition) in enumerate(sides[side_from:side_to]):
            side = own_sides[e][local]
            assert kind == ({'tri': 3, 'quad': 14} if order == 1 else {'tri': 23, 'quad': 24})[side.shape]
            if neighbour == 0:
                assert link == 0 and name > 0 and 1 <= condition <= len(names)
                patches.append(side)
                continue
            assert condition == 0
            its, flip = link // 10 - 1, link % 10
            row = sides[elements[neighbour - 1][2] + its]
            assert row[1] == -name and row[2] == e + 1
            assert row[3] == 10 * (local + 1) + flip
            other = own_sides[neighbour - 1][its]
            assert other.shape == side.shape
            assert np.linalg.norm(side.corner(0) - other.corner(flip - 1)) < 1e-13
            # Its corners run the other way from there.
            n = 3 if side.shape == 'tri' else 4
            for i in range(n):
                assert np.linalg.norm(side.corner(i) - other.corner((flip - 1 - i) % n)) < 1e-13
            # The same set of points: a symmetric lattice does not mind the axes.
            a, b = side.at(lattices[side.shape]), other.at(lattices[side.shape])
            gaps = np.linalg.norm(a[:, None] - b[None], axis=2)
            assert gaps.min(axis=0).max() < 1e-12 and gaps.min(axis=1).max() < 1e-12
    return 1 if high_order.compare(cells, patches, order, expected) else 0


if __name__ == '__main__':
    sys.exit(main())
