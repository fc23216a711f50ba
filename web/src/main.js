// The page of camber report: reads the data, keeps the state, draws.
import './style.css';
import {Panel} from './panel.js';
import {Stage, directions} from './scene.js';
import {Surface} from './surface.js';
import {Volume} from './volume.js';
import {count, el} from './dom.js';
import {legend} from './legend.js';
import {makeModes} from './modes.js';
import {nearestHit} from './pick.js';
import {parseCut, parseState, stateText} from './state.js';
import {readData} from './data.js';

// What goes wrong is kept where tests, and people who report it, can find it.
const errors = [];
function note(text) {
  errors.push(String(text));
  document.body.dataset.errors = JSON.stringify(errors);
}
window.addEventListener('error', (e) => note(e.message));
window.addEventListener('unhandledrejection', (e) => note(e.reason));
const consoleError = console.error.bind(console);
console.error = (...words) => { note(words.join(' ')); consoleError(...words); };

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const k_click = 4;  // pixels that a click may wander

class App {
  constructor() {
    const {arrays, about, report} = readData();
    Object.assign(this, {arrays, about, report});
    document.title = `${about.title} · Camber`;
    this.surface = new Surface(this);
    this.volume = new Volume(this);
    this.modes = makeModes(this);
    this.number2cell = new Map();
    arrays.cell_number.forEach((number, c) => this.number2cell.set(number, c));
    this.stage = new Stage(document.getElementById('canvas'), this);
    this.clips = () => this.state.clip ?? this.clipsAtFirst;
    this.panel = new Panel(this);
    this.picked = -1;
    this.stage.linearEdges.material.uniforms.lift.value = 1.5 * this.surface.largestBulge();
    this.listen();
    this.writeTitle();
    this.open(location.hash);
  }

  writeTitle() {
    const {about} = this;
    document.getElementById('title').append(el('b', {}, about.title), ` ${count(about.cells)} cells · ${count(about.faces)} boundary faces · ${count(about.triangles)} triangles`);
    document.getElementById('notice').append(...about.notices.map((text) => el('p', {}, text)));
  }

  /** Takes on the state that an address describes. */
  open(hash) {
    const state = parseState(hash);
    if (!this.modes.some((m) => m.name === state.colour)) state.colour = this.modes[0].name;
    const {patches} = this.about;
    this.shown = state.hide ? patches.map((name) => !state.hide.includes(name)) : this.surface.firstVisible();
    this.state = state;
    document.body.classList.toggle('picture', state.picture);
    this.stage.resize();
    this.changePatches();
    this.setColours();
    this.changeCut();
    this.changeShown();
    const {eye} = state;
    if (eye) {
      const offset = eye.slice(0, 3).map((x, d) => x - eye[d + 3]);
      this.stage.lookAt(eye.slice(3), offset, Math.hypot(...offset));
    } else {
      this.look(state.view);
    }
    this.changePick();
    if (state.fly && this.picked >= 0) (state.cut ? this.flyTo(this.picked) : this.jump(this.picked));
    this.finish();
  }

  /** Changes some of the state and draws. */
  set(change) {
    const cutChanges = 'cut' in change || 'clip' in change;
    Object.assign(this.state, change);
    if ('colour' in change) this.setColours();
    if ('linear' in change) this.writeLegend();
    if (cutChanges) this.changeCut();
    if ('pick' in change) this.changePick();
    this.changeShown();
    this.finish();
  }

  finish() {
    this.panel.update();
    this.stage.draw();
    this.writeAddress();
  }

  writeAddress() {
    const {camera, controls} = this.stage;
    const eye = [...camera.position.toArray(), ...controls.target.toArray()];
    const text = `#${stateText(this.state, this.state.view ? null : eye)}`;
    if (this.state.picture) return;
    try {
      history.replaceState(null, '', text);
    } catch {
      // Browsers limit how often; the next change writes it.
    }
  }

  get mode() { return this.modes.find((m) => m.name === this.state.colour); }

  setColours() {
    const {mode, surface, stage} = this;
    const values = stage.value.array;
    for (let f = 0; f < surface.faceCount; ++f) {
      const flat = mode.ofFace ? mode.ofFace(f) : mode.ofCell(surface.cell[f]);
      for (let p = surface.firstPoint[f]; p < surface.firstPoint[f + 1]; ++p) values[p] = mode.ofPoint ? mode.ofPoint(p) : flat;
    }
    stage.value.needsUpdate = true;
    this.colourLinear();
    stage.setMap(mode.texels, Boolean(mode.entries));
    if (this.cut) this.showSlice();
    this.writeLegend();
  }

