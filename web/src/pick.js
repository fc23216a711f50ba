// Which element is under the pointer: the nearest triangle along a ray.

/** Smallest t > 0 at which origin + t direction meets a triangle: {t, triangle}, or null. */
export function nearestHit({origin, direction}, points, index, isHidden) {
  const count = (index ? index.length : points.length / 3) / 3;
  const [ox, oy, oz] = [origin.x, origin.y, origin.z];
  const [dx, dy, dz] = [direction.x, direction.y, direction.z];
  let best = Infinity, hit = -1;
  for (let k = 0; k < count; ++k) {
    const a = 3 * (index ? index[3 * k] : 3 * k), b = 3 * (index ? index[3 * k + 1] : 3 * k + 1), c = 3 * (index ? index[3 * k + 2] : 3 * k + 2);
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const det = ux * px + uy * py + uz * pz;
    if (det === 0) continue;
    const tx = ox - points[a], ty = oy - points[a + 1], tz = oz - points[a + 2];
    const u = (tx * px + ty * py + tz * pz) / det;
    if (u < 0 || u > 1) continue;
    const qx = ty * uz - tz * uy, qy = tz * ux - tx * uz, qz = tx * uy - ty * ux;
    const v = (dx * qx + dy * qy + dz * qz) / det;
    if (v < 0 || u + v > 1) continue;
    const t = (vx * qx + vy * qy + vz * qz) / det;
    if (t <= 0 || t >= best) continue;
    if (isHidden?.(ox + t * dx, oy + t * dy, oz + t * dz)) continue;
    best = t;
    hit = k;
  }
  return hit < 0 ? null : {t: best, triangle: hit};
}
