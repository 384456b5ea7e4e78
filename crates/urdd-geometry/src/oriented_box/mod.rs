//! Minimum-volume oriented bounding boxes of convex hulls.
//!
//! Two adjacent faces of the smallest box each contain an edge of the hull (J. O'Rourke, Finding Minimal Enclosing
//! Boxes, International Journal of Computer and Information Sciences 14, 1985). So one box axis is a normal that
//! rotates about a hull edge, from the plane of one adjacent triangle to that of the other: an *arc*. Given this axis,
//! the box follows from the hull's projection along it (its *shadow*). What remains is a one-dimensional search along
//! each arc.
//!
//! The ends of arcs are face normals. They come first and are often the best. Then branch and bound searches the arcs.
//! For a large hull, a coarse hull of some of its corners is tried first. Its boxes are never larger, so a box that is
//! too large there is too large for the hull.

mod arc;
mod calipers;
mod shadow;

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use crate::hull::ConvexHull;
use crate::vector::{dot, spread};
use arc::{Arc, Known, Queue, Sketched, Stretch};
use shadow::{AXES, Candidate, Caster, Edge};

/// An oriented box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// The centre, metres.
    pub centre: [f64; 3],
    /// Half of each edge length, metres, along the box's own x, y and z.
    pub half_extents: [f64; 3],
    /// Rotation from the box's axes to the axes of `centre`. The scalar part is not negative.
    pub rotation: UnitQuaternion<f64>,
}

impl OrientedBox {
    /// The minimum-volume bounding box of a hull, or the minimum-area one if the hull is flat.
    ///
    /// A box has 24 right-handed labellings of its axes. This function picks the smallest rotation, 63 degrees at most,
    /// so roll, pitch and yaw are never near gimbal lock. Among boxes within 1e-6 of the least volume it also picks the
    /// smallest rotation, or the axis-aligned box if that is one of them.
    ///
    /// The search stops when no candidate promises a gain of more than 1e-6 of the volume, or when its budget is spent.
    /// Compared with a dense sampling of all arcs, boxes of robot links were at most 2e-6 too large. With half the
    /// budget, random needles 100 times as long as thick were up to 4e-4 too large.
    ///
    /// Every vertex of the hull is inside: its coordinates in the box, computed in doubles as `R^T (p - centre)`, do
    /// not exceed the half extents. Another order of operations may differ in the last digit.
    pub fn around(hull: &ConvexHull) -> Self {
        let aligned = Self::with_rotation(hull, UnitQuaternion::identity());
        let candidates = if hull.is_flat() {
            let mut caster = Caster::new(hull);
            let normal = caster.largest_normal;
            caster.smallest_box(&normal).into_iter().collect()
        } else {
            smallest_boxes(hull)
        };
        let least = candidates.iter().map(|c| c.volume).fold(f64::INFINITY, f64::min);
        if !hull.is_flat() && aligned.volume() <= least * (1.0 + TIE) {
            return aligned;
        }
        let turns_least = candidates
            .iter()
            .map(|candidate| nearest_to_identity(&candidate.axes))
            // The first of equals wins: the search order is fixed.
            .reduce(|best, other| if other.trace() > best.trace() { other } else { best });
        let Some(matrix) = turns_least else { return aligned };
        let rotation = Rotation3::from_matrix_unchecked(matrix);
        let found = Self::with_rotation(hull, canonical(&UnitQuaternion::from(rotation)));
        if hull.is_flat() && aligned.area() <= found.area() * (1.0 + TIE) {
            return aligned;
        }
        found
    }

    /// Whether a box of at most `volume`, cubic metres, encloses a non-flat hull.
    ///
    /// The search is that of [`Self::around`], but skips what cannot reach `volume`. That is much less work if `volume`
    /// is near the minimum.
    pub fn exists_within(hull: &ConvexHull, volume: f64) -> bool {
        let mut search = Search::new(hull, volume, true);
        search.run();
        !search.found.is_empty()
    }