  colourLinear() {
    const {mode, surface, linear} = this;
    const of = (f) => (mode.linear || mode).ofFace?.(f) ?? mode.ofCell(surface.cell[f]);
    const values = new Float32Array(3 * linear.face.length);
    linear.face.forEach((f, t) => values.fill(of(f), 3 * t, 3 * t + 3));
    this.stage.setLinear(linear.triangles, values);
  }

  writeLegend() {
    const mode = this.state.linear === 'surface' ? {...this.mode, ...this.mode.linear} : this.mode;
    let used = null;
    if (mode.entries && mode.name !== 'patch') {
      used = new Set();
      for (let c = 0; c < this.about.cells; ++c) used.add(Math.floor(mode.ofCell(c) * mode.entries.length));
    } else if (mode.entries) {
      used = new Set(this.shown.flatMap((is, i) => (is ? [i] : [])));
    }
    document.getElementById('legend').replaceChildren(...legend(mode, used).filter(Boolean));
  }

  changePatches() {
    const {surface, stage, shown} = this;
    this.triangles = surface.shownTriangles(shown);
    this.linear = surface.linear(shown);
    stage.setIndex(stage.surface, this.triangles.index);
    stage.setIndex(stage.edges, surface.shownEdges(shown));
    stage.setIndex(stage.linearEdges, this.linear.lines);
    this.box = surface.boxOf(shown.some(Boolean) ? shown : shown.map(() => true));
    const size = (low, high) => Math.hypot(...low.map((l, d) => high[d] - l));
    // A body in a far field sticks out of the cut; the wall of a pipe would hide it.
    this.clipsAtFirst = size(this.box.low, this.box.high) > 0.7 * size(this.volume.low, this.volume.high);
    this.changeBall();
  }

  changeBall() {
    const {low, high} = this.cut ? this.volume : this.box;
    this.stage.setBall(low.map((l, d) => (l + high[d]) / 2), 0.51 * Math.hypot(...low.map((l, d) => high[d] - l)));
  }

  /** Place of the cut along its normal, over the box of the volume. */
  cutRange(n) {
    const {low, high} = this.volume;
    const middle = low.map((l, d) => (l + high[d]) / 2);
    const half = n.reduce((sum, x, d) => sum + (Math.abs(x) * (high[d] - low[d])) / 2, 0);
    return [dot(n, middle) - half, dot(n, middle) + half];
  }

  changeCut() {
    const {cut} = this.state;
    if (cut) {
      // At -y the place still counts along y: turning the cut round leaves it where it is.
      const [from, to] = this.cutRange(cut.n);
      const at = cut.name.startsWith('-') ? 1 - cut.at : cut.at;
      const d = from + at * (to - from) + 1e-9 * (to - from);
      this.cut = {...this.volume.cut(cut.n, d), n: cut.n, d};
      this.showSlice();
    } else {
      this.cut = null;
      this.stage.setSlice({triangles: new Float32Array(0), lines: new Float32Array(0)}, new Float32Array(0));
    }
    document.body.dataset.slice = this.cut ? this.cut.cells.length : 0;
    this.stage.setPlane(this.cut && this.clips() ? this.cut : null);
    this.changeBall();
  }

  showSlice() {
    const values = new Float32Array(3 * this.cut.cells.length);
    this.cut.cells.forEach((c, t) => values.fill(this.mode.ofCell(c), 3 * t, 3 * t + 3));
    this.stage.setSlice(this.cut, values);
  }

  changeShown() {
    const {state, stage} = this;
    stage.surface.visible = state.surface && state.linear !== 'surface';
    stage.edges.visible = state.edges && stage.surface.visible;
    stage.linearSurface.visible = state.surface && state.linear === 'surface';
    stage.linearEdges.visible = state.linear !== 'off';
    stage.sliceEdges.visible = state.edges;
  }

  changePick() {
    const c = this.state.pick === null ? -1 : this.cellOf(this.state.pick);
    this.picked = c;
    if (c < 0) this.state.pick = null;
    this.stage.setPick(c < 0 ? null : this.volume.skin(c));
    document.body.dataset.picked = c < 0 ? '' : this.arrays.cell_number[c];
  }

  cellOf(number) { return this.number2cell.get(number) ?? -1; }

