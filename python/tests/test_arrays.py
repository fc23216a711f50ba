"""Arrays in and out."""
import gc
import resource

import numpy as np
import pytest

import camber

MILLION = 10**6
TET = [[0, 1, 2, 3]]


def one_tet(points=None, **more):
    if points is None:
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    return camber.Mesh(points, [camber.block("tet", TET, entity=1)], **more)


def test_a_million_points_go_in_and_come_out_without_a_copy():
    points = np.random.default_rng(1).random((MILLION, 3))
    points[:4] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    mesh = one_tet(points)
    assert np.shares_memory(mesh.points, points)
    assert mesh.points is points


def test_a_million_points_of_a_file_are_looked_at_where_camber_has_them(tmp_path):
    points = np.random.default_rng(2).random((MILLION, 3))
    points[:4] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    one_tet(points).write(tmp_path / "many.msh")
    mesh = camber.read(tmp_path / "many.msh")
    first, again = mesh._native().points, mesh._native().points
    assert first.shape[1] == 3 and np.shares_memory(first, again)
    assert np.shares_memory(mesh.points, first)


def test_a_view_keeps_its_owner_alive(ball):
    points = camber.read(ball.mesh_path).points
    gc.collect()
    assert np.array_equal(points, ball.mesh.points)


def test_points_of_a_mesh_from_a_file_can_be_changed_in_place(ball, tmp_path):
    mesh = camber.read(ball.mesh_path)
    mesh.points[:] *= 2.0
    mesh.write(tmp_path / "twice.msh")
    twice = camber.read(tmp_path / "twice.msh").points
    assert np.array_equal(np.sort(twice, axis=0), np.sort(2.0 * ball.mesh.points, axis=0))


def test_arrays_that_hold_indices_or_results_are_read_only(ball, curved):
    for array in (ball.mesh.blocks[0].nodes, curved.orders, curved.certificates, curved.nodes):
        with pytest.raises(ValueError):
            array[0] = 0


def test_result_arrays_agree_with_the_report(curved):
    data = curved.report().data
    assert len(curved.orders) == len(curved.cells) == len(curved.costs) == 3653
    assert curved.certificates.min() == data["validity"]["min_scaled_jacobian"] > 0
    assert curved.costs.min() == data["quality"]["cost"]["minimum"]
    assert np.nanmax(curved.deviations) == pytest.approx(data["surface"]["maximum"], rel=1e-12)
    assert set(np.unique(curved.orders)) <= {1, 2, 3} and curved.orders.max() > 1


def test_result_arrays_are_views(curved):
    for name in ("orders", "certificates", "costs", "deviations", "nodes", "vertices"):
        assert np.shares_memory(getattr(curved, name), getattr(curved, name)), name


def test_a_mesh_from_arrays_is_curved_to_the_same_bits_as_the_file(ball, curved):
    mesh = camber.Mesh(
        ball.mesh.points.copy(),
        [camber.block(b.shape, b.nodes_as("gmsh"), b.entity, b.order) for b in ball.mesh.blocks],
        names=ball.mesh.names, point_entity=ball.mesh.point_entity)
    again = camber.curve(mesh, ball.geometry, order=3)
    assert np.array_equal(again.nodes, curved.nodes)
    assert np.array_equal(again.orders, curved.orders)


def test_gmsh_order_and_lattice_order_are_permutations_of_one_another(curved):
    blocks = [b for b in curved.mesh.blocks if b.shape != "point"]
    assert {b.shape for b in blocks} >= {"tet", "pyramid", "prism", "hex"}
    for b in blocks:
        gmsh = camber.block(b.shape, b.nodes_as("gmsh"), b.entity, b.order)
        assert np.array_equal(gmsh.nodes_as("lattice"), b.nodes)


@pytest.mark.parametrize("node_order, is_cube", [("gmsh", True), ("lattice", False)])
def test_a_cube_with_corners_in_gmsh_order_is_a_cube(node_order, is_cube):
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    cube = camber.Mesh([[x, y, z] for z in (0, 1) for x, y in square],
                       [camber.block("hex", [list(range(8))], 1, node_order=node_order)])
    report = camber.check(cube)
    assert (report.data["validity"]["certified"] == 1) == is_cube
    if is_cube:
        assert report.data["validity"]["min_scaled_jacobian"] == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("points, blocks", [
    (np.zeros((4, 2)), lambda: [camber.block("tet", TET, 1)]),
    (np.full((4, 3), np.nan), lambda: [camber.block("tet", TET, 1)]),
    (np.zeros((3, 3)), lambda: [camber.block("tet", TET, 1)]),
    (np.zeros((4, 3)), lambda: [camber.block("tet", [[0, 1, 2]], 1)]),
    (np.zeros((4, 3)), lambda: [camber.block("tet", [[0, 1, 2, -1]], 1)]),
    (np.zeros((4, 3)), lambda: [camber.block("tet", [[0, 1, 2, 2**40]], 1)]),
    (np.zeros((4, 3)), lambda: [camber.block("tet", [[0.5, 1, 2, 3]], 1)]),
    (np.zeros((4, 3)), lambda: [camber.block("brick", TET, 1)]),
    (np.zeros((4, 3)), lambda: [camber.block("tet", TET, 1, order=9)]),
])
def test_wrong_arrays_are_refused_where_they_are_given(points, blocks):
    with pytest.raises(camber.MeshError):
        camber.Mesh(points, blocks())


def test_reading_and_looking_again_and_again_does_not_pile_up_memory(ball):
    def peak():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(20):
        camber.read(ball.mesh_path).points.sum()
    before = peak()
    for _ in range(200):
        camber.read(ball.mesh_path).points.sum()
    assert peak() - before < 20_000  # KiB; 200 meshes kept would be about 100 MB
