// The side panel: what is shown, and tabs about the picked element, the worst ones, histograms, report.
import {categoryHistogram, scalarHistogram} from './histogram.js';
import {count, el, facts, number, table} from './dom.js';
import {reportTab} from './report.js';
import {shapeName} from './modes.js';

const tabs = {element: 'Element', worst: 'Worst ten', histograms: 'Histograms', report: 'Report'};

export class Panel {
  constructor(app) {
    this.app = app;
    this.controls = document.getElementById('controls');
    this.tab = document.getElementById('tab');
    this.nav = document.getElementById('tabs');
    this.worstBy = 'bound';
    this.buildControls();
    for (const [name, text] of Object.entries(tabs)) {
      this.nav.append(el('button', {onclick: () => app.set({tab: name}), 'data-tab': name}, text));
    }
  }

  buildControls() {
    const {app} = this;
    const group = (label, ...content) => el('div', {class: 'row'}, el('label', {}, label), el('div', {class: 'fill'}, content));
    const buttons = (key, entries, act) => el('div', {class: 'buttons', 'data-key': key},
      entries.map(([value, text, title]) => el('button', {'data-value': value, title: title ?? '', onclick: () => act(value)}, text)));
    const check = (key, text, act) => el('label', {class: 'check'}, el('input', {type: 'checkbox', 'data-check': key, onchange: (e) => act(e.target.checked)}), text);
    this.slider = el('input', {type: 'range', min: 0, max: 1, step: 0.001, 'aria-label': 'place of the cut',
      oninput: (e) => app.dragCut(Number(e.target.value))});
    this.controls.append(
      group('Colour', buttons('colour', app.modes.map((m) => [m.name, m.label, m.note]), (colour) => app.set({colour}))),
      group('Cut', buttons('cut', [['', 'off'], ['x', 'X'], ['y', 'Y'], ['z', 'Z'], ['screen', 'Screen', 'across the line of sight']], (axis) => app.chooseCut(axis)),
        this.cutRow = el('div', {class: 'sliderrow'}, this.slider, el('button', {title: 'other side', onclick: () => app.flipCut()}, '⇄')),
        this.clipRow = check('clip', 'cut the surface too', (clip) => app.set({clip}))),
      group('Show', check('surface', 'surface', (surface) => app.set({surface})), check('edges', 'element edges', (edges) => app.set({edges}))),
      group('Linear', buttons('linear', [['off', 'off'], ['edges', 'edges', 'straight edges over the curved surface'], ['surface', 'instead', 'flat faces instead of curved ones']], (linear) => app.set({linear}))),
      group('View', buttons('view', [['iso', 'iso'], ['x', '+x'], ['-x', '−x'], ['y', '+y'], ['-y', '−y'], ['z', '+z'], ['-z', '−z']], (view) => app.look(view))),
    );
    const {patches} = app.about;
    if (patches.length > 1) {
      this.patchBoxes = patches.map((name, i) => el('input', {type: 'checkbox', onchange: (e) => app.showPatch(i, e.target.checked)}));
      this.controls.append(group('Patches', el('div', {class: 'patches'},
        patches.map((name, i) => el('label', {class: 'check'}, this.patchBoxes[i], name)))));
    }
  }

  /** Brings controls and tab in step with the state. */
  update() {
    const {state, clips} = this.app;
    const mark = (key, value) => this.controls.querySelectorAll(`[data-key="${key}"] button`).forEach((b) => b.classList.toggle('on', b.dataset.value === value));
    const cutName = state.cut ? state.cut.name.replace('-', '') : '';
    mark('colour', state.colour);
    mark('cut', state.cut && !['x', 'y', 'z'].includes(cutName) ? 'screen' : cutName);
    mark('linear', state.linear);
    for (const key of ['edges', 'surface']) this.controls.querySelector(`[data-check="${key}"]`).checked = state[key];
    this.controls.querySelector('[data-check="clip"]').checked = clips();
    this.cutRow.hidden = this.clipRow.hidden = !state.cut;
    if (state.cut) this.slider.value = state.cut.at;
    this.patchBoxes?.forEach((box, i) => { box.checked = this.app.shown[i]; });
    const tab = tabs[state.tab] ? state.tab : 'element';
    this.nav.querySelectorAll('button').forEach((b) => b.classList.toggle('on', b.dataset.tab === tab));
    const key = `${tab} ${state.pick} ${this.worstBy}`;
    if (key === this.shownTab) return;
    this.shownTab = key;
    this.tab.replaceChildren(...this.content(tab));
  }

