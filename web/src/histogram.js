// Histograms as SVG; bars in the colours of the picture, counts on a logarithmic scale.
import {count, el, svg} from './dom.js';

const width = 300, height = 96, base = 78;

/** bars: [{label, n, colour, title}]; ticks: [{at in 0..1, text}] */
function plot(title, note, bars, ticks) {
  const top = Math.log10(1 + Math.max(1, ...bars.map((b) => b.n)));
  const step = width / bars.length;
  const picture = svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title});
  for (let decade = 1; decade < top; ++decade) {
    const y = base - (Math.log10(1 + 10 ** decade) / top) * (base - 15);
    picture.append(svg('line', {x1: 0, x2: width, y1: y, y2: y, class: 'guide'}));
  }
  bars.forEach((bar, i) => {
    const h = (Math.log10(1 + bar.n) / top) * (base - 15);
    const rect = svg('rect', {x: i * step + 0.75, y: base - h, width: step - 1.5, height: h, fill: bar.colour}, svg('title'));
    rect.firstChild.textContent = `${bar.title}: ${count(bar.n)}`;
    picture.append(rect);
    if (bar.label) {
      const text = svg('text', {x: (i + 0.5) * step, y: height - 4, 'text-anchor': 'middle'});
      text.textContent = bar.label;
      const total = svg('text', {x: (i + 0.5) * step, y: base - h - 3, 'text-anchor': 'middle', class: 'total'});
      total.textContent = count(bar.n);
      picture.append(text, total);
    }
  });
  picture.append(svg('line', {x1: 0, x2: width, y1: base, y2: base, class: 'axis'}));
  ticks.forEach(({at, text}, i) => {
    const label = svg('text', {x: at * width, y: height - 4, 'text-anchor': i === 0 ? 'start' : i === ticks.length - 1 ? 'end' : 'middle'});
    label.textContent = text;
    picture.append(label);
  });
  return el('figure', {}, el('figcaption', {}, el('b', {}, title), el('span', {}, note)), picture);
}

function texel(texels, x) {
  const i = 4 * Math.min(255, Math.max(0, Math.round(255 * x)));
  return `rgb(${texels[i]},${texels[i + 1]},${texels[i + 2]})`;
}

export function categoryHistogram(title, note, labels, counts, colours) {
  return plot(title, note, labels.map((label, i) => ({label, title: label, n: counts[i], colour: colours[i]})), []);
}

/** values in [0,1] (the colour's place), others are left out; text(x) names a place. */
export function scalarHistogram(title, note, places, texels, text) {
  const bins = new Array(24).fill(0);
  for (const x of places) if (x >= 0) ++bins[Math.min(bins.length - 1, Math.floor(x * bins.length))];
  const bars = bins.map((n, i) => ({
    n, colour: texel(texels, (i + 0.5) / bins.length), title: `${text(i / bins.length)} to ${text((i + 1) / bins.length)}`,
  }));
  return plot(title, note, bars, [0, 0.5, 1].map((at) => ({at, text: text(at)})));
}
