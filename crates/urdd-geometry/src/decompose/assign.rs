//! Assigns the whole surface to the groups that the search found.
//!
//! Every triangle descends the tree of cuts. A triangle that crosses a plane is clipped there (Sutherland and Hodgman,
//! "Reentrant polygon clipping", 1974) and both parts continue. So the parts of the groups make up the surface exactly,
//! up to the rounding of the new points.

use super::part::{Node, Plane, dot, lerp};
use super::surface::Surface;
use crate::hull::ConvexHull;

/// A polygon corner during the descent.
#[derive(Clone, Copy)]
struct Corner {
    unit: [f64; 3],
    at: [f64; 3],
    /// The vertex index, or `NEW` for a point on a cut.
    vertex: u32,
}

const NEW: u32 = u32::MAX;

/// The points of a group, metres.
pub(super) struct Hand {
    /// Points of the surface, then points inside.
    pub points: Vec<[f64; 3]>,
    /// Whether any is of the surface.
    pub has_surface: bool,
}

/// The points of each group. New points on cuts are rounded to f32, the precision of written meshes.
pub(super) fn assign(
    surface: &Surface,
    inside: &Inside,
    nodes: &[Node],
    group_of_leaf: &[usize],
    groups: usize,
    eps: f64,
) -> Vec<Hand> {
    let mut out = Hands {
        points: vec![Vec::new(); groups],
        most: vec![MAX_POINTS; groups],
        last: vec![u32::MAX; surface.vertices.len()],
        nodes,
        group_of_leaf,
        eps,
    };
    for &t in &surface.triangles {
        let corners = t.map(|i| Corner {
            unit: surface.unit[i as usize],
            at: surface.vertices[i as usize],
            vertex: i,
        });
        out.descend(0, &corners, &|direction| dot(surface.normal(t), direction) > 0.0);
    }
    let has_surface: Vec<bool> = out.points.iter().map(|points| !points.is_empty()).collect();
    for &p in inside.points {
        out.drop_in(0, p, inside, surface);
    }
    let hand = |(points, has_surface)| Hand { points, has_surface };
    out.points.into_iter().zip(has_surface).map(hand).collect()
}

/// Points inside the body, in unit coordinates.
pub(super) struct Inside<'a> {
    points: &'a [[f64; 3]],
    /// Maximum distance from a cut at which a point is also projected into it.
    reach: f64,
    /// Planes of the body's hull.
    planes: Vec<Plane>,
}

impl<'a> Inside<'a> {
    /// `body` are points of the surface whose hull is inside the body's hull or equal to it.
    pub fn new(points: &'a [[f64; 3]], reach: f64, body: &[[f64; 3]]) -> Inside<'a> {
        let hull = if points.is_empty() { None } else { ConvexHull::new(body).ok() };
        let mesh = hull.map(ConvexHull::into_mesh).unwrap_or_default();
        let planes = mesh.triangles.iter().map(|t| Plane::of(mesh.corners(*t))).collect();
        Inside { points, reach, planes }
    }

    fn hull_holds(&self, p: [f64; 3]) -> bool {
        self.planes.iter().all(|plane| plane.height(p) <= 0.0)
    }
}

/// Number of points of a group at which they are first thinned out.
const MAX_POINTS: usize = 1 << 21;

struct Hands<'a> {
    points: Vec<Vec<[f64; 3]>>,
    /// For each group, the number of points at which it is thinned out next.
    most: Vec<usize>,
    /// The group that each vertex was last assigned to: most vertices belong to one group only.
    last: Vec<u32>,
    nodes: &'a [Node],
    group_of_leaf: &'a [usize],
    eps: f64,
}