    /// The smallest box of this orientation that encloses a hull.
    fn with_rotation(hull: &ConvexHull, rotation: UnitQuaternion<f64>) -> Self {
        let to_box = rotation.to_rotation_matrix().into_inner().transpose();
        let vertices = || hull.mesh().vertices.iter().map(|p| Vector3::from(*p));
        let first = vertices().next().unwrap_or_default();
        // Relative to a vertex, so that small shapes far from the origin keep their precision.
        let offsets = || vertices().map(|p| to_box * (p - first));
        let low = offsets().fold(Vector3::zeros(), |low: Vector3<f64>, p| low.inf(&p));
        let high = offsets().fold(Vector3::zeros(), |high: Vector3<f64>, p| high.sup(&p));
        let centre = first + to_box.transpose() * ((low + high) * 0.5);
        let reach = |half: Vector3<f64>, p: Vector3<f64>| half.sup(&(to_box * (p - centre)).abs());
        let half_extents = vertices().fold(Vector3::zeros(), reach);
        Self { centre: centre.map(|x| x + 0.0).into(), half_extents: half_extents.into(), rotation }
    }

    /// Volume, cubic metres.
    pub fn volume(&self) -> f64 {
        8.0 * self.half_extents.iter().product::<f64>()
    }

    /// Surface area, square metres.
    pub fn area(&self) -> f64 {
        let [x, y, z] = self.half_extents;
        8.0 * (x * y + y * z + z * x)
    }

    /// The eight corners, metres.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        let placed = |p: [f64; 3]| Vector3::from(self.centre) + self.rotation * Vector3::from(p);
        corners(self.half_extents).map(|corner| placed(corner).into())
    }
}

/// The eight corners of a box in its own frame, metres.
pub fn corners(half_extents: [f64; 3]) -> [[f64; 3]; 8] {
    let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
    std::array::from_fn(|corner| [0, 1, 2].map(|axis| sign(corner, axis) * half_extents[axis]))
}

/// The rotation by the smallest angle among the 24 right-handed labellings of three axes. It has the largest trace.
fn nearest_to_identity(axes: &[Vector3<f64>; 3]) -> Matrix3<f64> {
    let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let mut best = Matrix3::from_columns(axes);
    for order in orders {
        let [x, y, z] = order.map(|k| axes[k]);
        for (sign_x, sign_y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let (x, y) = (x * sign_x, y * sign_y);
            let z = z * x.cross(&y).dot(&z).signum();
            let matrix = Matrix3::from_columns(&[x, y, z]);
            if matrix.trace() > best.trace() {
                best = matrix;
            }
        }
    }
    best
}

/// The quaternion of a rotation with non-negative scalar part and without negative zeros.
fn canonical(rotation: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let q = rotation.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    UnitQuaternion::new_normalize(Quaternion::from(q.coords.map(|x| sign * x + 0.0)))
}

/// A pass over the arcs.
struct Pass {
    /// The expected slope of a box's volume, as a fraction of the maximum steepness.
    slope: f64,
    /// Budget of shadows: this many triangles in all, ...
    triangles: usize,
    /// ... but at least this many shadows.
    shadows: usize,
}

/// On hulls of robot links, volumes fall by less than a fifth of the maximum steepness. The first pass relies on that
/// and nearly always finds the smallest box. The second pass makes hardly any assumption, within its budget. It serves
/// hulls with few corners, whose volumes fall more steeply.
const PASSES: [Pass; 2] = [
    Pass { slope: 0.2, triangles: 600_000, shadows: 3000 },
    Pass { slope: 1.0, triangles: 100_000, shadows: 500 },
];

/// Minimum gain, as a fraction of the volume, that justifies more search.
const GAIN: f64 = 1e-6;

/// Boxes whose volumes differ by less than this fraction count as equal.
const TIE: f64 = 1e-6;

/// Hulls with at most this many corners get no coarse hull.
const COARSE_ABOVE: usize = 150;
/// Number of directions in which a coarse hull extends as far as the hull.
const COARSE_DIRECTIONS: usize = 64;

