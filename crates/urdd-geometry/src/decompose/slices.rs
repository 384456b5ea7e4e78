//! Slices of a part between parallel planes, and hulls that grow slice by slice.

use super::grower::{Grower, Places};
use super::part::Part;
use super::support::{Candidate, support};
use super::vector::{Bounds, dot, lerp};

/// The support points of a part's slices between parallel planes, and of the sections in these planes.
pub(super) struct Slices {
    slices: Vec<Vec<[f64; 3]>>,
    sections: Vec<Vec<[f64; 3]>>,
}

impl Slices {
    /// Slices across z of the coordinates `turned`, which are those in `frame`; planes ascending.
    pub fn new(
        part: &Part,
        turned: &[[f64; 3]],
        frame: &[[f64; 3]; 3],
        planes: &[f64],
        places: &Places,
    ) -> Self {
        let eps = places.eps;
        let bounds = Bounds::of(turned.iter().copied());
        // Odd code 2k+1: inside slice k. Even code 2k: in plane k-1, between slices k-1 and k.
        let code: Vec<u8> = turned
            .iter()
            .map(|[_, _, x]| {
                let k = planes.partition_point(|&o| o < x - eps);
                let on = k < planes.len() && planes[k] <= x + eps;
                (2 * k + 1 + usize::from(on)) as u8
            })
            .collect();
        let mut sections = vec![Vec::new(); planes.len()];
        let mut cut_points: Vec<[f64; 3]> = Vec::new();
        let flat = Scaling::new(&bounds, 0.0, f64::INFINITY);
        let edge = |k: usize| planes.get(k).copied().unwrap_or(bounds.max[2]);
        let cubes: Vec<Scaling> = (0..=planes.len())
            .map(|k| {
                let from = if k == 0 { bounds.min[2] } else { edge(k - 1) };
                Scaling::new(&bounds, from, edge(k))
            })
            .collect();
        let mut mask = vec![0_u32; part.points.len()];
        for &t in &part.triangles {
            let c = t.map(|i| code[i as usize]);
            let (least, most) = (c[0].min(c[1]).min(c[2]), c[0].max(c[1]).max(c[2]));
            if least == most && least % 2 == 0 {
                // In a plane: goes with the body behind it.
                let bit = 1 << (least / 2 - u8::from(part.faces(t, frame[2])));
                t.iter().for_each(|&i| mask[i as usize] |= bit);
                continue;
            }
            // The first and last slice that the triangle reaches into.
            let (first, last) = (least / 2, (most - 1) / 2);
            for k in 0..3 {
                let v = c[k];
                let bits = if v % 2 == 1 {
                    1 << (v / 2)
                } else {
                    (u32::from(v / 2 > first) << (v / 2 - 1))
                        | (u32::from(v / 2 <= last) << (v / 2))
                };
                mask[t[k] as usize] |= bits;
                if first == last {
                    continue;
                }
                let (i, j) = (t[k] as usize, t[(k + 1) % 3] as usize);
                let (from, to) = (v.min(c[(k + 1) % 3]), v.max(c[(k + 1) % 3]));
                for b in from / 2..(to - 1) / 2 {
                    let (p, q) = (turned[i], turned[j]);
                    let p = lerp(p, q, (planes[b as usize] - p[2]) / (q[2] - p[2]));
                    let index = cut_points.len() as u32;
                    sections[b as usize].push(Candidate::new(flat.apply(p), index));
                    cut_points.push(p);
                }
            }
        }
        let loose =
            part.triangles.iter().filter(|t| Part::is_loose(**t)).map(|t| turned[t[0] as usize]);
        for p in loose.chain(part.inner.iter().map(|&p| frame.map(|axis| dot(axis, p)))) {
            let first = planes.partition_point(|&o| o < p[2] - places.reach);
            for (b, &offset) in planes.iter().enumerate().skip(first) {
                if offset > p[2] + places.reach {
                    break;
                }
                let p = [p[0], p[1], offset];
                sections[b].push(Candidate::new(flat.apply(p), cut_points.len() as u32));
                cut_points.push(p);
            }
        }
        let mut slices = vec![Vec::new(); planes.len() + 1];
        for (i, &m) in mask.iter().enumerate() {
            let mut m = m;
            while m != 0 {
                let k = m.trailing_zeros() as usize;
                slices[k].push(Candidate::new(cubes[k].apply(turned[i]), i as u32));
                m &= m - 1;
            }
        }
        Slices {
            slices: slices.iter().map(|c| farthest(c, turned)).collect(),
            sections: sections.iter().map(|c| farthest(c, &cut_points)).collect(),
        }
    }

    /// Grows a hull over the slices, upwards or downwards. Returns the cost at each plane in that order (zero while the
    /// hull is empty), and the whole hull. `cost` evaluates a hull that ends at the plane with the given index.
    pub fn sweep(
        &self,
        upwards: bool,
        extent: f64,
        cost: impl Fn(&mut Grower, usize) -> f64,
    ) -> (Vec<f64>, Grower) {
        let planes = self.sections.len();
        let mut hull = Grower::new(extent);
        let mut costs = Vec::with_capacity(planes);
        for n in 0..planes {
            let (slice, section) = if upwards { (n, n) } else { (planes - n, planes - 1 - n) };
            hull.add(&self.slices[slice]);
            // A section counts only if the hull is not empty.
            if hull.hull.points.is_empty() {
                costs.push(0.0);
            } else {
                hull.add(&self.sections[section]);
                costs.push(cost(&mut hull, section));
            }
        }
        // Downwards, nobody asks for the whole hull.
        if upwards {
            hull.add(&self.slices[planes]);
        }
        (costs, hull)
    }
}

/// The support points of candidates, whose indices refer to `points`.
fn farthest(candidates: &[Candidate], points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    support(candidates).into_iter().map(|i| points[i as usize]).collect()
}

/// Scaling of a slice to a cube.
struct Scaling {
    centre: [f64; 3],
    factor: [f64; 3],
}

impl Scaling {
    fn new(bounds: &Bounds, from: f64, to: f64) -> Self {
        let (mut low, mut high) = (bounds.min, bounds.max);
        (low[2], high[2]) = (from, to);
        let factor =
            [0, 1, 2].map(|a| if high[a] > low[a] { 2.0 / (high[a] - low[a]) } else { 0.0 });
        let centre =
            [0, 1, 2].map(|a| if factor[a] > 0.0 { (low[a] + high[a]) / 2.0 } else { 0.0 });
        Scaling { centre, factor }
    }

    #[inline]
    fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|a| (p[a] - self.centre[a]) * self.factor[a])
    }
}
