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
    const made = {triangles: [], cells: [], lines: []};
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
    return {triangles: Float32Array.from(made.triangles), cells: Uint32Array.from(made.cells), lines: Float32Array.from(made.lines)};
  }
}

function cutCell(t, c, x, s, made) {
  const cross = (a, b, list) => {
    const w = s[a] / (s[a] - s[b]);
    for (let d = 0; d < 3; ++d) list.push(x[3 * a + d] + w * (x[3 * b + d] - x[3 * a + d]));
  };
  const above = (i) => s[i] >= 0;
  for (let k = 0; k < t.tets.length; k += 4) {
    const up = [], down = [];
    for (let i = 0; i < 4; ++i) (above(t.tets[k + i]) ? up : down).push(t.tets[k + i]);
    if (up.length === 0 || down.length === 0) continue;
    const list = made.triangles;
    if (up.length !== 2) {
      const [one, three] = up.length === 1 ? [up[0], down] : [down[0], up];
      for (const other of three) cross(one, other, list);
      made.cells.push(c);
    } else {
      const [a, b] = up, [e, f] = down;
      cross(a, e, list); cross(a, f, list); cross(b, f, list);
      cross(a, e, list); cross(b, f, list); cross(b, e, list);
      made.cells.push(c, c);
    }
  }
  for (let k = 0; k < t.skin.length; k += 3) {
    const up = [], down = [];
    for (let i = 0; i < 3; ++i) (above(t.skin[k + i]) ? up : down).push(t.skin[k + i]);
    if (up.length === 0 || down.length === 0) continue;
    const [one, two] = up.length === 1 ? [up[0], down] : [down[0], up];
    cross(one, two[0], made.lines);
    cross(one, two[1], made.lines);
  }
}