/// Maximum number of triangles projected for shadows of the hull itself. Hulls of robot links need some tens of
/// millions. On a round hull with many thousand triangles, all candidates are equally promising and all would be tried.
const MAX_CAST: usize = 500_000_000;

/// The number of batches of [`AXES`] stretches for which boxes of the coarse hull are computed at once.
const AHEAD: usize = 4;

struct Search {
    fine: Caster,
    /// The remaining part of [`MAX_CAST`].
    left: usize,
    coarse: Option<Caster>,
    best: f64,
    /// Whether one box is enough.
    any: bool,
    /// Boxes that were within [`TIE`] of the best when found.
    found: Vec<Candidate>,
}

/// The boxes within [`TIE`] of the smallest one found; none only if the hull has no area.
fn smallest_boxes(hull: &ConvexHull) -> Vec<Candidate> {
    let mut search = Search::new(hull, f64::INFINITY, false);
    search.run();
    let limit = search.best * (1.0 + TIE);
    search.found.retain(|candidate| candidate.volume <= limit);
    search.found
}

/// A hull of some of the corners; `None` for a small hull.
fn coarse(hull: &ConvexHull) -> Option<Caster> {
    let vertices = &hull.mesh().vertices;
    if vertices.len() <= COARSE_ABOVE {
        return None;
    }
    let farthest = |direction: [f64; 3]| {
        let along = |p: &[f64; 3]| dot(direction, *p);
        let better = |a: &&[f64; 3], b: &&[f64; 3]| along(a).total_cmp(&along(b));
        vertices.iter().max_by(better).copied()
    };
    let corners: Vec<[f64; 3]> = spread(COARSE_DIRECTIONS).filter_map(farthest).collect();
    ConvexHull::new(&corners).ok().map(|hull| Caster::new(&hull))
}

impl Search {
    fn new(hull: &ConvexHull, volume: f64, any: bool) -> Self {
        Search {
            fine: Caster::new(hull),
            left: MAX_CAST,
            coarse: coarse(hull),
            best: volume,
            any,
            found: Vec::new(),
        }
    }

