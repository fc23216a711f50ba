"""Curving, checking, errors, progress, threads."""
import ast
import pathlib
import subprocess
import threading
import time

import numpy as np
import pytest

import camber
from camber import _camber


def test_the_lines_of_the_documentation_run(ball, tmp_path):
    mesh = camber.read(str(ball.mesh_path))
    geometry = camber.Geometry(str(ball.cad_path))
    result = camber.curve(mesh, geometry, order=4)
    result.write(tmp_path / "ball.msh")
    assert result.is_certified and result.report().ok
    assert "3653 of 3653 certified" in str(result.report())


def test_what_was_written_passes_check_in_memory_and_from_the_file(ball, curved, tmp_path):
    curved.write(tmp_path / "ball.msh")
    for mesh in (curved.mesh, camber.read(tmp_path / "ball.msh")):
        report = camber.check(mesh, ball.geometry)
        assert report.ok, report
        assert report.data["validity"]["certified"] == 3653
        assert report.data["validity"]["min_scaled_jacobian"] == curved.certificates.min()


def test_check_finds_a_cell_that_was_turned_inside_out(curved, tmp_path):
    curved.write(tmp_path / "ball.msh")
    mesh = camber.read(tmp_path / "ball.msh")
    tets = next(b for b in mesh.blocks if b.shape == "tet")
    corners = mesh.points[tets.nodes[0][[0, 1]]]
    mesh.points[tets.nodes[0][[0, 1]]] = corners[::-1]
    report = camber.check(mesh)
    assert report.status == "not_certified" and not report.ok


def test_runs_on_one_geometry_give_the_same_bits_for_any_number_of_threads(ball, curved):
    again = camber.curve(ball.mesh, ball.geometry, order=3, threads=1)
    assert np.array_equal(again.nodes, curved.nodes)


def test_options_reach_the_run(ball):
    result = camber.curve(ball.mesh, ball.geometry, order=2, uniform=True, smooth="none",
                          deviation=0.05, deviation_length=0.3)
    assert result.orders.max() == 2
    volume = [b for b in result.mesh.blocks if b.shape in ("tet", "pyramid", "prism", "hex")]
    assert {b.order for b in volume} == {2}
    assert result.report().data["options"]["deviation_length"] == "0.3"


@pytest.mark.parametrize("options", [
    {"order": 7}, {"order": 2, "min_order": 3}, {"deviation": 0.0}, {"deviation_length": "foot"},
    {"deviation_length": -1.0}, {"propagate": "far"}, {"smooth": "more"}, {"quality": 2.0},
    {"unit": "furlong"}, {"link": "guess"}, {"patches": {"ball": "sticky"}}, {"patches": {"nowhere": "free"}}])
def test_wrong_options_are_named(ball, options):
    with pytest.raises(camber.OptionError) as caught:
        camber.curve(ball.mesh, ball.geometry, **options)
    assert caught.value.what and caught.value.where and caught.value.remedy


@pytest.mark.parametrize("link", ["tags", "shape"])
def test_the_link_can_be_the_tags_or_the_shape(ball, curved, link):
    result = camber.curve(ball.mesh, ball.geometry, order=3, link=link)
    assert result.is_certified
    assert np.array_equal(result.orders, curved.orders)


def test_a_mesh_without_cad_is_curved_onto_itself(ball):
    result = camber.curve(ball.mesh, order=3)
    assert result.is_certified and result.orders.max() > 1
    assert result.report().data["link"]["method"] == "mesh"
    assert camber.curve(ball.mesh, order=3, feature_angle=1.0).orders.max() == 1  # all is sharp


def test_an_analytic_surface_can_be_the_geometry(ball):
    result = camber.curve(ball.mesh, camber.Geometry("sphere:0,0,0,1"), order=3)
    assert result.is_certified
    assert np.nanmax(result.deviations) < 1e-3
    with pytest.raises(camber.OptionError):
        camber.Geometry("sphere:0,0,0")


def test_a_patch_can_name_its_cad_faces(ball):
    result = camber.curve(ball.mesh, ball.geometry, order=2, link="shape",
                          patches={"ball": ["face_1"]})
    assert result.is_certified and result.orders.max() == 2


def test_families_of_a_cgns_mesh_link_it_to_the_cad(ball, tmp_path):
    # The package stands beside the program in the build tree.
    program = pathlib.Path(camber.__file__).parents[2] / "apps" / "camber" / "camber"
    if not program.exists():
        pytest.skip(f"{program} is not there")
    linear = tmp_path / "linear.cgns"
    subprocess.run([program, "curve", ball.mesh_path, "-g", ball.cad_path, "--order", "1",
                    "-o", linear, "-q"], check=True)
    result = camber.curve(camber.read(linear), ball.geometry, order=2)
    assert result.report().data["link"]["method"] == "families"
    assert "name the CAD faces of" in result.report().data["link"]["reason"]
    by_shape = camber.curve(camber.read(linear), ball.geometry, order=2, link="shape")
    assert by_shape.report().data["link"]["method"] == "shape"


