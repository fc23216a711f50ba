#!/usr/bin/python3
"""Writes the page of the bundled ball, opens it in Chromium without a window and uses it.

usage: browser_test.py CAMBER CASE_FOLDER PICTURES     exit code 77: skipped, there is no browser
Keeps pictures of what it saw in PICTURES.
"""
import html
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

# Runs inside the page, after it: does what a user does and writes down what came of it.
DRIVER = """
const app = window.camberPage, found = {};
function picture() {
  const gl = app.stage.renderer.getContext();
  app.stage.draw();
  const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const words = new Uint32Array(bytes.buffer), colours = new Set(words), back = words[0];
  let hash = 0, drawn = 0;
  for (const w of words) { hash = (Math.imul(hash, 31) + w) | 0; drawn += w !== back; }
  return {hash, colours: colours.size, drawn: drawn / words.length};
}
function click(x, y) {
  const canvas = app.stage.canvas, box = canvas.getBoundingClientRect();
  // Pointers that do not exist cannot be captured.
  canvas.setPointerCapture = canvas.releasePointerCapture = () => {};
  for (const type of ['pointerdown', 'pointerup']) {
    canvas.dispatchEvent(new PointerEvent(type, {bubbles: true, button: 0, pointerId: 1, pointerType: 'mouse',
      clientX: box.left + x * box.width, clientY: box.top + y * box.height}));
  }
  return document.body.dataset.picked;
}
const tab = (name) => { app.set({tab: name}); return document.getElementById('tab'); };
try {
  found.first = picture();
  found.modes = {};
  for (const mode of app.modes) { app.set({colour: mode.name}); found.modes[mode.name] = picture().hash; }
  app.set({colour: 'order'});
  found.again = picture();
  for (const [name, change, back] of [['edges', {edges: false}, {edges: true}], ['linear edges', {linear: 'edges'}, {linear: 'off'}],
    ['linear faces', {linear: 'surface'}, {linear: 'off'}]]) {
    app.set(change);
    found[name] = picture().hash;
    app.set(back);
  }
  found.clicked = click(0.5, 0.5);
  found.element = document.getElementById('tab').innerText;
  found.marked = picture().hash;
  found.missed = click(0.02, 0.3);
  app.chooseCut('y');
  found.cut = {...picture(), triangles: app.cut.cells.length};
  const heights = app.cut.triangles.filter((_, i) => i % 3 === 1);
  found.flat = Math.max(...heights) - Math.min(...heights);
  app.moveCut(0.42);
  found.moved = {...picture(), triangles: app.cut.cells.length};
  app.look('-y');
  found.clickedInCut = click(0.02, 0.3);
  found.deep = app.surface.cellHasFace[app.picked];
  app.set({cut: null, pick: null});
  tab('worst').querySelector('tr.link').click();
  found.worst = Number(document.body.dataset.picked);
  found.worstRows = tab('worst').querySelectorAll('tr.link').length;
  found.cutThere = app.state.cut !== null;
  found.histograms = tab('histograms').querySelectorAll('svg').length;
  found.report = tab('report').innerText;
  app.open('#colour=bound&cut=-x:0.4&view=z');
  found.byAddress = picture().hash;
  found.address = location.hash;
  app.showPatch(app.about.patches.indexOf('far'), true);
  found.withFar = picture().hash;
} catch (error) { found.thrown = String(error.stack); }
found.loaded = performance.getEntriesByType('resource').map((r) => r.name);
found.errors = JSON.parse(document.body.dataset.errors ?? '[]');
const result = document.createElement('pre');
result.id = 'found';
result.textContent = JSON.stringify(found);
document.body.append(result);
"""

failures = []


def expect(claim, text):
    if not claim:
        failures.append(text)


def browser():
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)


def run(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=120, check=False, **options)


def used_page(program, page, folder):
    """What DRIVER found on a copy of the page."""
    copy = folder / "driven.html"
    copy.write_text(page.read_text().replace("</body>", f"<script>{DRIVER}</script></body>"))
    command = [program, "--headless", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1000,700",
               f"--user-data-dir={folder / 'profile'}", "--dump-dom", copy.as_uri()]
    if os.geteuid() == 0:
        command.insert(1, "--no-sandbox")
    shown = run(*command)
    match = re.search(r'<pre id="found">(.*?)</pre>', shown.stdout, re.DOTALL)
    if not match:
        sys.exit(f"the page did not run: {shown.stdout[:300]} {shown.stderr[-2000:]}")
    return json.loads(html.unescape(match[1]))


