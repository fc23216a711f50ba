// The report of the run as tables: the paper's by group and order, options, times.
import {count, el, facts, number, table} from './dom.js';

const percent = (a, b) => (b > 0 ? `${number((100 * a) / b, 3)} %` : '–');
const bytes = (n) => (n ? `${number(n / 2 ** 20, 3)} MiB` : '');

/** A path that may be broken after its slashes. */
const breakable = (path) => path && el('span', {}, path.split(/(?<=\/)/).flatMap((part) => [part, el('wbr')]));

function surfaceTables({surface}) {
  if (!surface?.faces) return [];
  const head = ['', 'faces', 'average', 'maximum', 'linear average', 'linear maximum'];
  const row = (name, r) => [name, count(r.faces), ...[r.average, r.maximum, r.linear_average, r.linear_maximum].map((x) => number(x, 3))];
  const names = surface.by_group.map((r) => r.name);
  // Several CAD faces may carry one name.
  const nameOf = (r) => (names.filter((n) => n === r.name).length > 1 ? `${r.name} ${r.cad.join(' ')}` : r.name);
  return [
    el('h3', {}, 'Surface error by group'),
    el('p', {class: 'note'}, 'Shape conformity: distance to the CAD averaged over the area, and largest, of the curved and of the linear faces [mesh units]. Planar CAD faces are left out.'),
    table(head, [...surface.by_group.map((r) => row(nameOf(r), r)), row('all', surface)]),
    el('h3', {}, 'Surface error by order'),
    table(head, surface.by_order.map((r) => row(`Q${r.order}`, r))),
  ];
}

function cellTable({output}) {
  const by = output?.cells_by_shape_and_order;
  if (!by) return [];
  const orders = [...new Set(Object.values(by).flatMap((o) => Object.keys(o).filter((p) => o[p] > 0)))].sort();
  const rows = Object.entries(by).map(([shape, o]) => [shape, ...orders.map((p) => count(o[p] ?? 0)), count(Object.values(o).reduce((a, b) => a + b, 0))]);
  const all = orders.map((p) => Object.values(by).reduce((sum, o) => sum + (o[p] ?? 0), 0));
  const cells = all.reduce((a, b) => a + b, 0);
  rows.push(['all', ...all.map(count), count(cells)], ['share', ...all.map((n) => percent(n, cells)), '']);
  return [el('h3', {}, 'Cells by shape and order'), table(['', ...orders.map((p) => `Q${p}`), 'all'], rows)];
}

const pairs = (object, value = (x) => x) => facts(Object.entries(object ?? {}).map(([k, v]) => [k, value(v)]));

export function reportTab(report, about) {
  if (!report) return [el('p', {class: 'note'}, 'No report came with this mesh.')];
  const {validity: v, conformity: c, quality: q, rescue: r} = report;
  const over = report.surface?.faces ? `${count(report.surface.faces_over_deviation)} of ${count(report.surface.faces)}` : '';
  return [
    facts([
      ['status', el('span', {class: report.status === 'ok' ? 'good' : 'bad'}, report.status)],
      ['mesh', breakable(report.input?.mesh)], ['CAD', breakable(report.input?.geometry?.join(', '))],
      ['written', breakable(report.command === 'curve' ? report.output?.path : '')],
      ['certified', v && `${count(v.certified)} of ${count(v.certified + v.invalid + v.undecided)} cells`],
      ['invalid, undecided', v && v.invalid + v.undecided > 0 ? `${count(v.invalid)}, ${count(v.undecided)}` : ''],
      ['lowest bound of min J / max J', v && number(v.min_scaled_jacobian)],
      ['largest gap', c && number(c.max_gap)], ['order jump at most', c?.max_order_jump],
      ['cost: lowest, average', q && `${number(q.cost?.minimum)}, ${number(q.cost?.average)}`],
      ['faces over the deviation', over],
      ['scaled back, pinched', r && (r.scaled_back || r.pinched) ? `${count(r.scaled_back)}, ${count(r.pinched)}` : ''],
    ]),
    ...surfaceTables(report), ...cellTable(report),
    ...(report.warnings?.length ? [el('h3', {}, 'Warnings'), el('ul', {}, report.warnings.map((w) => el('li', {}, w)))] : []),
    el('h3', {}, 'Options'), pairs(report.options),
    el('h3', {}, 'Times'), pairs(Object.fromEntries(Object.entries(report.time?.stages_s ?? {}).filter(([, s]) => s > 0)), (s) => `${number(s, 3)} s`),
    facts([['total', report.time && `${number(report.time.total_s, 3)} s`], ['memory', bytes(report.memory?.peak_bytes)], ['threads', report.threads]]),
    el('p', {class: 'note'}, `camber ${report.camber?.version ?? about.version}, command ${report.command ?? ''}. Page by camber ${about.version} with three.js.`),
  ];
}
