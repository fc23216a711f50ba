import {gradient} from './colours.js';
import {el, number, power} from './dom.js';

/** Legend of a mode; `used` tells which categories occur. */
export function legend(mode, used) {
  if (mode.name === 'plain') return [];
  const head = [el('b', {}, mode.label), el('span', {class: 'note'}, mode.note)];
  const missing = mode.missing ? swatch('#d9dde3', mode.missing) : mode.alarm ? swatch(...mode.alarm) : null;
  if (mode.entries) {
    const list = mode.entries.map((name, i) => (used && !used.has(i) ? null : swatch(mode.colours[i], name)));
    return [...head, el('div', {class: 'swatches'}, list, missing)];
  }
  const [low, high] = mode.range;
  let ticks;
  if (mode.isLog) {
    const from = Math.round(Math.log10(low)), to = Math.round(Math.log10(high));
    ticks = Array.from({length: to - from + 1}, (_, i) => power(from + i));
  } else {
    ticks = [0, 0.25, 0.5, 0.75, 1].map((x) => number(low + x * (high - low), 3));
  }
  return [...head, el('div', {class: 'ramp', style: `background:${gradient(mode.texels)}`}),
    el('div', {class: 'ticks'}, ticks.map((t) => el('span', {}, t))), missing && el('div', {class: 'swatches'}, missing)];
}

const swatch = (colour, text) => el('span', {class: 'swatch'}, el('i', {style: `background:${colour}`}), text);
