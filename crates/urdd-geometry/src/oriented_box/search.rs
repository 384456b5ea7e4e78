//! The search for the smallest box.
//!
//! Two faces of the smallest box that share an edge each lie along an edge of the hull (J. O'Rourke,
//! Finding Minimal Enclosing Boxes, International Journal of Computer and Information Sciences 14,
//! 1985). So one axis of it is a normal that turns about an edge of the hull, from the plane of one
//! of its triangles to that of the other: an *arc*; and with that axis the box is the one about the
//! shadow. What is left is a search along the arcs, one number each.
//!
//! The ends of arcs are the normals of faces. They come first, and are often the best; then the arcs,
//! by branch and bound. Of large hulls a small one made from some of the corners is tried first: its
//! boxes are never larger, so what is too large there needs no second look.

use nalgebra::Vector3;

use super::super::hull::ConvexHull;
use super::arc::{Arc, Known, Stretch};
use super::queue::{Looked, Queue};
use super::shadow::{Candidate, Caster, Edge};
use super::vectors::AXES;

/// A pass over the arcs.
struct Pass {
    /// How much of the greatest steepness a box's volume is expected to fall with.
    slope: f64,
    /// Shadows to cast: this many triangles in all, ...
    triangles: usize,
    /// ... but no fewer shadows than this.
    shadows: usize,
}

/// Hulls of links fall by less than a fifth of the greatest steepness; the first pass relies on that
/// and finds the smallest box nearly always. The second hardly relies on anything, while its budget
/// lasts: it is for hulls of few corners, which fall more steeply.
const PASSES: [Pass; 2] = [
    Pass {
        slope: 0.2,
        triangles: 600_000,
        shadows: 3000,
    },
    Pass {
        slope: 1.0,
        triangles: 100_000,
        shadows: 500,
    },
];

/// What is gained by less than this part of the volume is not worth looking for.
const GAIN: f64 = 1e-6;

/// Boxes that differ by less, as a part of their volume, count as equally small.
pub const TIE: f64 = 1e-6;

/// Hulls of fewer corners than this are not made coarser.
const COARSE_ABOVE: usize = 150;
/// Directions in which a coarse hull reaches as far as the hull.
const COARSE_DIRECTIONS: usize = 64;

/// Triangles that shadows of the hull itself may be cast of, in all. Hulls of links need some tens of millions. On a
/// round hull of many thousand triangles each promises as much as the next, and all would be tried.
const MOST_CAST: usize = 500_000_000;

/// Of how many times [`AXES`] stretches the coarse hull's boxes are worked out at once.
const AHEAD: usize = 4;

struct Search {
    fine: Caster,
    /// What is left of [`MOST_CAST`].
    left: usize,
    coarse: Option<Caster>,
    best: f64,
    /// Boxes that were within [`TIE`] of the best when they were found.
    found: Vec<Candidate>,
}

/// The boxes within [`TIE`] of the smallest that was found, of those that are not larger than `volume`, cubic metres.
/// Where that is infinite, empty only for a hull without area.
pub fn smallest_boxes(hull: &ConvexHull, volume: f64) -> Vec<Candidate> {
    let mut search = Search {
        fine: Caster::new(hull),
        left: MOST_CAST,
        coarse: coarse(hull),
        best: volume,
        found: Vec::new(),
    };
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        search.try_axis(&axis);
    }
    let at_faces = search.try_faces();
    search.walk_arcs(&at_faces);
    let limit = search.best * (1.0 + TIE);
    search.found.retain(|candidate| candidate.volume <= limit);
    search.found
}

/// A hull of some of the corners.
fn coarse(hull: &ConvexHull) -> Option<Caster> {
    let vertices = &hull.mesh().vertices;
    if vertices.len() <= COARSE_ABOVE {
        return None;
    }
    let farthest = |direction: Vector3<f64>| {
        let along = |p: &[f64; 3]| direction.dot(&Vector3::from(*p));
        let better = |a: &&[f64; 3], b: &&[f64; 3]| along(a).total_cmp(&along(b));
        vertices.iter().max_by(better).copied()
    };
    let corners: Vec<[f64; 3]> = spread(COARSE_DIRECTIONS).filter_map(farthest).collect();
    ConvexHull::new(&corners)
        .ok()
        .map(|hull| Caster::new(&hull))
}

/// Directions evenly over the sphere: points of a Fibonacci spiral.
fn spread(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vector3::new(radius * cos, radius * sin, z)
    })
}

impl Search {
    /// The smallest box with this axis, which counts if it is among the best.
    fn try_axis(&mut self, axis: &Vector3<f64>) -> Known {
        let candidate = self.fine.smallest_box(axis);
        self.take(candidate)
    }

    /// A box about the hull, which counts if it is among the best.
    fn take(&mut self, candidate: Option<Candidate>) -> Known {
        self.left = self.left.saturating_sub(self.fine.triangles());
        let Some(candidate) = candidate else {
            return Known::NOTHING;
        };
        if candidate.volume <= self.best * (1.0 + TIE) {
            self.best = self.best.min(candidate.volume);
            self.found.push(candidate);
        }
        Known::of(&candidate)
    }