    fn run(&mut self) {
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let candidate = self.fine.smallest_box(&axis);
            self.take(candidate);
        }
        if self.left == 0 {
            return;
        }
        let at_faces = self.try_faces();
        // Without a budget, the arcs of a large hull would take memory for nothing.
        if self.left > 0 {
            self.walk_arcs(&at_faces);
        }
    }

    /// Keeps a box of the hull if it is among the best.
    fn take(&mut self, candidate: Option<Candidate>) -> Known {
        self.left = self.left.saturating_sub(self.fine.normals.len());
        let Some(candidate) = candidate else { return Known::NOTHING };
        if candidate.volume <= self.best * (1.0 + TIE) {
            self.best = self.best.min(candidate.volume);
            self.found.push(candidate);
            if self.any {
                self.left = 0;
            }
        }
        Known::of(&candidate)
    }

    /// The boxes with these axes, for the coarse hull if there is one, otherwise for the hull.
    fn sketches(&mut self, axes: &[Vector3<f64>]) -> Vec<Option<Candidate>> {
        let caster = self.coarse.as_mut().unwrap_or(&mut self.fine);
        let mut sketches = Vec::with_capacity(axes.len());
        for axes in axes.chunks(AXES) {
            sketches.extend(&caster.smallest_boxes(axes)[..axes.len()]);
        }
        sketches
    }

    /// Whether the hull's box can be among the best, given the box of the coarse hull.
    fn is_open(&self, coarse: Option<&Candidate>) -> bool {
        self.left > 0 && coarse.is_none_or(|c| c.volume <= self.best)
    }

    fn judge(&mut self, mut item: Sketched, queue: &mut Queue) -> Known {
        if self.coarse.is_none() {
            return self.take(item.sketch);
        }
        match (item.sketch, item.fine) {
            (Some(coarse), _) if !self.is_open(Some(&coarse)) => return Known::of(&coarse),
            (_, None) => {
                // Other stretches will need their boxes soon; a batch takes less work.
                let open = |l: &&mut Sketched| l.fine.is_none() && self.is_open(l.sketch.as_ref());
                let soon = queue.sketched().filter(open).take(AXES - 1);
                let mut open: Vec<&mut Sketched> = std::iter::once(&mut item).chain(soon).collect();
                let axes: Vec<Vector3<f64>> = open.iter().map(|l| l.axis).collect();
                let found = self.fine.smallest_boxes(&axes);
                for (item, found) in open.iter_mut().zip(found) {
                    item.fine = Some(found);
                }
            }
            _ => {}
        }
        self.take(item.fine.flatten())
    }

    fn try_faces(&mut self) -> Vec<Known> {
        let normals = self.fine.normals.clone();
        let sketches = self.sketches(&normals);
        if self.coarse.is_none() {
            return sketches.into_iter().map(|s| self.take(s)).collect();
        }
        let known = sketches.iter().map(|s| s.as_ref().map_or(Known::NOTHING, Known::of));
        let mut known: Vec<Known> = known.collect();
        let mut order: Vec<usize> = (0..normals.len()).collect();
        order.sort_by(|s, t| known[*s].volume.total_cmp(&known[*t].volume));
        'all: for several in order.chunks(AXES) {
            let open = several.iter().filter(|t| known[**t].volume <= self.best);
            let axes: Vec<Vector3<f64>> = open.map(|t| normals[*t]).collect();
            if axes.is_empty() {
                break;
            }
            let found = self.fine.smallest_boxes(&axes);
            for (&t, found) in several.iter().zip(found) {
                if known[t].volume > self.best || self.left == 0 {
                    break 'all;
                }
                known[t] = self.take(found);
            }
        }
        known
    }

    /// Branch and bound: repeatedly halves the most promising stretch. Ends when no stretch promises a better box, or
    /// when the budget of the pass is spent.
    fn walk_arcs(&mut self, at_faces: &[Known]) {
        let edges = &self.fine.edges;
        let arcs: Vec<Arc> = edges.iter().map(|edge| Arc::new(&self.fine, edge)).collect();
        let whole = |(arc, edge): (usize, &Edge)| {
            let ends = [edge.left, edge.right].map(|t| at_faces[t as usize]);
            Stretch { promise: 0.0, arc, parts: [0.0, 1.0], ends }
        };
        let mut stretches: Vec<Stretch> = edges.iter().enumerate().map(whole).collect();
        let triangles = self.coarse.as_ref().unwrap_or(&self.fine).normals.len().max(1);
        // Sketches of the coarse hull are cheap compared with the boxes of the hull.
        let ahead = AXES * if self.coarse.is_some() { AHEAD } else { 1 };
        for pass in PASSES {
            let judged = |mut stretch: Stretch| {
                let [low, high] = stretch.parts;
                let length = arcs[stretch.arc].angle * (high - low);
                let [from, to] = stretch.ends;
                // Lower bound: lines that fall from both ends with this slope meet at this volume.
                let fall = pass.slope * length * from.steepness.max(to.steepness);
                stretch.promise = 0.5 * (from.volume + to.volume - fall);
                stretch
            };
            let mut queue = Queue::new(stretches.drain(..).map(judged));
            for _ in 0..pass.shadows.max(pass.triangles / triangles) {
                if self.left == 0 {
                    return;
                }
                let limit = self.best * (1.0 - GAIN);
                let axis = |stretch: &Stretch| arcs[stretch.arc].at(stretch.middle());
                let sketches = |axes: &[Vector3<f64>]| self.sketches(axes);
                let Some(item) = queue.pop(limit, ahead, axis, sketches) else { break };
                let Stretch { arc, parts: [low, high], ends: [from, to], .. } = item.stretch;
                let middle = item.stretch.middle();
                let there = self.judge(item, &mut queue);
                let halves = [([low, middle], [from, there]), ([middle, high], [there, to])];
                queue.extend(
                    halves.map(|(parts, ends)| judged(Stretch { promise: 0.0, arc, parts, ends })),
                );
            }
            stretches = queue.into_rest();
        }
    }
}
