"""Pages that are written from Python."""
import pytest

import camber


def has_deviation(path):
    return '"has_deviation":true' in path.read_text()


def test_a_result_writes_its_page_with_the_deviation(curved, tmp_path):
    assert curved.write_page(tmp_path / "result.html") is None
    page = (tmp_path / "result.html").read_text()
    assert page.lower().startswith("<!doctype html>")
    assert has_deviation(tmp_path / "result.html")


def test_a_result_without_cad_writes_its_page_too(ball, tmp_path):
    camber.curve(ball.mesh, order=2).write_page(tmp_path / "own.html")
    assert has_deviation(tmp_path / "own.html")


@pytest.mark.parametrize("geometry", ["none", "cad", "sphere:0,0,0,1"])
def test_a_page_of_any_mesh(ball, geometry, tmp_path):
    given = {"none": None, "cad": ball.geometry}.get(geometry) or (
        None if geometry == "none" else camber.Geometry(geometry))
    camber.page(ball.mesh, tmp_path / "mesh.html", given)
    assert has_deviation(tmp_path / "mesh.html") == (geometry != "none")


def test_a_page_is_not_disturbed_by_a_later_run_on_the_same_geometry(ball, curved, tmp_path):
    curved.write_page(tmp_path / "before.html")
    camber.check(ball.mesh, ball.geometry, unit="mm")
    curved.write_page(tmp_path / "after.html")
    assert (tmp_path / "before.html").read_bytes() == (tmp_path / "after.html").read_bytes()


def test_what_cannot_be_written_is_a_file_error_and_leaves_nothing(ball, tmp_path):
    with pytest.raises(camber.FileError):
        camber.page(ball.mesh, tmp_path / "missing" / "mesh.html")
    with pytest.raises(camber.OptionError):
        camber.page(ball.mesh, tmp_path / "mesh.html", ball.geometry, unit="furlong")
    assert not list(tmp_path.iterdir())
