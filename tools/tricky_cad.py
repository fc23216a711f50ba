#!/usr/bin/python3
"""Meshes every CAD file of a folder with Gmsh's tets and curves each at order 3.

    tools/tricky_cad.py ../shared/cases/foreign/tricky-cad-gmsh ../shared/cases/foreign/tricky-cad-occt
    tools/tricky_cad.py FOLDER --link shape --json table.json

One row a file: cells, faces of the CAD, how the run ended, cells certified, scaled back, wall faces
that could not be placed, seconds. Camber runs in a process of its own with a limit of time (60 s) and
must end with exit code 0 or 3, or 2 and one error that says where: anything else (crash, hang, code
4) makes this program end with 1. What Gmsh cannot mesh is listed and left out. Needs gmsh.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CAD = {".step", ".stp", ".iges", ".igs", ".brep"}


def mesh(cad, out, divisions, limit):
    """Tets whose size is the model's diagonal over `divisions`, finer where the surface is curved;
    a message if that did not work."""
    script = f"""
import gmsh, math
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.open({str(cad)!r})
b = gmsh.model.getBoundingBox(-1, -1)
if not gmsh.model.getEntities(3): raise SystemExit("no volume")
gmsh.option.setNumber("Mesh.MeshSizeMax", math.dist(b[:3], b[3:]) / {divisions})
gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 10)
gmsh.option.setNumber("Mesh.SaveAll", 1)
gmsh.option.setNumber("Mesh.Binary", 1)
gmsh.model.mesh.generate(3)
if not any(len(t) for t in gmsh.model.mesh.getElements(3)[1]): raise SystemExit("no cells")
gmsh.write({str(out)!r})
"""
    try:
        done = subprocess.run([sys.executable, "-c", script], timeout=limit, capture_output=True,
                              text=True, check=False)
    except subprocess.TimeoutExpired:
        return f"Gmsh took over {limit:g} s"
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return f"Gmsh: {last[:70]}"
    return ""


def curve(camber, mesh_file, cad, arguments, folder):
    out, report = folder / "out.msh", folder / "report.json"
    for file in (out, report):
        file.unlink(missing_ok=True)
    start = time.perf_counter()
    try:
        done = subprocess.run(
            [camber, "curve", mesh_file, "-g", cad, "-o", out, "--order", str(arguments.order),
             "--link", arguments.link, "--json", report, "-q"], timeout=arguments.limit,
            capture_output=True, text=True, check=False)
    except subprocess.TimeoutExpired:
        return {"end": "HANG", "seconds": arguments.limit}
    row = {"code": done.returncode, "seconds": time.perf_counter() - start}
    if done.returncode not in (0, 2, 3):
        return row | {"end": f"CRASH {done.returncode}"}
    if done.returncode == 2:
        lines = done.stderr.strip().splitlines()
        return row | {"end": "refused" if len(lines) == 1 else "CRASH 2",
                      "message": lines[0] if lines else ""}
    data = json.loads(report.read_text())
    validity, surface = data["validity"], data["surface"]
    gained = surface["linear_maximum"] / surface["maximum"] if surface["maximum"] > 0 else 1.0
    return row | {"end": data["status"], "certified": validity["certified"],
                  "cells": sum(validity[k] for k in ("certified", "invalid", "undecided")),
                  "scaled": data["rescue"]["scaled_back"], "lowered": data["rescue"]["orders_lowered"],
                  "faces": surface["faces"], "over": surface["faces_over_deviation"],
                  "linear": surface["linear_maximum"], "curved": surface["maximum"],
                  "gained": gained, "warnings": data["warnings"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, nargs="+")
    parser.add_argument("--camber", default=str(ROOT / "build/release/apps/camber/camber"))
    parser.add_argument("--order", type=int, default=3)
    parser.add_argument("--link", default="auto", choices=["auto", "tags", "shape"])
    parser.add_argument("--divisions", type=float, default=12, help="of the model's diagonal")
    parser.add_argument("--limit", type=float, default=60, help="seconds a run may take")
    parser.add_argument("--mesh-limit", type=float, default=60)
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    files = sorted(f for folder in arguments.folder for f in folder.iterdir()
                   if f.suffix.lower() in CAD)
    if not files:
        sys.exit(f"no CAD files in {', '.join(map(str, arguments.folder))}")
    print(f"{'file':36} {'cells':>7} {'on CAD':>7} {'end':16} {'bad':>5} {'scaled':>6} "
          f"{'lowered':>7} {'over':>5} {'linear':>9} {'curved':>9} {'s':>6}")
    rows, failures = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for cad in files:
            message = mesh(cad, folder / "in.msh", arguments.divisions, arguments.mesh_limit)
            if message:
                print(f"{cad.name:36} not meshed: {message}", flush=True)
                rows.append({"file": cad.name, "end": "not meshed", "message": message})
                continue
            row = {"file": cad.name} | curve(arguments.camber, folder / "in.msh", cad, arguments,
                                             folder)
            rows.append(row)
            failures += row["end"].startswith(("CRASH", "HANG"))
            if "cells" not in row:
                print(f"{cad.name:36} {'':7} {'':7} {row['end']:16} {row.get('message', '')[:110]}",
                      flush=True)
                continue
            print(f"{cad.name:36} {row['cells']:7} {row['faces']:7} {row['end']:16} "
                  f"{row['cells'] - row['certified']:5} {row['scaled']:6} {row['lowered']:7} "
                  f"{row['over']:5} {row['linear']:9.2g} {row['curved']:9.2g} {row['seconds']:6.1f}",
                  flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=2) + "\n")
    meshed = [row for row in rows if row["end"] != "not meshed"]
    print(f"{len(files)} files, {len(meshed)} meshed, "
          f"{sum(row['end'] == 'ok' for row in meshed)} ok, {failures} crashed or hung")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
