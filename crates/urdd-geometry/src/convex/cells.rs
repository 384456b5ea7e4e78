//! Cells of directions, and the points that can be farthest in each.

/// For each cell, row by row, the indices of the points that are farthest in some direction of the cell.
///
/// The cells divide an octahedral map of the sphere onto a square of `side` x `side` cells (Cigolle et al., "A Survey
/// of Efficient Representations for Independent Unit Vectors", J. Computer Graphics Techniques 3(2), 2014). On each
/// cell, the map is linear in one or two triangles, and so is the dot product of a point and the direction. So a point
/// that another one beats at all corners of a cell is beaten in the whole cell. `side` is a power of two, at least 2.
/// `points` must not be empty.
pub(crate) fn candidates(points: &[[f64; 3]], side: usize) -> Vec<Vec<u32>> {
    let mut search = Search {
        points,
        side,
        lists: vec![Vec::new(); side * side],
        stack: (0..points.len() as u32).collect(),
        values: Vec::new(),
    };
    // A square across several octants would not be linear.
    let half = side / 2;
    for (row, column) in [(0, 0), (0, half), (half, 0), (half, half)] {
        search.divide(0, [row, column, half]);
    }
    search.lists
}

struct Search<'a> {
    points: &'a [[f64; 3]],
    side: usize,
    lists: Vec<Vec<u32>>,
    /// The candidates of the current square, after those of the squares that contain it.
    stack: Vec<u32>,
    /// Dot products of the candidates with the corners; kept to reuse its memory.
    values: Vec<[f64; 4]>,
}

impl Search<'_> {
    /// Keeps the points of `stack[start..]` that can be farthest within a square, and recurses into its quarters.
    fn divide(&mut self, start: usize, [row, column, size]: [usize; 3]) {
        let end = self.stack.len();
        if end - start == 1 {
            for r in row..row + size {
                for list in &mut self.lists[r * self.side + column..][..size] {
                    list.push(self.stack[start]);
                }
            }
            return;
        }
        self.keep(start, [row, column, size]);
        if size == 1 {
            self.lists[row * self.side + column] = self.stack[end..].to_vec();
        } else {
            let half = size / 2;
            for (r, c) in [(0, 0), (0, half), (half, 0), (half, half)] {
                self.divide(end, [row + r, column + c, half]);
            }
        }
        self.stack.truncate(end);
    }

    /// Pushes the points of `stack[start..]` that can be farthest within a square.
    fn keep(&mut self, start: usize, [row, column, size]: [usize; 3]) {
        let end = self.stack.len();
        let at = |i: usize| 2.0 * i as f64 / self.side as f64 - 1.0;
        let (u, v) = ([at(row), at(row + size)], [at(column), at(column + size)]);
        let corners = [
            direction(u[0], v[0]),
            direction(u[0], v[1]),
            direction(u[1], v[0]),
            direction(u[1], v[1]),
        ];
        // The farthest point at each corner, and for the sum of the corners.
        let mut best = [0; 5];
        let mut most = [f64::NEG_INFINITY; 5];
        self.values.clear();
        for i in start..end {
            let p = self.points[self.stack[i] as usize];
            let value = corners.map(|d| p[0] * d[0] + p[1] * d[1] + p[2] * d[2]);
            let mean = value[0] + value[1] + value[2] + value[3];
            for (k, x) in [value[0], value[1], value[2], value[3], mean].into_iter().enumerate() {
                if x > most[k] {
                    (best[k], most[k]) = (i - start, x);
                }
            }
            self.values.push(value);
        }
        let strongest = best.map(|b| self.values[b]);
        for (i, value) in self.values.iter().enumerate() {
            let beaten = || strongest.iter().any(|s| (0..4).all(|k| s[k] >= value[k]));
            if best.contains(&i) || !beaten() {
                self.stack.push(self.stack[start + i]);
            }
        }
    }
}

/// The direction (not normalized) for the point `u`, `v` of the map, each from -1 to 1.
fn direction(u: f64, v: f64) -> [f64; 3] {
    let z = 1.0 - u.abs() - v.abs();
    if z >= 0.0 { [u, v, z] } else { [(1.0 - v.abs()).copysign(u), (1.0 - u.abs()).copysign(v), z] }
}

#[cfg(test)]
#[path = "tests/cells.rs"]
mod tests;