  content(tab) {
    if (tab === 'worst') return this.worst();
    if (tab === 'histograms') return this.histograms();
    if (tab === 'report') return reportTab(this.app.report, this.app.about);
    return this.element();
  }

  element() {
    const {app} = this;
    const {arrays} = app;
    const search = el('form', {class: 'search', onsubmit: (e) => { e.preventDefault(); app.jump(app.cellOf(Number(e.target.elements[0].value))); }},
      el('input', {type: 'number', placeholder: 'element number', 'aria-label': 'element number'}), el('button', {}, 'Find'));
    const c = app.picked;
    if (c < 0) return [search, el('p', {class: 'note'}, 'Click an element on the surface or in the cut, or type its number.')];
    const centre = app.volume.centre(c).map((x, d) => number(x + app.about.origin[d]));
    return [search,
      el('h2', {}, `Element ${arrays.cell_number[c]}`),
      facts([
        ['shape', shapeName(arrays.cell_shape[c])], ['order', `Q${arrays.cell_order[c]}`],
        ['bound of min J / max J', el('span', {class: arrays.cell_bound[c] > 0 ? 'good' : 'bad'}, `${number(arrays.cell_bound[c])}${arrays.cell_bound[c] > 0 ? ' certified' : ' not certified'}`)],
        ['cost C', arrays.cell_cost.length ? number(arrays.cell_cost[c]) : ''],
        ['deviation from the CAD', app.about.has_deviation ? (Number.isNaN(arrays.cell_deviation[c]) ? 'not on curved CAD' : number(arrays.cell_deviation[c])) : ''],
        ['patch', app.patchesOf(c).join(', ')],
        ['centre', `(${centre.join(', ')})`],
      ]),
      el('div', {class: 'buttons'},
        el('button', {onclick: () => app.flyTo(c)}, 'Go there'),
        el('button', {onclick: () => app.cutThrough(c)}, 'Cut through it'),
        el('button', {onclick: () => app.set({pick: null})}, 'Let go')),
    ];
  }

  worst() {
    const {app} = this;
    const {arrays} = app;
    const kinds = [['bound', 'Bound', arrays.cell_bound, 1]];
    if (arrays.cell_cost.length) kinds.push(['cost', 'Cost', arrays.cell_cost, 1]);
    if (app.about.has_deviation) kinds.push(['deviation', 'Deviation', arrays.cell_deviation, -1]);
    const [, label, values, sign] = kinds.find(([name]) => name === this.worstBy) ?? kinds[0];
    const list = tenLowest(values, sign);
    return [
      el('div', {class: 'buttons'}, kinds.map(([name, text]) => el('button', {
        class: name === this.worstBy ? 'on' : '', onclick: () => { this.worstBy = name; this.update(); }}, text))),
      table(['element', 'shape', 'order', label.toLowerCase()], list.map((c) => [arrays.cell_number[c], shapeName(arrays.cell_shape[c]), `Q${arrays.cell_order[c]}`, number(values[c])]),
        {onrow: (i) => app.jump(list[i])}),
      el('p', {class: 'note'}, 'A click goes there; inside the volume it cuts through the element.'),
    ];
  }

  histograms() {
    const {app} = this;
    const {arrays} = app;
    const every = (mode) => Array.from({length: app.about.cells}, (_, c) => mode.ofCell(c));
    const made = [];
    for (const mode of app.modes) {
      if (mode.name === 'plain' || mode.name === 'patch') continue;
      if (mode.entries) {
        const counts = new Array(mode.entries.length).fill(0);
        for (const x of every(mode)) ++counts[Math.floor(x * counts.length)];
        made.push(categoryHistogram(mode.label, `${count(arrays.cell_order.length)} cells`, mode.entries, counts, mode.colours));
      } else {
        const [low, high] = mode.range;
        const at = (x) => number(mode.isLog ? low * (high / low) ** x : low + x * (high - low), 3);
        made.push(scalarHistogram(mode.label, mode.name === 'deviation' ? 'largest of every wall cell, log scale' : mode.note, every(mode), mode.texels, at));
      }
    }
    return [...made, el('p', {class: 'note'}, 'Heights are logarithmic: a guide line is ten times the one below.')];
  }
}

/** Cells with the ten lowest values (highest for sign -1); NaN never. */
function tenLowest(values, sign) {
  const list = [];
  for (let c = 0; c < values.length; ++c) {
    const v = sign * values[c];
    if (Number.isNaN(v) || (list.length === 10 && v >= sign * values[list[9]])) continue;
    let at = list.length;
    while (at > 0 && sign * values[list[at - 1]] > v) --at;
    list.splice(at, 0, c);
    list.length = Math.min(list.length, 10);
  }
  return list;
}