    /// The boxes with these axes about the coarse hull or, where there is none, about the hull.
    fn sketches(&mut self, axes: &[Vector3<f64>]) -> Vec<Option<Candidate>> {
        let caster = self.coarse.as_mut().unwrap_or(&mut self.fine);
        let mut sketches = Vec::with_capacity(axes.len());
        for axes in axes.chunks(AXES) {
            sketches.extend(&caster.smallest_boxes(axes)[..axes.len()]);
        }
        sketches
    }

    /// Whether a box about the coarse hull leaves open whether that about the hull is among the best.
    fn is_open(&self, coarse: Option<&Candidate>) -> bool {
        self.left > 0 && coarse.is_none_or(|c| c.volume <= self.best)
    }

    /// What is known of the middle of a stretch.
    fn judge(&mut self, mut looked: Looked, queue: &mut Queue) -> Known {
        if self.coarse.is_none() {
            return self.take(looked.sketch);
        }
        match (looked.sketch, looked.fine) {
            (Some(coarse), _) if !self.is_open(Some(&coarse)) => return Known::of(&coarse),
            (_, None) => {
                // Others will be asked for soon; together they take less work.
                let open = |l: &&mut Looked| l.fine.is_none() && self.is_open(l.sketch.as_ref());
                let soon = queue.sketched().filter(open).take(AXES - 1);
                let mut open: Vec<&mut Looked> = std::iter::once(&mut looked).chain(soon).collect();
                let axes: Vec<Vector3<f64>> = open.iter().map(|l| l.axis).collect();
                let found = self.fine.smallest_boxes(&axes);
                for (looked, found) in open.iter_mut().zip(found) {
                    looked.fine = Some(found);
                }
            }
            _ => {}
        }
        self.take(looked.fine.flatten())
    }

    /// Tries each triangle's normal.
    fn try_faces(&mut self) -> Vec<Known> {
        let normals: Vec<_> = (0..self.fine.triangles())
            .map(|t| self.fine.normal(t))
            .collect();
        let sketches = self.sketches(&normals);
        if self.coarse.is_none() {
            return sketches.into_iter().map(|s| self.take(s)).collect();
        }
        let known = sketches
            .iter()
            .map(|s| s.as_ref().map_or(Known::NOTHING, Known::of));
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

    /// Branch and bound: halves the stretch of an arc that promises most, until none promises a
    /// better box than the best, or the pass has cast its shadows.
    fn walk_arcs(&mut self, at_faces: &[Known]) {
        let edges = &self.fine.edges;
        let arcs: Vec<Arc> = edges
            .iter()
            .map(|edge| Arc::new(&self.fine, edge))
            .collect();
        let whole = |(arc, edge): (usize, &Edge)| {
            let ends = [edge.left, edge.right].map(|t| at_faces[t as usize]);
            Stretch {
                promise: 0.0,
                arc,
                parts: [0.0, 1.0],
                ends,
            }
        };
        let mut stretches: Vec<Stretch> = edges.iter().enumerate().map(whole).collect();
        let triangles = self
            .coarse
            .as_ref()
            .unwrap_or(&self.fine)
            .triangles()
            .max(1);
        // Sketches of the coarse hull cost little beside what is then asked of the hull.
        let ahead = AXES * if self.coarse.is_some() { AHEAD } else { 1 };
        for pass in PASSES {
            let judged = |mut stretch: Stretch| {
                let [low, high] = stretch.parts;
                let length = arcs[stretch.arc].angle * (high - low);
                let [from, to] = stretch.ends;
                // Falling from both ends at most that steeply, volumes meet here.
                let fall = pass.slope * length * from.steepness.max(to.steepness);
                stretch.promise = 0.5 * (from.volume + to.volume - fall);
                stretch
            };
            let mut queue = Queue::new(stretches.drain(..).map(judged));
            for _ in 0..pass.shadows.max(pass.triangles / triangles) {
                let limit = self.best * (1.0 - GAIN);
                let axis = |stretch: &Stretch| arcs[stretch.arc].at(stretch.middle());
                let sketches = |axes: &[Vector3<f64>]| self.sketches(axes);
                let Some(looked) = queue.pop(limit, ahead, axis, sketches) else {
                    break;
                };
                let Stretch {
                    arc,
                    parts: [low, high],
                    ends: [from, to],
                    ..
                } = looked.stretch;
                let middle = looked.stretch.middle();
                let there = self.judge(looked, &mut queue);
                let halves = [
                    ([low, middle], [from, there]),
                    ([middle, high], [there, to]),
                ];
                queue.extend(halves.map(|(parts, ends)| {
                    judged(Stretch {
                        promise: 0.0,
                        arc,
                        parts,
                        ends,
                    })
                }));
            }
            stretches = queue.into_rest();
        }
    }
}
