/** Principal axes of an inertia tensor. */

type Row = [number, number, number];

/** Moments and their axes: unit vectors that form a right-handed frame. By Jacobi rotations. */
export function principal([xx, xy, xz, yy, yz, zz]: readonly [number, number, number, number, number, number]): {
  moments: Row;
  axes: [Row, Row, Row];
} {
  const m: [Row, Row, Row] = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  // Columns are the axes.
  const v: [Row, Row, Row] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const pairs = [
    [0, 1],
    [0, 2],
    [1, 2],
  ] as const;
  for (let sweep = 0; sweep < 30; sweep++) {
    for (const [p, q] of pairs) {
      if (Math.abs(m[p][q]) < 1e-300) continue;
      const theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (const row of [m[0], m[1], m[2]]) {
        [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
      }
      for (let k: 0 | 1 | 2 = 0; k < 3; k++) {
        const [a, b] = [m[p][k as 0 | 1 | 2], m[q][k as 0 | 1 | 2]];
        m[p][k as 0 | 1 | 2] = c * a - s * b;
        m[q][k as 0 | 1 | 2] = s * a + c * b;
      }
      for (const row of v) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
    }
  }
  const column = (k: 0 | 1 | 2): Row => [v[0][k], v[1][k], v[2][k]];
  const [x, y] = [column(0), column(1)];
  const z: Row = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  return { moments: [m[0][0], m[1][1], m[2][2]], axes: [x, y, z] };
}
