import pathlib

import pytest

import camber

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"


class Case:
    def __init__(self, name):
        self.mesh_path = CASES / name / "linear.msh"
        self.cad_path = CASES / name / "body.step"
        self.mesh = camber.read(self.mesh_path)
        self.geometry = camber.Geometry(self.cad_path)


@pytest.fixture(scope="session")
def ball():
    """All four shapes on a sphere."""
    return Case("ball")


@pytest.fixture(scope="session")
def curved(ball):
    return camber.curve(ball.mesh, ball.geometry, order=3)
