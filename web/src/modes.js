// What the mesh can be coloured by. A mode gives every cell (and every point of the surface, if it varies
// there) a value in [0,1], or -1 where there is none, or -2 where it is
// an alarm, and says what its legend shows.
import {alarm, categories, maps, orderColours, patchColours, plain, shapeColours} from './colours.js';

const shapeNames = {4: 'tet', 5: 'pyramid', 6: 'prism', 7: 'hex'};
export const shapeName = (code) => shapeNames[code];

function finiteRange(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) {
    if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  }
  return [low, high];
}

const middle = (index, count) => (index + 0.5) / count;

/** Values up to 1; those of 0 and less, which no valid element has, get the colour of alarm. */
function linearMode(name, label, note, alarmText, values) {
  const positive = values.filter((v) => v > 0);
  const [low] = finiteRange(positive);
  const from = Math.max(0, Math.min(Math.floor(low * 20) / 20, 0.95));
  const bad = values.reduce((n, v) => n + (v <= 0), 0);
  return {
    name, label, note, alarm: bad > 0 ? [alarm, `${alarmText}: ${bad}`] : null, texels: maps.lagoon, range: [from, 1], isLog: false,
    ofCell: (c) => (values[c] <= 0 ? -2 : Number.isFinite(values[c]) ? Math.min(1, Math.max(0, (values[c] - from) / (1 - from))) : -1),
  };
}

/** Decades that hold nearly all values: [from, to]. */
function decades(values) {
  const positive = Array.from(values).filter((d) => d > 0).sort((a, b) => a - b);
  const high = positive.at(-1) ?? 1e-12;
  // Nodes lie on the CAD: their round-off would stretch the scale over ten decades.
  const floor = Math.max(positive[Math.floor(positive.length * 0.05)] ?? 1e-12, high * 2e-4);
  const to = Math.ceil(Math.log10(high));
  return [Math.min(Math.floor(Math.log10(floor)), to - 1), to];
}

function deviationMode(points, cells, linear) {
  const scale = ([from, to]) => ({
    range: [10 ** from, 10 ** to],
    at: (d) => (Number.isFinite(d) ? Math.min(1, Math.max(0, (Math.log10(Math.max(d, 1e-300)) - from) / (to - from))) : -1),
  });
  const curved = scale(decades(points)), flat = scale(decades(linear));
  return {
    name: 'deviation', label: 'Deviation', note: 'distance to the CAD [mesh units], log scale', isLog: true,
    missing: 'planar, inside, or no CAD', texels: maps.ember, range: curved.range,
    ofCell: (c) => curved.at(cells[c]), ofPoint: (p) => curved.at(points[p]),
    // The flat faces miss by far more: they have a scale of their own.
    linear: linear.some(Number.isFinite) && {note: 'largest distance of the linear faces to the CAD [mesh units], log scale', range: flat.range, ofFace: (f) => flat.at(linear[f])},
  };
}

export function makeModes({arrays, about}) {
  const highest = Math.max(4, ...new Set(arrays.cell_order));
  const orders = orderColours.slice(0, highest);
  const shapes = Object.keys(shapeColours);
  const list = [{
    name: 'order', label: 'Order', note: 'polynomial degree of the element', ...categories(orders),
    entries: orders.map((_, i) => `Q${i + 1}`),
    ofCell: (c) => middle(arrays.cell_order[c] - 1, highest),
  }];
  if (about.has_deviation) list.push(deviationMode(arrays.point_deviation, arrays.cell_deviation, arrays.face_linear_deviation));
  if (arrays.cell_cost.length) list.push(linearMode('cost', 'Cost', 'C = min(1, Jp/Jc) / WCN, lowest; 1 is best', 'inverted', arrays.cell_cost));
  list.push(linearMode('bound', 'Bound', 'proved bound of min J / max J; valid above 0', 'not certified', arrays.cell_bound));
  list.push({
    name: 'shape', label: 'Shape', note: 'shape of the element', ...categories(Object.values(shapeColours)), entries: shapes,
    ofCell: (c) => middle(shapes.indexOf(shapeName(arrays.cell_shape[c])), shapes.length),
  });
  const patches = about.patches.map((_, i) => patchColours[i % patchColours.length]);
  if (patches.length > 1 && patches.length <= 64) {
    list.push({
      name: 'patch', label: 'Patch', note: 'surface patch of the mesh', ...categories(patches), entries: about.patches,
      ofCell: () => -1, ofFace: (f) => middle(arrays.face_patch[f], patches.length), missing: 'inside',
    });
  }
  list.push({name: 'plain', label: 'Plain', note: '', ...categories([plain]), entries: [], ofCell: () => 0.5});
  return list;
}
