//! A part of the proxy surface, and its division by a plane.

use super::vector::{dot, lerp, norm, normal};

/// A plane, in unit coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub normal: [f64; 3],
    pub offset: f64,
}

impl Plane {
    /// Signed distance.
    #[inline]
    pub fn height(&self, p: [f64; 3]) -> f64 {
        dot(self.normal, p) - self.offset
    }

    /// The plane of a triangle with an area.
    pub fn of(corners: [[f64; 3]; 3]) -> Self {
        let normal = normal(corners);
        let length = norm(normal);
        let normal = normal.map(|x| x / length);
        Plane { normal, offset: dot(normal, corners[0]) }
    }

    /// The nearest point of the plane.
    pub fn project(&self, p: [f64; 3]) -> [f64; 3] {
        let h = self.height(p);
        [0, 1, 2].map(|a| p[a] - h * self.normal[a])
    }
}

/// Points and triangles, in unit coordinates.
#[derive(Clone, Default)]
pub(super) struct Part {
    pub points: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Points inside. They are not corners of the part's hull; their projections into a cut may be.
    pub inner: Vec<[f64; 3]>,
    /// The planes that bound the part within the whole.
    pub cuts: Vec<Plane>,
}

impl Part {
    /// Whether this degenerate triangle is a loose point.
    pub fn is_loose(t: [u32; 3]) -> bool {
        t[0] == t[1] && t[1] == t[2]
    }

    /// The positions of a triangle's corners.
    pub fn corners(&self, t: [u32; 3]) -> [[f64; 3]; 3] {
        t.map(|i| self.points[i as usize])
    }

    /// Whether a triangle faces along `direction`. A triangle in a cut goes with the body behind it.
    pub fn faces(&self, t: [u32; 3], direction: [f64; 3]) -> bool {
        dot(normal(self.corners(t)), direction) > 0.0
    }

    /// The parts below and above the plane. Points within `eps` of it count as in it. Loose points and points inside
    /// that are within `reach` are also projected into it, for both sides.
    pub fn split(&self, plane: &Plane, eps: f64, reach: f64) -> [Part; 2] {
        let height: Vec<f64> = self.points.iter().map(|p| plane.height(*p)).collect();
        let side = |i: u32| {
            let h = height[i as usize];
            i32::from(h > eps) - i32::from(h < -eps)
        };
        let mut halves = [Half::new(self.points.len()), Half::new(self.points.len())];
        for &t in &self.triangles {
            if Part::is_loose(t) && height[t[0] as usize].abs() <= reach {
                let p = plane.project(self.points[t[0] as usize]);
                halves.iter_mut().for_each(|h| h.add_loose(p));
            }
            let s = t.map(side);
            let (low, high) = (s[0].min(s[1]).min(s[2]), s[0].max(s[1]).max(s[2]));
            if low == 0 && high == 0 {
                halves[usize::from(!self.faces(t, plane.normal))].keep(self, &t);
            } else if low >= 0 {
                halves[1].keep(self, &t);
            } else if high <= 0 {
                halves[0].keep(self, &t);
            } else {
                let mut rings = [[Corner::Old(0); 4]; 2];
                let mut count = [0, 0];
                for k in 0..3 {
                    let (i, j) = (t[k], t[(k + 1) % 3]);
                    for (half, sign) in [(0, -1), (1, 1)] {
                        if s[k] * sign >= 0 {
                            rings[half][count[half]] = Corner::Old(i);
                            count[half] += 1;
                        }
                        if s[k] * s[(k + 1) % 3] < 0 {
                            // The same point from either end, so that neighbours stay connected.
                            let (i, j) = (i.min(j), i.max(j));
                            let (hi, hj) = (height[i as usize], height[j as usize]);
                            let [p, q] = [i, j].map(|i| self.points[i as usize]);
                            rings[half][count[half]] = Corner::New(lerp(p, q, hi / (hi - hj)));
                            count[half] += 1;
                        }
                    }
                }
                for half in 0..2 {
                    halves[half].fan(self, &rings[half][..count[half]]);
                }
            }
        }
        for &p in &self.inner {
            let height = plane.height(p);
            if height.abs() <= reach {
                halves.iter_mut().for_each(|h| h.add_loose(plane.project(p)));
            }
            halves[usize::from(height > 0.0)].part.inner.push(p);
        }
        halves.map(|h| Part { cuts: [&self.cuts[..], &[*plane]].concat(), ..h.part })
    }
}

#[derive(Clone, Copy)]
enum Corner {
    Old(u32),
    New([f64; 3]),
}

struct Half {
    part: Part,
    place: Vec<u32>,
}

impl Half {
    fn new(points: usize) -> Self {
        Half { part: Part::default(), place: vec![u32::MAX; points] }
    }

    fn point(&mut self, from: &Part, corner: Corner) -> u32 {
        let next = self.part.points.len() as u32;
        let p = match corner {
            Corner::Old(i) => {
                let place = &mut self.place[i as usize];
                if *place != u32::MAX {
                    return *place;
                }
                *place = next;
                from.points[i as usize]
            }
            // Added once per triangle of an edge; support points tolerate duplicates.
            Corner::New(p) => p,
        };
        self.part.points.push(p);
        next
    }

    fn add_loose(&mut self, p: [f64; 3]) {
        self.part.triangles.push([self.part.points.len() as u32; 3]);
        self.part.points.push(p);
    }

    fn keep(&mut self, from: &Part, t: &[u32; 3]) {
        let t = t.map(|i| self.point(from, Corner::Old(i)));
        self.part.triangles.push(t);
    }

    fn fan(&mut self, from: &Part, ring: &[Corner]) {
        let mut at = [0_u32; 4];
        for (slot, &c) in at.iter_mut().zip(ring) {
            *slot = self.point(from, c);
        }
        for k in 1..ring.len().saturating_sub(1) {
            self.part.triangles.push([at[0], at[k], at[k + 1]]);
        }
    }
}

#[cfg(test)]
#[path = "tests/part.rs"]
mod tests;
