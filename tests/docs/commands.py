#!/usr/bin/python3
"""Runs every command that the documentation shows, and compares what it says the command prints.

usage: commands.py SOURCE_DIR CAMBER [FILE.md...]     prints one line a fault; exit code 1 if there is any.

A command is a line "    $ camber ..." or "    $ gmsh ..." (a backslash continues it); "   # exit code N" behind it
says that it ends otherwise than with 0. The indented lines below it are an excerpt of its output: each must
occur, in this order, up to white space. The commands of one file run one after the other in one empty folder that
has the bundled `cases` and an empty folder `out`.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

INDENT = "    "
PROGRAMS = ("camber", "gmsh")
EXIT_CODE = re.compile(r"\s+# exit code (\d+)$")
MINUTES = 5


class Step:
    def __init__(self, line, number):
        self.text, self.line, self.output = line, number, []

    def words(self):
        return shlex.split(EXIT_CODE.sub("", self.text))

    def exit_code(self):
        match = EXIT_CODE.search(self.text)
        return int(match[1]) if match else 0


def steps_of(text):
    steps, step = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith(INDENT + "$ "):
            step = Step(line[len(INDENT) + 2:], number)
            steps.append(step)
        elif step and step.text.endswith("\\"):
            step.text = step.text[:-1] + line.strip()
        elif step and line.startswith(INDENT):
            step.output.append(line)
        elif line.strip():
            step = None
    return steps


def missing_line(expected, printed):
    """The first expected line that does not occur in its turn, or None."""
    lines = iter(" ".join(line.split()) for line in printed.splitlines())
    for line in expected:
        if " ".join(line.split()) not in lines:
            return line.strip()
    return None


def run(step, folder, camber):
    words = step.words()
    if words[0] not in PROGRAMS:
        return f"'{words[0]}' is none of {', '.join(PROGRAMS)}"
    if words[0] == "camber":
        words[0] = camber
    done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=60 * MINUTES, check=False)
    if done.returncode != step.exit_code():
        return f"exit code {done.returncode}\n{done.stdout}"
    line = missing_line(step.output, done.stdout)
    return f"does not print: {line}\n{done.stdout}" if line else None


def check_file(path, root, camber):
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(root / "cases", pathlib.Path(folder) / "cases")
        (pathlib.Path(folder) / "out").mkdir()
        for step in steps_of(path.read_text()):
            fault = run(step, folder, camber)
            if fault:
                faults.append(f"{path.relative_to(root)}:{step.line}: {step.text}: {fault}")
    return faults


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    camber = str(pathlib.Path(sys.argv[2]).resolve())
    files = [root / name for name in sys.argv[3:]]
    files = files or [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    count = sum(len(steps_of(path.read_text())) for path in files)
    faults = [fault for path in files for fault in check_file(path, root, camber)]
    if count == 0:
        faults.append("no command was found")
    print("\n".join(faults) or f"{count} commands run as documented")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
