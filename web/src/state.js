// The state of the page as the part of its address after '#': colour=order&cut=x:0.5&pick=12&view=iso ...
const axes = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};

/** "x:0.5", "-y:0.3" or "1,0.2,0:0.5": normal (what it points at is taken away) and place along the box. */
export function parseCut(text) {
  const [name, place] = (text ?? '').split(':');
  const at = place === undefined ? 0.5 : Number(place);
  if (!Number.isFinite(at)) return null;
  const sign = name.startsWith('-') ? -1 : 1;
  const axis = axes[name.replace('-', '')];
  if (axis) return {name, n: axis.map((x) => sign * x), at};
  const n = name.split(',').map(Number);
  const length = Math.hypot(...n);
  return n.length === 3 && length > 0 ? {name, n: n.map((x) => x / length), at} : null;
}

const round = (x) => Number(x.toPrecision(6));
export const cutText = (cut) => `${cut.name}:${round(cut.at)}`;

export function parseState(hash) {
  const given = new URLSearchParams(hash.replace(/^#/, ''));
  const flag = (name, otherwise) => (given.has(name) ? given.get(name) !== '0' : otherwise);
  const numbers = (name, count) => {
    const list = (given.get(name) ?? '').split(',').map(Number);
    return list.length === count && list.every(Number.isFinite) ? list : null;
  };
  return {
    colour: given.get('colour') ?? given.get('color'),
    cut: given.has('cut') ? parseCut(given.get('cut')) : null,
    clip: given.has('clip') ? given.get('clip') !== '0' : null,
    edges: flag('edges', true),
    linear: ['edges', 'surface'].includes(given.get('linear')) ? given.get('linear') : given.get('linear') === '1' ? 'edges' : 'off',
    surface: flag('surface', true),
    hide: given.has('hide') ? given.get('hide').split(',') : null,
    pick: given.has('pick') ? Number(given.get('pick')) : null,
    fly: flag('fly', false),
    view: given.get('view'),
    zoom: Number(given.get('zoom')) || 1,
    eye: numbers('eye', 6),
    tab: given.get('tab'),
    picture: flag('picture', false),
  };
}

/** eye: camera and target, six numbers. */
export function stateText(state, eye) {
  const parts = [`colour=${state.colour}`];
  if (state.cut) parts.push(`cut=${cutText(state.cut)}`);
  if (state.clip !== null) parts.push(`clip=${state.clip ? 1 : 0}`);
  if (!state.edges) parts.push('edges=0');
  if (!state.surface) parts.push('surface=0');
  if (state.linear !== 'off') parts.push(`linear=${state.linear}`);
  if (state.hide) parts.push(`hide=${state.hide.map(encodeURIComponent).join(',')}`);
  if (state.pick !== null) parts.push(`pick=${state.pick}`);
  if (state.tab) parts.push(`tab=${state.tab}`);
  if (eye) parts.push(`eye=${eye.map(round).join(',')}`);
  else if (state.view) parts.push(`view=${state.view}`);
  return parts.join('&');
}