def test_a_missing_file_says_what_where_and_what_to_do():
    with pytest.raises(camber.FileError) as caught:
        camber.read("nowhere.msh")
    error = caught.value
    assert isinstance(error, camber.Error)
    assert "nowhere.msh" in error.where and error.what and error.remedy
    assert all(part in str(error) for part in (error.what, error.where, error.remedy))
    with pytest.raises(camber.FileError):
        camber.Geometry("nowhere.step")


def test_a_mesh_that_does_not_fit_the_cad_is_a_geometry_error(ball):
    mesh = camber.read(ball.mesh_path)
    mesh.points[:] += 100.0
    with pytest.raises(camber.GeometryError):
        camber.curve(mesh, ball.geometry)


def test_a_mesh_without_cells_is_a_mesh_error(ball):
    mesh = camber.Mesh([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [camber.block("tri", [[0, 1, 2]], 1)])
    with pytest.raises(camber.MeshError):
        camber.curve(mesh, ball.geometry)
    with pytest.raises(camber.MeshError):
        camber.check(mesh)


def test_other_things_than_a_mesh_are_a_type_error(ball):
    with pytest.raises(TypeError, match="camber.Mesh"):
        camber.curve(str(ball.mesh_path), ball.geometry)


def test_nothing_is_written_where_it_cannot_be(curved, tmp_path):
    with pytest.raises(camber.FileError):
        curved.write(tmp_path / "missing" / "ball.msh")
    with pytest.raises(camber.FileError):
        curved.write(tmp_path / "ball.unknown")
    assert list(tmp_path.iterdir()) == []


def test_progress_is_called_with_stages_up_to_the_end(ball):
    calls = []
    camber.curve(ball.mesh, ball.geometry, order=2,
                 progress=lambda stage, fraction: calls.append((stage, fraction)))
    assert {"associate", "place", "elevate"} <= {stage for stage, _ in calls}
    assert all(0.0 <= fraction <= 1.0 for _, fraction in calls) and calls[-1][1] == 1.0


def test_what_the_callback_raises_cancels_the_run_and_arrives(ball):
    class Enough(Exception):
        pass

    stages = []

    def stop(stage, fraction):
        stages.append(stage)
        if stage == "place":
            raise Enough("stopped")

    with pytest.raises(Enough, match="stopped"):
        camber.curve(ball.mesh, ball.geometry, progress=stop)
    assert stages[-1] == "place"
    assert camber.curve(ball.mesh, ball.geometry, order=2).is_certified  # and all is usable


def test_other_threads_run_while_a_mesh_is_curved(ball):
    ticks, finished = [], threading.Event()

    def tick():
        while not finished.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    clock = threading.Thread(target=tick)
    clock.start()
    begin = time.perf_counter()
    camber.curve(ball.mesh, ball.geometry, order=4)
    end = time.perf_counter()
    finished.set()
    clock.join()
    during = [t for t in ticks if begin + 0.1 * (end - begin) < t < end - 0.1 * (end - begin)]
    assert len(during) >= 5


def test_two_threads_may_share_one_geometry(ball, curved):
    results = [None, None]

    def run(i):
        results[i] = camber.curve(ball.mesh, ball.geometry, order=3)

    threads = [threading.Thread(target=run, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        assert np.array_equal(result.nodes, curved.nodes)


def test_geometry_counts_its_entities(ball):
    assert ball.geometry.count(2) == 1
    assert isinstance(ball.geometry.name(2, 1), str)
    with pytest.raises(camber.GeometryError):
        ball.geometry.name(2, 99)
    with pytest.raises(camber.GeometryError):
        ball.geometry.count(5)


def test_the_stubs_name_what_the_native_module_has():
    stub = ast.parse((pathlib.Path(camber.__file__).parent / "_camber.pyi").read_text())
    names = {}
    for node in stub.body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = {f.name for f in node.body if isinstance(f, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            names[node.name] = None
    native = {n for n in dir(_camber) if not n.startswith("__")}
    assert native == set(names)
    for name, members in names.items():
        if members is not None:
            has = {m for m in vars(getattr(_camber, name))
                   if not m.startswith("_") or m == "__init__"}
            assert has - {"__init__"} == members - {"__init__"}, name


def test_everything_public_has_a_docstring():
    for name in camber.__all__:
        thing = getattr(camber, name)
        assert name == "__version__" or thing.__doc__, name
