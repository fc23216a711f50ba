#!/usr/bin/env python3
"""Whole runs of `camber curve` on generated layer meshes: time, memory, bits.

    bench/end_to_end.py                                  # ball and wing, 1e5 and 1e6 cells
    bench/end_to_end.py --cells 1e5 1e6 5e6 --threads 1 2
    bench/end_to_end.py --mesh wing.msh --geometry wing.step --order 4

Prints one line a run: CPU and wall seconds, peak memory, microseconds of CPU per curved cell (order 2
or more) and whether the output has the same bits as the first run of its case.
"""
import argparse
import hashlib
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

BODIES = {"ball": "sphere:0,0,0,1", "wing": "ellipsoid:0,0,0,1,0.1,3"}


def run(command):
    """CPU and wall seconds of a command that must end with 0 or 3."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 3):
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, wall


def digest(path):
    sha = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 22):
            sha.update(block)
    return sha.hexdigest()


def measure(camber, name, mesh, geometry, arguments, folder):
    first = None
    for threads in arguments.threads:
        out, report = folder / "out.msh", folder / "report.json"
        cpu, wall = run([camber, "curve", mesh, "-g", geometry, "-o", out, "--json", report,
                         "--order", str(arguments.order), "--deviation",
                         str(arguments.deviation), "--threads", str(threads)])
        data = json.loads(report.read_text())
        by_order = {int(q): n for q, n in data["output"]["cells_by_order"].items()}
        cells, curved = sum(by_order.values()), sum(n for q, n in by_order.items() if q > 1)
        bits = digest(out)
        first = first or bits
        validity, rescue = data["validity"], data["rescue"]
        print(f"{name:12} {cells:9} {100 * curved / cells:6.1f} {threads:7} {cpu:8.2f} {wall:8.2f} "
              f"{data['memory']['peak_bytes'] / 2**30:8.2f} {1e6 * cpu / max(curved, 1):10.1f} "
              f"{validity['invalid'] + validity['undecided']:7} {rescue['scaled_back']:7}  "
              f"{'same' if bits == first else 'DIFFERENT'}", flush=True)
        if arguments.verbose:
            stages = data["time"]["stages_s"]
            print("   " + ", ".join(f"{stage} {s:.2f}" for stage, s in stages.items()), flush=True)
        out.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, help="folder of a build with benchmarks")
    parser.add_argument("--cells", type=float, nargs="+", default=[1e5, 1e6])
    parser.add_argument("--body", nargs="+", default=list(BODIES), choices=list(BODIES))
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--order", type=int, default=3)
    parser.add_argument("--deviation", type=float, default=0.01,
                        help="fine meshes need less, or all cells stay linear")
    parser.add_argument("--thickness", type=float, default=1.0)
    parser.add_argument("--mesh", help="instead of generated ones")
    parser.add_argument("--geometry")
    parser.add_argument("-v", "--verbose", action="store_true", help="seconds by stage")
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parent.parent
    build = arguments.build or next(
        (b for b in (root / "build/bench", root / "build/release") if (b / "bench/generate").exists()),
        None)
    if build is None:
        sys.exit("no build with benchmarks: cmake --preset bench && cmake --build --preset bench")
    camber = build / "apps/camber/camber"
    print(f"{'case':12} {'cells':>9} {'% curv':>6} {'threads':>7} {'CPU s':>8} {'wall s':>8} "
          f"{'peak GiB':>8} {'us/curved':>10} {'not ok':>7} {'scaled':>7}  bits")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if arguments.mesh:
            measure(camber, pathlib.Path(arguments.mesh).parent.name, arguments.mesh,
                    arguments.geometry, arguments, folder)
            return
        for body in arguments.body:
            for cells in arguments.cells:
                mesh = folder / "in.msh"
                run([build / "bench/generate", "--body", body, "--cells", f"{cells:.0f}",
                     "--thickness", str(arguments.thickness), "-o", mesh])
                measure(camber, f"{body} {cells:.0e}".replace("+0", ""), mesh, BODIES[body],
                        arguments, folder)
                os.unlink(mesh)


if __name__ == "__main__":
    main()
