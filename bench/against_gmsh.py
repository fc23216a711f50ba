#!/usr/bin/python3
"""Camber against Debian's Gmsh, in one run on one machine: thin hex layers on a sphere.

    bench/against_gmsh.py                                # order 2, first cells 1e-2 and 1e-4
    bench/against_gmsh.py --order 3 --first-cell 1e-1 1e-3 --n 8
    bench/against_gmsh.py --mesh cases/wing/linear.msh --cad cases/wing/body.step --order 3

Gmsh reads CAD and linear mesh, raises the order and optimises (elastic, then the high-order
optimiser; or fast curving); Camber curves the same files with file in and out. Every result is
judged by Camber's certificates (invalid) and by Gmsh's own Jacobians at Gauss points (sampled).
CPU seconds are those of the process, start and files included; a run over --limit seconds is cut
off. Needs python3-gmsh.
"""
import argparse
import contextlib
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
WAYS = {"elastic": ["HighOrderElastic"], "elastic+opt": ["HighOrderElastic", "HighOrder"],
        "fast": ["HighOrderFastCurving"]}


def gmsh_run(mesh, cad, order, way, out):
    """In a process of its own: raise the order, optimise, write."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.open(str(cad))
    gmsh.merge(str(mesh))
    gmsh.option.setNumber("Mesh.SecondOrderLinear", 0)
    gmsh.model.mesh.setOrder(order)
    for method in WAYS[way]:
        gmsh.model.mesh.optimize(method, niter=1)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.write(str(out))
    gmsh.finalize()


def judge(camber, mesh, folder):
    """Cells, cells that Camber cannot certify, and cells with a determinant that is not positive at
    one of Gmsh's Gauss points of order 2 (p + 3); None where Gmsh does not know the element."""
    report = folder / "check.json"
    subprocess.run([camber, "check", mesh, "--json", report, "-q"], check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    validity = json.loads(report.read_text())["validity"]
    count = validity["certified"] + validity["invalid"] + validity["undecided"]
    return count, validity["invalid"] + validity["undecided"], sampled(mesh)


def sampled(mesh):
    import gmsh
    import numpy
    bad = 0
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        gmsh.open(str(mesh))
        for _, tag in gmsh.model.getEntities(3):
            for kind in gmsh.model.mesh.getElementTypes(3, tag):
                order = gmsh.model.mesh.getElementProperties(kind)[2]
                points, _ = gmsh.model.mesh.getIntegrationPoints(kind, f"Gauss{2 * (order + 3)}")
                determinants = gmsh.model.mesh.getJacobians(kind, points, tag)[1]
                by_cell = numpy.asarray(determinants).reshape(-1, len(points) // 3)
                bad += int((by_cell <= 0).any(axis=1).sum())
    except Exception:  # Debian's Gmsh lacks prisms and pyramids of some orders
        bad = None
    gmsh.finalize()
    return bad


@contextlib.contextmanager
def silence():
    """OpenCASCADE prints its statistics whatever Gmsh was told."""
    sys.stdout.flush()
    kept, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(null)


def timed(command, limit):
    """CPU and wall seconds, or None if it was cut off or failed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=os.setsid)
    try:
        code = process.wait(timeout=limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return None, f"over {limit:g} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if code not in (0, 3):
        return None, f"exit code {code}"
    return cpu, time.perf_counter() - start


def sphere(folder, build, n, first_cell):
    """Hex layers on the unit sphere, and the sphere as STEP with the face that the mesh names."""
    import gmsh
    cad, mesh = folder / "sphere.step", folder / f"layers-{first_cell:g}.msh"
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.addSphere(0, 0, 0, 1)
    gmsh.model.occ.synchronize()
    with silence():
        gmsh.write(str(cad))
    gmsh.finalize()
    subprocess.run([build / "bench/generate", "--shapes", "hexes", "--cells",
                    str(6 * n * n * 20), "--first-cell", str(first_cell), "--thickness", "0.5",
                    "-o", mesh], check=True, stdout=subprocess.DEVNULL)
    return mesh, cad


def compare(title, mesh, cad, arguments, build, folder):
    ours, report = folder / "camber.msh", folder / "camber.json"
    cpu, wall = timed([build / "apps/camber/camber", "curve", mesh, "-g", cad, "-o", ours,
                       "--json", report, "--order", str(arguments.order), "--min-order",
                       str(arguments.order) if arguments.uniform else "1", "--threads", "1",
                       "--allow-invalid"], arguments.limit)
    if cpu is None:
        sys.exit(f"camber: {wall}")
    data = json.loads(report.read_text())
    camber = build / "apps/camber/camber"
    count, bad, bad_sampled = judge(camber, ours, folder)
    show(title, "camber", count, cpu, bad, bad_sampled, 1.0,
         f"{data['validity']['certified']} certified, surface {data['surface']['maximum']:.2g}")
    for way in arguments.ways:
        theirs = folder / "gmsh.msh"
        theirs.unlink(missing_ok=True)
        gmsh_cpu, gmsh_wall = timed(
            [sys.executable, __file__, "--as-gmsh", str(mesh), str(cad), str(arguments.order), way,
             str(theirs)], arguments.limit)
        if gmsh_cpu is None:
            show(title, f"gmsh {way}", count, arguments.limit, None, None, arguments.limit / cpu,
                 gmsh_wall)
            continue
        gmsh_count, gmsh_bad, gmsh_sampled = judge(camber, theirs, folder)
        show(title, f"gmsh {way}", gmsh_count, gmsh_cpu, gmsh_bad, gmsh_sampled, gmsh_cpu / cpu,
             "")


def show(title, who, count, cpu, bad, bad_sampled, ratio, note):
    known = ["?" if n is None else str(n) for n in (bad, bad_sampled)]
    print(f"{title:22} {who:17} {count:8} {cpu:9.2f} {1000 * cpu / count:10.3f} "
          f"{known[0]:>7} {known[1]:>7} {ratio:8.1f}  {note}", flush=True)


def main():
    if sys.argv[1:2] == ["--as-gmsh"]:
        mesh, cad, order, way, out = sys.argv[2:]
        gmsh_run(mesh, cad, int(order), way, out)
        return
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, help="folder of a build with benchmarks")
    parser.add_argument("--order", type=int, default=2)
    parser.add_argument("--first-cell", type=float, nargs="+", default=[1e-2, 1e-4])
    parser.add_argument("--n", type=int, default=10, help="faces along a side of the cubed sphere")
    parser.add_argument("--ways", nargs="+", choices=list(WAYS), default=["elastic", "fast"])
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a run may take")
    parser.add_argument("--mixed", dest="uniform", action="store_false",
                        help="let Camber choose lower orders; default: all at --order, as Gmsh")
    parser.add_argument("--mesh", type=pathlib.Path)
    parser.add_argument("--cad", type=pathlib.Path)
    arguments = parser.parse_args()
    build = arguments.build or next(
        (b for b in (ROOT / "build/bench", ROOT / "build/release")
         if (b / "bench/generate").exists()), None)
    if build is None:
        sys.exit("no build with benchmarks: cmake --preset bench && cmake --build --preset bench")
    print(f"{'case':22} {'program':17} {'cells':>8} {'CPU s':>9} {'s per 1000':>10} {'invalid':>7} "
          f"{'sampled':>7} {'ratio':>8}")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if arguments.mesh:
            compare(arguments.mesh.parent.name, arguments.mesh, arguments.cad, arguments, build,
                    folder)
            return
        for first_cell in arguments.first_cell:
            mesh, cad = sphere(folder, build, arguments.n, first_cell)
            compare(f"sphere hexes {first_cell:g}", mesh, cad, arguments, build, folder)


if __name__ == "__main__":
    main()
