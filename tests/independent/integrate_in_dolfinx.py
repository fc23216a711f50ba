#!/usr/bin/python3
"""DOLFINx reads a .msh file of one order and one shape and integrates its volume and its surface.

usage: integrate_in_dolfinx.py MESH.msh ORDER SIZES.txt
SIZES.txt has lines "volume V" for every cell and "area A" for every boundary face (write_sizes in
tests/io/hybrid_mesh.hpp); their sums must agree to 1e-9. Ends with 77 where DOLFINx is not installed
(Debian: python3-dolfinx, about 600 MB with what it needs; so it is not in tools/packages.txt).
"""
import logging
import sys

try:
    import dolfinx
    import gmsh
    import numpy as np
    import ufl
    from dolfinx.io import gmshio
    from mpi4py import MPI
except ImportError as missing:
    print(f'not installed: {missing}')
    sys.exit(77)

logging.disable(logging.WARNING)  # of the form compiler

TOLERANCE = 1e-9
# Exact for the polynomials of volumes; areas are roots of polynomials, which these degrees resolve.
VOLUME_DEGREE, AREA_DEGREE = 12, 24


def main():
    path, order, sizes = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    wanted = {'volume': 0.0, 'area': 0.0}
    with open(sizes) as file:
        for line in file:
            kind, value = line.split()[:2]
            if kind in wanted:
                wanted[kind] += float(value)
    gmsh.initialize()
    gmsh.option.setNumber('General.Terminal', 0)
    gmsh.merge(path)
    mesh, _, facets = gmshio.model_to_mesh(gmsh.model, MPI.COMM_SELF, 0)
    gmsh.finalize()
    read_order = mesh.ufl_domain().ufl_coordinate_element().degree()
    one = dolfinx.fem.Constant(mesh, 1.0)

    def integral(measure, degree):
        form = dolfinx.fem.form(one * measure(domain=mesh, metadata={'quadrature_degree': degree}))
        return dolfinx.fem.assemble_scalar(form)

    found = {'volume': integral(ufl.dx, VOLUME_DEGREE), 'area': integral(ufl.ds, AREA_DEGREE)}
    problems = 0
    for kind, value in found.items():
        gap = abs(value / wanted[kind] - 1.0)
        print(f'{path}: order {read_order}, {kind} {value:.15g}, ours {wanted[kind]:.15g}, '
              f'relative difference {gap:.2g}')
        problems += not gap <= TOLERANCE
    mesh.topology.create_connectivity(2, 3)
    boundary = dolfinx.mesh.exterior_facet_indices(mesh.topology)
    if read_order != order or not np.array_equal(np.sort(facets.indices), np.sort(boundary)):
        print('another order, or the surface elements are not the boundary')
        problems += 1
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
