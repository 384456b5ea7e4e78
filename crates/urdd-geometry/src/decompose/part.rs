//! Vectors, planes and parts of the proxy surface, and the tree of the planes that cut it.

pub(super) use crate::mesh::Bounds;
pub(super) use crate::vector::{cross, dot, norm, normal, sub};

/// The point at parameter `t` from `a` to `b`.
pub(super) fn lerp(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])]
}

pub(super) fn centroid([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0)
}

pub(super) fn distance_to_triangle(p: [f64; 3], triangle: [[f64; 3]; 3]) -> f64 {
    norm(sub(p, nearest_on_triangle(p, triangle)))
}

/// The point of a triangle that is nearest to `p` (Ericson, "Real-Time Collision Detection", 5.1.5).
pub(super) fn nearest_on_triangle(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return lerp(a, b, d1 / (d1 - d3));
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return lerp(a, c, d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return lerp(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    if sum > 0.0 {
        let (v, w) = (vb / sum, vc / sum);
        [0, 1, 2].map(|i| a[i] + ab[i] * v + ac[i] * w)
    } else {
        // A degenerate triangle that no edge case handled: its nearest corner bounds the distance.
        let near = |q: [f64; 3], r: [f64; 3]| {
            if norm(sub(p, r)) < norm(sub(p, q)) { r } else { q }
        };
        near(near(a, b), c)
    }
}

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

/// A node of the tree; the first of a list is the root. Leaf numbers are indices of the list of leaves.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    Leaf(usize),
    /// The child nodes below and above, as indices of the node list.
    Cut(Plane, [usize; 2]),
}

/// Makes the leaf at `node` a cut between two `leaves`, below and above; returns their nodes.
pub(super) fn divide(
    nodes: &mut Vec<Node>,
    node: usize,
    plane: Plane,
    leaves: [usize; 2],
) -> [usize; 2] {
    let sides = [nodes.len(), nodes.len() + 1];
    nodes[node] = Node::Cut(plane, sides);
    nodes.extend(leaves.map(Node::Leaf));
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_triangle_keeps_its_area() {
        let part = Part {
            points: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Part::default()
        };
        let [low, high] = part.split(&Plane { normal: [1.0, 0.0, 0.0], offset: 1.0 }, 1e-9, 0.0);
        let area =
            |p: &Part| -> f64 { p.triangles.iter().map(|t| normal(p.corners(*t))[2] / 2.0).sum() };
        assert_eq!((area(&low), area(&high)), (3.5, 4.5));
    }

    #[test]
    fn a_triangle_in_the_plane_goes_with_the_body_behind_it() {
        let part = Part {
            points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Part::default()
        };
        let plane = Plane { normal: [0.0, 0.0, 1.0], offset: 0.0 };
        assert_eq!(part.split(&plane, 1e-9, 0.0).map(|p| p.triangles.len()), [1, 0]);
        let turned = Part { triangles: vec![[0, 2, 1]], ..part };
        assert_eq!(turned.split(&plane, 1e-9, 0.0).map(|p| p.triangles.len()), [0, 1]);
    }
}
