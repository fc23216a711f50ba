// The curved surface: points of all faces, which triangles are shown, element edges, the linear mesh.

/** Lattice nodes along side k of a face of level n with 3 or 4 corners, in Camber's canonical order. */
export function side(corners, n, k) {
  const node = corners === 3 ? (i, j) => j * (n + 1) - (j * (j - 1)) / 2 + i : (i, j) => j * (n + 1) + i;
  const place = corners === 3
    ? [(t) => [t, 0], (t) => [n - t, t], (t) => [0, n - t]]
    : [(t) => [t, 0], (t) => [n, t], (t) => [n - t, n], (t) => [0, n - t]];
  return Array.from({length: n + 1}, (_, t) => node(...place[k](t)));
}

export class Surface {
  constructor({arrays, about}) {
    Object.assign(this, {
      points: arrays.point, corners: arrays.face_corners, level: arrays.face_level, own: arrays.face_own_edges,
      firstTriangle: arrays.face_first_triangle, triangles: arrays.triangle, cell: arrays.face_cell, patch: arrays.face_patch,
    });
    this.faceCount = this.corners.length;
    this.firstPoint = new Uint32Array(this.faceCount + 1);
    for (let f = 0; f < this.faceCount; ++f) {
      const n = this.level[f];
      this.firstPoint[f + 1] = this.firstPoint[f] + (this.corners[f] === 3 ? ((n + 1) * (n + 2)) / 2 : (n + 1) ** 2);
    }
    this.cellHasFace = new Uint8Array(about.cells);
    for (const c of this.cell) this.cellHasFace[c] = 1;
    this.sides = new Map();
    this.findPatchBoxes(about.patches.length);
  }

  sideOf(f, k) {
    const key = this.level[f] * 16 + this.corners[f] * 4 + k - 12;
    if (!this.sides.has(key)) this.sides.set(key, side(this.corners[f], this.level[f], k));
    return this.sides.get(key);
  }

  cornerPoints(f) {
    return Array.from({length: this.corners[f]}, (_, k) => this.firstPoint[f] + this.sideOf(f, k)[0]);
  }

  findPatchBoxes(count) {
    this.boxes = Array.from({length: count}, () => ({low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity], curved: false}));
    for (let f = 0; f < this.faceCount; ++f) {
      const box = this.boxes[this.patch[f]];
      if (this.level[f] > 1) box.curved = true;
      for (let p = this.firstPoint[f]; p < this.firstPoint[f + 1]; ++p) {
        for (let d = 0; d < 3; ++d) {
          box.low[d] = Math.min(box.low[d], this.points[3 * p + d]);
          box.high[d] = Math.max(box.high[d], this.points[3 * p + d]);
        }
      }
    }
  }

  /** Patches worth seeing at first: the curved ones, and what is not much larger (a far box hides all). */
  firstVisible() {
    const size = (b) => Math.hypot(...b.high.map((h, d) => h - b.low[d]));
    const wholeSize = size(this.boxOf(this.boxes.map(() => true)));
    let inner = this.boxes.map((b) => b.curved);
    if (!inner.some(Boolean)) inner = this.boxes.map((b) => size(b) < 0.7 * wholeSize);
    if (!inner.some(Boolean)) inner = inner.map(() => true);
    const limit = 1.5 * size(this.boxOf(inner));
    return this.boxes.map((b, i) => inner[i] || size(b) <= limit);
  }

  boxOf(shown) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    this.boxes.forEach((b, i) => {
      if (!shown[i]) return;
      for (let d = 0; d < 3; ++d) {
        low[d] = Math.min(low[d], b.low[d]);
        high[d] = Math.max(high[d], b.high[d]);
      }
    });
    return {low, high};
  }

  /** Triangles of the shown patches: {index, face by triangle}. */
  shownTriangles(shown) {
    let count = 0;
    for (let f = 0; f < this.faceCount; ++f) {
      if (shown[this.patch[f]]) count += this.firstTriangle[f + 1] - this.firstTriangle[f];
    }
    const index = new Uint32Array(3 * count), face = new Uint32Array(count);
    let t = 0;
    for (let f = 0; f < this.faceCount; ++f) {
      if (!shown[this.patch[f]]) continue;
      for (let s = this.firstTriangle[f]; s < this.firstTriangle[f + 1]; ++s, ++t) {
        for (let k = 0; k < 3; ++k) index[3 * t + k] = this.firstPoint[f] + this.triangles[3 * s + k];
        face[t] = f;
      }
    }
    return {index, face};
  }

  /** Element edges as pairs of points. */
  shownEdges(shown) {
    const all = shown.every(Boolean);
    const pairs = [];
    for (let f = 0; f < this.faceCount; ++f) {
      if (!shown[this.patch[f]]) continue;
      for (let k = 0; k < this.corners[f]; ++k) {
        // An edge belongs to the first face that has it; that face may be hidden now.
        if (all && !(this.own[f] & (1 << k))) continue;
        const nodes = this.sideOf(f, k);
        for (let i = 1; i < nodes.length; ++i) pairs.push(this.firstPoint[f] + nodes[i - 1], this.firstPoint[f] + nodes[i]);
      }
    }
    return Uint32Array.from(pairs);
  }

  /** Straight edges and flat faces through the corners: {lines, triangles as coordinates, face by triangle}. */
  linear(shown) {
    const lines = [], corners = [], face = [];
    for (let f = 0; f < this.faceCount; ++f) {
      if (!shown[this.patch[f]]) continue;
      const c = this.cornerPoints(f);
      c.forEach((p, k) => lines.push(p, c[(k + 1) % c.length]));
      for (let k = 2; k < c.length; ++k) {
        corners.push(c[0], c[k - 1], c[k]);
        face.push(f);
      }
    }
    const triangles = new Float32Array(3 * corners.length);
    corners.forEach((p, i) => triangles.set(this.points.subarray(3 * p, 3 * p + 3), 3 * i));
    return {lines: Uint32Array.from(lines), triangles, face: Uint32Array.from(face)};
  }

  /** Largest distance of a side's middle from the middle of its chord. */
  largestBulge() {
    let largest = 0;
    const {points: x} = this;
    for (let f = 0; f < this.faceCount; ++f) {
      for (let k = 0; k < this.corners[f] && this.level[f] > 1; ++k) {
        const nodes = this.sideOf(f, k);
        const [a, m, b] = [0, nodes.length >> 1, nodes.length - 1].map((i) => 3 * (this.firstPoint[f] + nodes[i]));
        const w = (nodes.length >> 1) / (nodes.length - 1);
        largest = Math.max(largest, Math.hypot(...[0, 1, 2].map((d) => x[m + d] - (1 - w) * x[a + d] - w * x[b + d])));
      }
    }
    return largest;
  }
}