impl Hands<'_> {
    fn descend(&mut self, mut node: usize, polygon: &[Corner], faces: &dyn Fn([f64; 3]) -> bool) {
        loop {
            match self.nodes[node] {
                Node::Leaf(leaf) => return self.give(self.group_of_leaf[leaf], polygon),
                Node::Cut(plane, sides) => {
                    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
                    for c in polygon {
                        let h = plane.height(c.unit);
                        low = low.min(h);
                        high = high.max(h);
                    }
                    let side = if low >= -self.eps && high <= self.eps {
                        usize::from(!faces(plane.normal))
                    } else if low >= -self.eps {
                        1
                    } else if high <= self.eps {
                        0
                    } else {
                        let halves = clip(polygon, &plane, self.eps);
                        self.descend(sides[0], &halves[0], faces);
                        self.descend(sides[1], &halves[1], faces);
                        return;
                    };
                    node = sides[side];
                }
            }
        }
    }

    /// Descends with a point inside, in unit coordinates. A point near a plane is also projected into it, for both
    /// sides. A point outside the body's hull at the leaf is dropped: each move is short, but they add up.
    fn drop_in(&mut self, node: usize, p: [f64; 3], inside: &Inside, surface: &Surface) {
        match self.nodes[node] {
            Node::Leaf(leaf) => {
                if inside.hull_holds(p) {
                    let at = [0, 1, 2].map(|a| p[a] * surface.scale + surface.centre[a]);
                    self.points[self.group_of_leaf[leaf]].push(at.map(|x| f64::from(x as f32)));
                }
            }
            Node::Cut(plane, sides) => {
                let height = plane.height(p);
                if height.abs() <= inside.reach {
                    let q = plane.project(p);
                    self.drop_in(sides[0], q, inside, surface);
                    self.drop_in(sides[1], q, inside, surface);
                }
                self.drop_in(sides[usize::from(height > 0.0)], p, inside, surface);
            }
        }
    }

    fn give(&mut self, group: usize, polygon: &[Corner]) {
        for c in polygon {
            if c.vertex != NEW {
                let last = &mut self.last[c.vertex as usize];
                if *last == group as u32 {
                    continue;
                }
                *last = group as u32;
            }
            self.points[group].push(c.at);
        }
        if self.points[group].len() >= self.most[group] {
            self.thin_out(group);
        }
    }

    /// Keeps only the corners of a group's hull. In a tangled mesh, each triangle leaves points in every group, which
    /// together would take many times the memory of the mesh.
    fn thin_out(&mut self, group: usize) {
        if let Ok(hull) = ConvexHull::new(&self.points[group]) {
            self.points[group] = hull.into_mesh().vertices;
        }
        self.most[group] = MAX_POINTS.max(2 * self.points[group].len());
    }
}

/// The parts of a convex polygon below and above a plane.
fn clip(polygon: &[Corner], plane: &Plane, eps: f64) -> [Vec<Corner>; 2] {
    let mut out = [Vec::with_capacity(polygon.len() + 1), Vec::with_capacity(polygon.len() + 1)];
    for (k, c) in polygon.iter().enumerate() {
        let d = &polygon[(k + 1) % polygon.len()];
        let (hc, hd) = (plane.height(c.unit), plane.height(d.unit));
        if hc <= eps {
            out[0].push(*c);
        }
        if hc >= -eps {
            out[1].push(*c);
        }
        if (hc < -eps && hd > eps) || (hc > eps && hd < -eps) {
            // Always from the lower end, so that two triangles with this edge get the same point.
            let (from, to, hf, ht) = if hc < hd { (c, d, hc, hd) } else { (d, c, hd, hc) };
            let t = hf / (hf - ht);
            let cut = Corner {
                unit: lerp(from.unit, to.unit, t),
                at: lerp(from.at, to.at, t).map(|x| f64::from(x as f32)),
                vertex: NEW,
            };
            out[0].push(cut);
            out[1].push(cut);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::cuboid;

    #[test]
    fn a_point_that_two_cuts_move_out_of_the_body_is_dropped() {
        let surface = Surface::new(&cuboid([2.0, 2.0, 2.0])).expect("a surface");
        // Two planes through the edge x = y = 1.02, just outside; a point near it is projected into both.
        let plane = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            Plane { normal: [sin, -cos, 0.0], offset: 1.02 * (sin - cos) }
        };
        let nodes = [
            Node::Cut(plane(44.0), [1, 2]),
            Node::Cut(plane(134.0), [3, 4]),
            Node::Cut(plane(134.0), [5, 6]),
            Node::Leaf(0),
            Node::Leaf(1),
            Node::Leaf(2),
            Node::Leaf(3),
        ];
        let point = [[0.95, 0.95, 0.0]];
        let given = |reach: f64| {
            let inside = Inside::new(&point, reach, &surface.unit);
            let parts = assign(&surface, &inside, &nodes, &[0, 1, 2, 3], 4, 1e-9);
            parts.into_iter().flat_map(|hand| hand.points).collect::<Vec<_>>()
        };
        let out = |p: &[f64; 3]| p.iter().any(|x| x.abs() > 1.0 + 1e-6);
        assert!(!given(0.11).iter().any(out), "{:?}", given(0.11));
        // Only the projection into the first plane remains.
        assert!(given(0.11).len() > given(0.0).len());
    }
}