def judge(found):
    expect("thrown" not in found, found.get("thrown"))
    expect(found["errors"] == [], f"console errors: {found['errors']}")
    expect(found["loaded"] == [], f"the page loads {found['loaded']}")
    expect(found["first"]["drawn"] > 0.1 and found["first"]["colours"] > 50, f"blank canvas: {found['first']}")
    modes = found["modes"]
    expect({"order", "deviation", "cost", "bound"} <= set(modes), f"modes: {sorted(modes)}")
    expect(len(set(modes.values())) == len(modes), f"two modes look the same: {modes}")
    expect(found["again"] == found["first"], "the same state looks different")
    for name in ("edges", "linear edges", "linear faces"):
        expect(found[name] != found["first"]["hash"], f"{name} changed nothing")
    expect(found["clicked"] != "", "a click on the surface picked nothing")
    for text in (f"Element {found['clicked']}", "shape", "order", "certified", "cost C", "deviation", "ball"):
        expect(text in found["element"], f"the element's tab lacks {text!r}")
    expect(found["marked"] != found["first"]["hash"], "the picked element is not marked")
    expect(found["missed"] == "", "a click beside the surface picked something")
    expect(found["cut"]["triangles"] > 1000, f"the cut is empty: {found['cut']}")
    expect(found["flat"] < 1e-4, f"the cut is no plane: {found['flat']}")
    expect(found["cut"]["hash"] not in (found["first"]["hash"], found["moved"]["hash"]), "the cut shows nothing or does not move")
    expect(found["clickedInCut"] != "" and not found["deep"], "a click on the cut picked no inner element")
    expect(found["worstRows"] == 10 and found["worst"] > 0 and found["cutThere"], "the worst ten cannot be visited")
    expect(found["histograms"] >= 4, f"histograms: {found['histograms']}")
    for text in ("ok", "Surface error by group", "ball", "Options", "deviation-length", "Times", "camber 0."):
        expect(text in found["report"], f"the report's tab lacks {text!r}")
    expect(found["byAddress"] != found["first"]["hash"], "the address changed nothing")
    expect("colour=bound" in found["address"] and "cut=-x:0.4" in found["address"], found["address"])
    expect(found["withFar"] != found["byAddress"], "a shown patch changed nothing")


def png(path):
    """(width, height, packed bytes a pixel) of a PNG: a blank one needs next to none."""
    data = path.read_bytes()
    expect(data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG")
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    rows = zlib.decompress(packed)
    return width, height, len(packed) / (width * height) if rows else 0.0


def main():
    camber, case, pictures = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh, cad, page, picture = folder / "ball.msh", case / "body.step", folder / "ball page.html", folder / "ball.png"
        curved = run(camber, "curve", case / "linear.msh", "-g", cad, "-o", mesh, "--page", page, "-q")
        expect(curved.returncode == 0, curved.stderr)

        without = run(camber, "report", mesh, "--png", picture, env={"PATH": "/nowhere"})
        expect(without.returncode == 1 and "apt install chromium" in without.stderr and without.stderr.count("\n") == 1,
               f"without a browser: {without.returncode} {without.stderr}")
        nothing = run(camber, "report", mesh)
        expect(nothing.returncode == 1 and "-o PAGE.html" in nothing.stderr, f"without an output: {nothing.stderr}")

        program = browser()
        if not program:
            print("skipped: there is no Chromium or Chrome")
            sys.exit(1 if failures else 77)
        judge(used_page(program, page, folder))
        shot = run(camber, "report", mesh, "-g", cad, "--png", picture, "--size", "900x600", "--view", "colour=order&cut=-y:0.5&view=-y", "-q")
        expect(shot.returncode == 0, shot.stderr)
        expect(png(picture)[:2] == (900, 600) and png(picture)[2] > 0.1, f"the picture: {png(picture)}")
        expect(sorted(p.name for p in folder.glob(".*")) == [], "something was left behind")
        shutil.copy(picture, pictures / "cut.png")
    for failure in failures:
        print("FAILED:", failure)
    sys.exit(1 if failures else 0)


main()
