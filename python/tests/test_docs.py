"""The Python code of the documentation runs as it is printed."""
import os
import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)


@pytest.mark.parametrize("code", CODE, ids=range(len(CODE)))
def test_code_of_the_documentation_runs(code, tmp_path, monkeypatch, capsys):
    os.symlink(ROOT / "cases", tmp_path / "cases")
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "docs/python.md", "exec"), {})
    assert "certified, 0 invalid, 0 undecided" in capsys.readouterr().out


def test_the_documentation_has_code():
    assert len(CODE) >= 2