  patchesOf(c) {
    if (!this.surface.cellHasFace[c]) return [];
    const names = new Set();
    this.surface.cell.forEach((cell, f) => { if (cell === c) names.add(this.about.patches[this.surface.patch[f]]); });
    return [...names];
  }

  showPatch(i, isShown) {
    this.shown[i] = isShown;
    this.state.hide = this.about.patches.filter((_, k) => !this.shown[k]);
    this.changePatches();
    this.changeCut();
    this.colourLinear();
    this.writeLegend();
    this.finish();
  }

  look(name) {
    const direction = directions[name] ?? directions.iso;
    this.state.view = directions[name] ? name : 'iso';
    const {low, high} = this.box;
    this.stage.fit(low, high, direction);
    if (this.state.zoom !== 1) {
      const target = this.stage.controls.target.toArray();
      this.stage.lookAt(target, direction, this.stage.eye().length() / this.state.zoom);
    }
    this.stage.draw();
    this.writeAddress();
  }

  /** A cut that faces the viewer; '' for none. */
  chooseCut(axis) {
    if (!axis) return this.set({cut: null});
    const eye = this.stage.eye().normalize().toArray();
    if (axis === 'screen') return this.set({cut: parseCut(`${eye.map((x) => x.toFixed(4)).join(',')}:0.5`)});
    const sign = eye['xyz'.indexOf(axis)] < 0 ? '-' : '';
    return this.set({cut: parseCut(`${sign}${axis}:${this.middleOfBox(axis)}`)});
  }

  /** Where the middle of what is shown lies along an axis of the volume's box. */
  middleOfBox(axis) {
    const d = 'xyz'.indexOf(axis);
    const {low, high} = this.volume;
    return (((this.box.low[d] + this.box.high[d]) / 2 - low[d]) / (high[d] - low[d])).toFixed(4);
  }

  moveCut(at) { this.set({cut: {...this.state.cut, at}}); }

  /** While the slider moves: one cut a frame, however many events come. */
  dragCut(at) {
    if (this.draggedTo === undefined) {
      requestAnimationFrame(() => {
        this.moveCut(this.draggedTo);
        this.draggedTo = undefined;
      });
    }
    this.draggedTo = at;
  }

  flipCut() {
    const {cut} = this.state;
    const isAxis = ['x', 'y', 'z'].includes(cut.name.replace('-', ''));
    const name = isAxis ? (cut.name.startsWith('-') ? cut.name.slice(1) : `-${cut.name}`) : cut.n.map((x) => (-x).toFixed(4)).join(',');
    this.set({cut: parseCut(`${name}:${isAxis ? cut.at : 1 - cut.at}`)});
  }

  /** Picks an element and goes there; inside the volume with a cut through it. */
  jump(c) {
    if (c === undefined || c < 0) return;
    this.set({pick: this.arrays.cell_number[c]});
    const isSeen = this.surface.cellHasFace[c] && this.patchesOf(c).some((name) => this.shown[this.about.patches.indexOf(name)]);
    if (!isSeen) this.cutThrough(c);
    this.flyTo(c);
  }

  cutThrough(c) {
    const eye = this.stage.eye().toArray();
    let d = [0, 1, 2].sort((a, b) => Math.abs(eye[b]) - Math.abs(eye[a]))[0];
    if (this.state.cut) d = Math.max(0, 'xyz'.indexOf(this.state.cut.name.replace('-', '')));
    const {low, high} = this.volume;
    const at = (this.volume.centre(c)[d] - low[d]) / (high[d] - low[d]);
    // The surface is cut too: it could stand before the element.
    this.set({cut: parseCut(`${eye[d] < 0 ? '-' : ''}${'xyz'[d]}:${at}`), clip: true});
  }

  flyTo(c) {
    let direction = this.stage.eye().toArray();
    const f = this.surface.cell.indexOf(c);
    if (f >= 0 && this.shown[this.surface.patch[f]]) {
      // A wall face is looked at from the fluid's side, a little from the side.
      const sum = [0, 0, 0];
      for (let p = this.surface.firstPoint[f]; p < this.surface.firstPoint[f + 1]; ++p) {
        for (let d = 0; d < 3; ++d) sum[d] -= this.arrays.normal[3 * p + d];
      }
      const length = Math.hypot(...sum) || 1;
      direction = direction.map((x, d) => sum[d] / length + (0.35 * x) / Math.hypot(...direction));
    }
    if (f < 0 && this.cut) direction = direction.map((x, d) => this.cut.n[d] + (0.5 * x) / Math.hypot(...direction));
    this.state.view = null;
    this.stage.lookAt(this.volume.centre(c), direction, 4.5 * this.volume.size(c));
    this.finish();
  }

