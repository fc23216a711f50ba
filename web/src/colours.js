// Colour maps, as 256 RGBA texels each. Scalars: lightness rises or falls all the way, so that
// they read without hue too; dark is what wants attention.
const lagoon = ['#27102f', '#3a2a63', '#38548f', '#3a82a8', '#52adb0', '#8fd2b6', '#d3edd2', '#f6faee'];
const ember = ['#f8f1e0', '#fbdc9f', '#fabb66', '#f3925a', '#e0655f', '#bd4070', '#8c2a78', '#571d6b', '#2b1150'];
export const orderColours = ['#c3cad4', '#4d9ad0', '#f0a93b', '#cf4a5c', '#7d5ba6', '#4f9d69', '#8c6d4f', '#e58bb5'];
export const shapeColours = {tet: '#6f9fd0', pyramid: '#f0a93b', prism: '#6dbb85', hex: '#9a7fb8'};
export const patchColours = ['#8fb4d6', '#e8b67a', '#93c6a3', '#d59aa6', '#b3a3d0', '#c9c48b', '#8cc5c9', '#c7a48f'];
export const plain = '#b9c6d6';
export const alarm = '#e3002b';

function rgb(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

function ramp(anchors) {
  const texels = new Uint8Array(256 * 4);
  const colours = anchors.map(rgb);
  for (let i = 0; i < 256; ++i) {
    const x = (i / 255) * (colours.length - 1);
    const k = Math.min(Math.floor(x), colours.length - 2);
    for (let c = 0; c < 3; ++c) texels[4 * i + c] = colours[k][c] + (x - k) * (colours[k + 1][c] - colours[k][c]);
    texels[4 * i + 3] = 255;
  }
  return texels;
}

function steps(list) {
  const texels = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) {
    texels.set([...rgb(list[Math.min(list.length - 1, Math.floor((i * list.length) / 256))]), 255], 4 * i);
  }
  return texels;
}

export const maps = {lagoon: ramp(lagoon), ember: ramp(ember)};
export const categories = (colours) => ({texels: steps(colours), colours});

/** CSS gradient of a ramp, left to right. */
export function gradient(texels) {
  const stops = [];
  for (let i = 0; i <= 255; i += 15) stops.push(`rgb(${texels[4 * i]},${texels[4 * i + 1]},${texels[4 * i + 2]})`);
  return `linear-gradient(to right,${stops.join(',')})`;
}
