// Small helpers to build the panel. Text is always set as text, never as HTML: names come from files.

export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (name === 'class') element.className = value;
    else if (name in element && name !== 'list') element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((c) => c !== null && c !== undefined && c !== false).map((c) => (c instanceof Node ? c : String(c))));
  return element;
}

export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Rows of [name, value]; rows without a value are left out. */
export function facts(rows) {
  return el('table', {class: 'facts'}, rows.filter(([, v]) => v !== null && v !== undefined && v !== '')
    .map(([name, value]) => el('tr', {}, el('th', {}, name), el('td', {}, value))));
}

export function table(head, rows, {onrow} = {}) {
  return el('div', {class: 'scroll'}, el('table', {class: 'grid'},
    el('thead', {}, el('tr', {}, head.map((h) => el('th', {}, h)))),
    el('tbody', {}, rows.map((row, i) => {
      const tr = el('tr', {}, row.map((cell) => el('td', {}, cell ?? '')));
      if (onrow) {
        tr.className = 'link';
        tr.tabIndex = 0;
        tr.addEventListener('click', () => onrow(i));
        tr.addEventListener('keydown', (e) => { if (e.key === 'Enter') onrow(i); });
      }
      return tr;
    }))));
}

const superscript = '⁰¹²³⁴⁵⁶⁷⁸⁹';
export function power(exponent) {
  return `10${exponent < 0 ? '⁻' : ''}${[...String(Math.abs(exponent))].map((d) => superscript[d]).join('')}`;
}

/** A few digits, as short as they can be. */
export function number(x, digits = 4) {
  if (x === null || x === undefined || Number.isNaN(x)) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e-3 && size < 1e6) return String(Number(x.toPrecision(digits)));
  const exponent = Math.floor(Math.log10(size));
  const mantissa = Number((x / 10 ** exponent).toPrecision(digits - 1));
  return mantissa === 1 ? power(exponent) : `${mantissa}·${power(exponent)}`;
}

export const count = (n) => n.toLocaleString('en').replaceAll(',', '\u202f');
