//! Support points in a fixed set of directions: a bounded stand-in for a point set's hull.
//!
//! A part may have thousands of points; its hull is described well enough for the *search* by the
//! farthest point in each of [`COUNT`] directions. Hulls do not change under scaling along axes, so
//! flat sets are best scaled to a cube first: then the directions find their rims.

use std::sync::LazyLock;

/// Number of directions.
pub(super) const COUNT: usize = 48;

struct Directions {
    x: [f32; COUNT],
    y: [f32; COUNT],
    z: [f32; COUNT],
}

/// The 26 directions of a cube's faces, corners and edges, the rest a Fibonacci lattice on the sphere
/// (Gonzalez, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices", 2010).
static DIRECTIONS: LazyLock<Directions> = LazyLock::new(|| {
    let mut list: Vec<[f64; 3]> = Vec::with_capacity(COUNT);
    for kind in [1, 3, 2] {
        for code in 0..27_i32 {
            let d = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
            if d.iter().map(|c| c * c).sum::<i32>() == kind {
                list.push(d.map(f64::from));
            }
        }
    }
    let rest = COUNT - list.len();
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    for i in 0..rest {
        let z = 1.0 - (2 * i + 1) as f64 / rest as f64;
        let r = (1.0 - z * z).sqrt();
        let a = golden * i as f64;
        list.push([r * a.cos(), r * a.sin(), z]);
    }
    let mut out = Directions {
        x: [0.0; COUNT],
        y: [0.0; COUNT],
        z: [0.0; COUNT],
    };
    for (i, d) in list.iter().enumerate() {
        let n = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        out.x[i] = (d[0] / n) as f32;
        out.y[i] = (d[1] / n) as f32;
        out.z[i] = (d[2] / n) as f32;
    }
    out
});

/// No point seen yet.
pub(super) const NONE: u32 = u32::MAX;

/// For each direction the largest dot product and the index of the point that has it.
#[derive(Clone)]
pub(super) struct Support {
    pub value: [f32; COUNT],
    pub point: [u32; COUNT],
}

impl Support {
    pub fn new() -> Self {
        Support {
            value: [f32::NEG_INFINITY; COUNT],
            point: [NONE; COUNT],
        }
    }

    /// Takes the point in; the first of equal ones stays.
    #[inline]
    pub fn add(&mut self, p: [f64; 3], index: u32) {
        let d = &*DIRECTIONS;
        let (x, y, z) = (p[0] as f32, p[1] as f32, p[2] as f32);
        for i in 0..COUNT {
            let v = x * d.x[i] + y * d.y[i] + z * d.z[i];
            let better = v > self.value[i];
            self.value[i] = if better { v } else { self.value[i] };
            self.point[i] = if better { index } else { self.point[i] };
        }
    }

    /// The different support points, in the order of the directions.
    pub fn points(&self) -> Vec<u32> {
        let mut out: Vec<u32> = Vec::with_capacity(COUNT);
        for &p in &self.point {
            if p != NONE && !out.contains(&p) {
                out.push(p);
            }
        }
        out
    }
}
