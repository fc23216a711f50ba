// The cells' polynomials: cutting them by a plane, and the shape of one cell.

/** Corners may bulge by this share of the cell's extent beyond its nodes. */
const margin = 0.15;

export class Volume {
  constructor({arrays, about}) {
    this.points = arrays.volume_point;
    this.nodes = arrays.volume_node;
    this.shape = arrays.cell_shape;
    this.order = arrays.cell_order;
    this.cornersOnly = about.corners_only;
    this.tables = new Map();
    for (const t of about.tables) {
      this.tables.set(t.shape * 64 + t.order, {
        ...t, matrix: Float64Array.from(t.matrix), tets: Int32Array.from(t.tets.flat()), skin: Int32Array.from(t.skin.flat()),
      });
    }
    this.cellCount = this.shape.length;
    this.first = new Uint32Array(this.cellCount + 1);
    for (let c = 0; c < this.cellCount; ++c) this.first[c + 1] = this.first[c] + this.table(c).nodes;
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.points.length; ++i) {
      this.low[i % 3] = Math.min(this.low[i % 3], this.points[i]);
      this.high[i % 3] = Math.max(this.high[i % 3], this.points[i]);
    }
    this.distance = new Float32Array(this.points.length / 3);
  }

  table(c) {
    return this.tables.get(this.shape[c] * 64 + (this.cornersOnly ? 1 : this.order[c]));
  }

  /** Points of the cell's polynomial at the lattice of its table, into `out`. */
  lattice(c, out) {
    const t = this.table(c);
    for (let r = 0; r < t.points; ++r) {
      let x = 0, y = 0, z = 0;
      for (let k = 0; k < t.nodes; ++k) {
        const w = t.matrix[r * t.nodes + k];
        if (w === 0) continue;
        const p = 3 * this.nodes[this.first[c] + k];
        x += w * this.points[p];
        y += w * this.points[p + 1];
        z += w * this.points[p + 2];
      }
      out[3 * r] = x;
      out[3 * r + 1] = y;
      out[3 * r + 2] = z;
    }
    return t;
  }

  centre(c) {
    const t = this.table(c), sum = [0, 0, 0];
    for (const k of t.corners) {
      for (let d = 0; d < 3; ++d) sum[d] += this.points[3 * this.nodes[this.first[c] + k] + d] / t.corners.length;
    }
    return sum;
  }

  size(c) {
    const t = this.table(c), low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const k of t.corners) {
      for (let d = 0; d < 3; ++d) {
        const x = this.points[3 * this.nodes[this.first[c] + k] + d];
        low[d] = Math.min(low[d], x);
        high[d] = Math.max(high[d], x);
      }
    }
    return Math.hypot(...high.map((h, d) => h - low[d]));
  }

  /** Triangles and edges of one cell's surface: {triangles, lines}, coordinates one after the other. */
  skin(c) {
    const out = new Float64Array(3 * this.table(c).points);
    const t = this.lattice(c, out);
    const pick = (list) => Float32Array.from(list.flatMap((n) => [out[3 * n], out[3 * n + 1], out[3 * n + 2]]));
    const lines = t.edges.flatMap((edge) => edge.slice(1).flatMap((n, i) => [edge[i], n]));
    return {triangles: pick(Array.from(t.skin)), lines: pick(lines)};
  }

  /** The plane n . x = d through all cells: {triangles, cells (one a triangle), lines}. */
  cut(n, d) {
    const {points, distance} = this;
    for (let i = 0; i < distance.length; ++i) {
      distance[i] = n[0] * points[3 * i] + n[1] * points[3 * i + 1] + n[2] * points[3 * i + 2] - d;
    }
    const made = {triangles: new Growing(Float32Array), cells: new Growing(Uint32Array), lines: new Growing(Float32Array)};
    const x = new Float64Array(3 * 1024), s = new Float64Array(1024);
    for (let c = 0; c < this.cellCount; ++c) {
      let low = Infinity, high = -Infinity;
      for (let k = this.first[c]; k < this.first[c + 1]; ++k) {
        const value = distance[this.nodes[k]];
        if (value < low) low = value;
        if (value > high) high = value;
      }
      const slack = this.order[c] > 1 ? margin * (high - low) : 0;
      if (low - slack > 0 || high + slack < 0) continue;
      const t = this.lattice(c, x);
      for (let r = 0; r < t.points; ++r) s[r] = n[0] * x[3 * r] + n[1] * x[3 * r + 1] + n[2] * x[3 * r + 2] - d;
      cutCell(t, c, x, s, made);
    }
    return {triangles: made.triangles.take(), cells: made.cells.take(), lines: made.lines.take()};
  }
}

/** Numbers of an unknown count, in one typed array that grows. */
class Growing {
  constructor(Type) {
    this.values = new Type(1 << 14);
    this.count = 0;
  }

  push(x) {
    if (this.count === this.values.length) {
      const larger = new this.values.constructor(2 * this.count);
      larger.set(this.values);
      this.values = larger;
    }
    this.values[this.count++] = x;
  }

  take() { return this.values.slice(0, this.count); }
}

// By which corners lie above the plane (bit i: corner i): the corner that is alone and the other three, or the
// two above and the two below.
const tetCases = Array.from({length: 16}, (_, mask) => {
  const up = [0, 1, 2, 3].filter((i) => mask & (1 << i)), down = [0, 1, 2, 3].filter((i) => !(mask & (1 << i)));
  if (up.length === 0 || down.length === 0) return null;
  return {isSplitEvenly: up.length === 2, corners: up.length === 3 ? [...down, ...up] : [...up, ...down]};
});

function cutCell(t, c, x, s, made) {
  const {tets, skin} = t;
  const cross = (a, b, list) => {
    const w = s[a] / (s[a] - s[b]);
    for (let d = 0; d < 3; ++d) list.push(x[3 * a + d] + w * (x[3 * b + d] - x[3 * a + d]));
  };
  for (let k = 0; k < tets.length; k += 4) {
    const mask = (s[tets[k]] >= 0 ? 1 : 0) | (s[tets[k + 1]] >= 0 ? 2 : 0) | (s[tets[k + 2]] >= 0 ? 4 : 0) | (s[tets[k + 3]] >= 0 ? 8 : 0);
    const found = tetCases[mask];
    if (!found) continue;
    const a = tets[k + found.corners[0]], b = tets[k + found.corners[1]], e = tets[k + found.corners[2]], f = tets[k + found.corners[3]];
    const list = made.triangles;
    made.cells.push(c);
    if (!found.isSplitEvenly) {
      cross(a, b, list); cross(a, e, list); cross(a, f, list);
    } else {
      made.cells.push(c);
      cross(a, e, list); cross(a, f, list); cross(b, f, list);
      cross(a, e, list); cross(b, f, list); cross(b, e, list);
    }
  }
  for (let k = 0; k < skin.length; k += 3) {
    const p = skin[k], q = skin[k + 1], r = skin[k + 2];
    const up = s[p] >= 0, uq = s[q] >= 0, ur = s[r] >= 0;
    if (up === uq && uq === ur) continue;
    if (up !== uq) cross(p, q, made.lines);
    if (uq !== ur) cross(q, r, made.lines);
    if (ur !== up) cross(r, p, made.lines);
  }
}