  pickAt(x, y) {
    const ray = this.stage.ray(x, y);
    const plane = this.cut && this.clips() ? this.cut : null;
    const isHidden = plane && ((px, py, pz) => dot(plane.n, [px, py, pz]) > plane.d);
    const {state, arrays} = this;
    const isFlat = state.linear === 'surface';
    const mesh = isFlat ? this.linear : this.triangles;
    const onSurface = !state.surface ? null
      : isFlat ? nearestHit(ray, mesh.triangles, null, isHidden) : nearestHit(ray, arrays.point, mesh.index, isHidden);
    const onCut = this.cut ? nearestHit(ray, this.cut.triangles, null, null) : null;
    let c = -1;
    if (onCut && (!onSurface || onCut.t < onSurface.t)) c = this.cut.cells[onCut.triangle];
    else if (onSurface) c = this.surface.cell[mesh.face[onSurface.triangle]];
    this.set({pick: c < 0 ? null : arrays.cell_number[c], tab: 'element'});
  }

  listen() {
    const {canvas} = this.stage;
    let down = null;
    canvas.addEventListener('pointerdown', (e) => { down = e.button === 0 ? [e.clientX, e.clientY] : null; });
    canvas.addEventListener('pointerup', (e) => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < k_click) this.pickAt(e.clientX, e.clientY);
      down = null;
    });
    // A view that nobody has moved keeps filling the window.
    this.stage.onResize = () => { if (this.box && this.state?.view) this.look(this.state.view); };
    this.stage.onMove = () => {
      if (!this.state) return;
      clearTimeout(this.moved);
      this.moved = setTimeout(() => this.writeAddress(), 300);
    };
    this.stage.controls.addEventListener('start', () => { this.state.view = null; });
    window.addEventListener('hashchange', () => this.open(location.hash));
    window.addEventListener('keydown', (e) => this.key(e));
  }

  key(e) {
    if (e.target.tagName === 'INPUT' && e.target.type !== 'checkbox' && e.target.type !== 'range') return;
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const {state} = this;
    const digit = Number(e.key);
    const act = {
      e: () => this.set({edges: !state.edges}), l: () => this.set({linear: state.linear === 'off' ? 'edges' : state.linear === 'edges' ? 'surface' : 'off'}),
      s: () => this.set({surface: !state.surface}), x: () => this.toggleCut('x'), y: () => this.toggleCut('y'), z: () => this.toggleCut('z'),
      f: () => (this.picked >= 0 ? this.flyTo(this.picked) : this.look('iso')), r: () => this.look('iso'),
      Escape: () => this.set({pick: null}), '?': () => this.help(),
      '[': () => state.cut && this.moveCut(Math.max(0, state.cut.at - 0.005)), ']': () => state.cut && this.moveCut(Math.min(1, state.cut.at + 0.005)),
    }[e.key];
    if (act) act();
    else if (digit >= 1 && digit <= this.modes.length) this.set({colour: this.modes[digit - 1].name});
  }

  toggleCut(axis) { this.chooseCut(this.state.cut?.name.replace('-', '') === axis ? '' : axis); }

  help() {
    const dialog = document.getElementById('keys');
    const keys = [['1 … ' + this.modes.length, this.modes.map((m) => m.label.toLowerCase()).join(', ')], ['x y z', 'cut on and off'], ['[ ]', 'move the cut'],
      ['e', 'element edges'], ['l', 'linear mesh: edges, instead, off'], ['s', 'surface'], ['f', 'go to the picked element'], ['r', 'first view'], ['Esc', 'let go of the element']];
    dialog.replaceChildren(el('table', {class: 'facts'}, keys.map(([k, text]) => el('tr', {}, el('th', {}, el('kbd', {}, k)), el('td', {}, text)))),
      el('p', {class: 'note'}, 'The address of the page holds what is shown: copy it to come back to it.'), el('form', {method: 'dialog'}, el('button', {}, 'Close')));
    dialog.showModal();
  }
}

try {
  window.camberPage = new App();
  document.body.dataset.ready = '1';
} catch (error) {
  note(error.stack ?? error);
  document.getElementById('notice').append(el('p', {}, `This page cannot be shown (a browser with WebGL 2 is needed): ${error.message}`));
}
