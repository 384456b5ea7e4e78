//! Quickhull with exact predicates: start from a tetrahedron and add the farthest point outside a face until no point
//! is outside.
//!
//! The orientation tests are Shewchuk's adaptive predicates from the `robust` crate (J. R. Shewchuk, Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete & Computational Geometry 18, 1997). They are exact
//! while no product of three coordinate differences overflows or loses bits to underflow. [`in_range`] ensures this.

use std::cmp::Ordering;

use nalgebra::Vector3;
use robust::{Coord, Coord3D};

use crate::mesh::Bounds;

/// Why a set of points has no hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// There are no points.
    #[error("there are no points")]
    Empty,
    /// A coordinate is NaN, infinite, or outside the range of exact arithmetic.
    #[error(
        "point {point} has a coordinate that is neither 0 nor between 1e-60 and 1e60 m in size"
    )]
    OutOfRange {
        /// Index of the point.
        point: usize,
    },
    /// All points coincide.
    #[error("all points coincide")]
    Point,
    /// All points are collinear.
    #[error("all points lie on one line")]
    Line,
    /// More points than a 32-bit index can address.
    #[error("more than 4,294,967,294 points")]
    TooMany,
}

/// The initial simplex, as point indices.
pub enum Start {
    /// Four points that are not coplanar.
    Tetrahedron([u32; 4]),
    /// All points are coplanar; these three are not collinear.
    Plane([u32; 3]),
}

/// A triangle of the hull.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Point indices, counterclockwise from outside.
    pub corners: [u32; 3],
    /// Neighbour k is the triangle across the edge from corner k to corner k + 1.
    pub neighbours: [u32; 3],
}

/// A triangle of the growing hull, with the points assigned to it.
struct Face {
    triangle: Triangle,
    normal: Vector3<f64>,
    /// Error bound: a computed height below this may have the wrong sign.
    doubt: f64,
    outside: Vec<u32>,
    /// The farthest point of `outside`, and its height.
    farthest: Option<(u32, f64)>,
    removed: bool,
    visited_for: u32,
}

/// Four points that are far apart. They are chosen by value, so neither order nor duplicates matter.
pub fn start(points: &[Point]) -> Result<Start, HullError> {
    let indices = 0..points.len() as u32;
    let at = |i: u32| points[i as usize];
    let by_value = |i: &u32, j: &u32| lexicographic(&at(*i), &at(*j));
    let a = indices.clone().min_by(by_value).ok_or(HullError::Empty)?;
    let b = indices.clone().max_by(by_value).ok_or(HullError::Empty)?;
    if at(a) == at(b) {
        return Err(HullError::Point);
    }
    let vector = |i: u32| Vector3::from(at(i)) - Vector3::from(at(a));
    // The farthest point as computed in doubles. If rounding hid it, any point that is exactly off the line or plane.
    let far = |measure: &dyn Fn(u32) -> f64, is_off: &dyn Fn(&u32) -> bool| {
        let farther =
            |(x, i): &(f64, u32), (y, j): &(f64, u32)| x.total_cmp(y).then_with(|| by_value(i, j));
        let (_, farthest) = indices.clone().map(|i| (measure(i), i)).max_by(farther)?;
        let any = || indices.clone().filter(is_off).min_by(by_value);
        Some(farthest).filter(is_off).or_else(any)
    };
    let axis = vector(b);
    let off_line = |i: &u32| !collinear(at(a), at(b), at(*i));
    let c = far(&|i| axis.cross(&vector(i)).norm_squared(), &off_line).ok_or(HullError::Line)?;
    let normal = axis.cross(&vector(c));
    let off_plane = |i: &u32| side_of_plane(at(a), at(b), at(c), at(*i)).is_ne();
    let d = far(&|i| normal.dot(&vector(i)).abs(), &off_plane);
    Ok(match d {
        None => Start::Plane([a, b, c]),
        // The fourth point must be below the first three.
        Some(d) if side_of_plane(at(a), at(b), at(c), at(d)) == Ordering::Less => {
            Start::Tetrahedron([a, b, c, d])
        }
        Some(d) => Start::Tetrahedron([a, c, b, d]),
    })
}

/// The hull of points, from four of them. Some corners may still be on an edge or in a face.
pub fn grow(points: &[Point], corners: [u32; 4]) -> Growing {
    let mut hull = Growing::new(points);
    let [a, b, c, d] = corners;
    for (corners, neighbours) in [
        ([a, b, c], [1, 2, 3]),
        ([b, a, d], [0, 3, 2]),
        ([c, b, d], [0, 1, 3]),
        ([a, c, d], [0, 2, 1]),
    ] {
        hull.add_face(corners, neighbours);
    }
    let everything: Vec<u32> = (0..points.len() as u32).collect();
    hull.assign(&everything, &[0, 1, 2, 3]);
    // Depth first, so that what comes next is near and in the processor's cache.
    let mut open = vec![0, 1, 2, 3];
    let mut new = Vec::new();
    while let Some(face) = open.pop() {
        // The slot of a removed face may be that of a newer one by now, which is in the list again.
        if let Some((apex, _)) = hull.faces[face as usize].farthest {
            hull.take_in(apex, face, &mut new);
            let has_points = |f: &u32| hull.faces[*f as usize].farthest.is_some();
            open.extend(new.iter().copied().filter(has_points));
        }
    }
    hull
}

/// A hull that takes in points.
pub struct Growing {
    points: Vec<Point>,
    /// The axis-aligned box of all points, larger by what rounding moves them.
    bounds: Bounds,
    extent: Vector3<f64>,
    faces: Vec<Face>,
    /// Slots of removed faces, to be used again.
    free: Vec<u32>,
    /// For each point on the horizon, the new face whose edge starts there.
    face_from: Vec<u32>,
    /// The faces that are visible from the point being added.
    visible: Vec<u32>,
    /// Their outline: the edge (from, to), the face behind it and the face beyond.
    horizon: Vec<[u32; 4]>,
    spare_lists: Vec<Vec<u32>>,
}

impl Growing {
    fn new(points: &[Point]) -> Self {
        let Bounds { min, max } = Bounds::of(points.iter().copied());
        let more = [0, 1, 2].map(|k| 1e-9 * (max[k] - min[k]));
        let min = [0, 1, 2].map(|k| min[k] - more[k]);
        let bounds = Bounds { min, max: [0, 1, 2].map(|k| max[k] + more[k]) };
        Self {
            points: points.to_vec(),
            extent: bounds.size().into(),
            bounds,
            faces: Vec::new(),
            free: Vec::new(),
            face_from: vec![u32::MAX; points.len()],
            visible: Vec::new(),
            horizon: Vec::new(),
            spare_lists: Vec::new(),
        }
    }

    fn add_face(&mut self, corners: [u32; 3], neighbours: [u32; 3]) -> u32 {
        let [anchor, b, c] = corners.map(|i| Vector3::from(self.points[i as usize]));
        let (u, v) = (b - anchor, c - anchor);
        let size = Vector3::new(
            (u.y * v.z).abs() + (u.z * v.y).abs(),
            (u.z * v.x).abs() + (u.x * v.z).abs(),
            (u.x * v.y).abs() + (u.y * v.x).abs(),
        );
        let face = Face {
            triangle: Triangle { corners, neighbours },
            normal: u.cross(&v),
            // Shewchuk's bound for this expression is (7 + 56e)e times the sum of the absolute values of its six
            // products, with e = 2^-53. That sum is at most size . extent. The factor is more than twice the bound.
            doubt: 8.0 * f64::EPSILON * size.dot(&self.extent),
            outside: Vec::new(),
            farthest: None,
            removed: false,
            visited_for: u32::MAX,
        };
        match self.free.pop() {
            Some(slot) => {
                self.faces[slot as usize] = face;
                slot
            }
            None => {
                self.faces.push(face);
                self.faces.len() as u32 - 1
            }
        }
    }

    /// The height of a point over a face, times twice the face's area; `None` unless the point is outside.
    #[inline]
    fn height_outside(&self, face: &Face, point: u32) -> Option<f64> {
        let p = self.points[point as usize];
        let anchor = self.points[face.triangle.corners[0] as usize];
        let height = face.normal.dot(&(Vector3::from(p) - Vector3::from(anchor)));
        if height > face.doubt {
            Some(height)
        } else if height < -face.doubt {
            None
        } else {
            let [a, b, c] = face.triangle.corners.map(|i| self.points[i as usize]);
            (side_of_plane(a, b, c, p) == Ordering::Greater).then_some(height)
        }
    }

    /// Assigns each point to the first of these faces that it is outside of. A point that is not outside any of them is
    /// inside the hull and never considered again.
    fn assign(&mut self, candidates: &[u32], faces: &[u32]) {
        for &point in candidates {
            let found = faces
                .iter()
                .find_map(|f| Some((*f, self.height_outside(&self.faces[*f as usize], point)?)));
            let Some((f, height)) = found else { continue };
            let points = &self.points;
            let face = &mut self.faces[f as usize];
            if face.outside.is_empty() {
                face.outside = self.spare_lists.pop().unwrap_or_default();
            }
            face.outside.push(point);
            let farther = face.farthest.is_none_or(|(other, h)| {
                let value = |i: u32| &points[i as usize];
                height > h || (height == h && lexicographic(value(point), value(other)).is_gt())
            });
            if farther {
                face.farthest = Some((point, height));
            }
        }
    }

    /// Adds a point outside `seen_from`: a cone replaces the faces visible from the point. `new` is set to its faces.
    fn take_in(&mut self, apex: u32, seen_from: u32, new: &mut Vec<u32>) {
        self.find_horizon(apex, seen_from);
        new.clear();
        for k in 0..self.horizon.len() {
            let [from, to, behind, beyond] = self.horizon[k];
            let face = self.add_face([from, to, apex], [beyond, u32::MAX, u32::MAX]);
            self.face_from[from as usize] = face;
            let links = &mut self.faces[beyond as usize].triangle;
            // Only in a flat hull can two triangles be neighbours twice.
            if let Some(k) = links.neighbours.iter().position(|n| *n == behind) {
                links.neighbours[k] = face;
            }
            new.push(face);
        }
        for &face in &*new {
            let to = self.faces[face as usize].triangle.corners[1];
            let following = self.face_from[to as usize];
            self.faces[face as usize].triangle.neighbours[1] = following;
            self.faces[following as usize].triangle.neighbours[2] = face;
        }
        for k in 0..self.visible.len() {
            let removed = &mut self.faces[self.visible[k] as usize];
            removed.farthest = None;
            let mut list = std::mem::take(&mut removed.outside);
            // Drop the apex and its duplicates at once: they are coplanar with all new faces.
            list.retain(|p| self.points[*p as usize] != self.points[apex as usize]);
            self.assign(&list, new);
            if list.capacity() > 0 {
                list.clear();
                self.spare_lists.push(list);
            }
        }
        // Only now, as the horizon tells faces by their slots.
        self.free.append(&mut self.visible);
    }

    /// Finds the faces that are visible from a point, and the horizon.
    fn find_horizon(&mut self, apex: u32, seen_from: u32) {
        self.horizon.clear();
        self.visible.push(seen_from);
        self.faces[seen_from as usize].removed = true;
        let mut next = 0;
        while let Some(&f) = self.visible.get(next) {
            next += 1;
            let Triangle { corners, neighbours } = self.faces[f as usize].triangle;
            for k in 0..3 {
                let g = neighbours[k];
                let neighbour = &self.faces[g as usize];
                if neighbour.removed {
                    continue;
                }
                if neighbour.visited_for != apex && self.height_outside(neighbour, apex).is_some() {
                    self.faces[g as usize].removed = true;
                    self.visible.push(g);
                } else {
                    self.faces[g as usize].visited_for = apex;
                    self.horizon.push([corners[k], corners[(k + 1) % 3], f, g]);
                }
            }
        }
    }

    /// Whether a point is in the box of those that are known: [`Growing::insert`] takes no other.
    pub fn holds(&self, point: Point) -> bool {
        let Bounds { min, max } = self.bounds;
        (0..3).all(|k| min[k] <= point[k] && point[k] <= max[k])
    }

    /// Takes in a point that is outside the triangle of a slot. `changed` is set to the slots that have other triangles
    /// then, or none. Returns whether the point is outside.
    pub fn insert(&mut self, point: Point, seen_from: u32, changed: &mut Vec<u32>) -> bool {
        let apex = self.points.len() as u32;
        self.points.push(point);
        self.face_from.push(u32::MAX);
        let is_outside = self.height_outside(&self.faces[seen_from as usize], apex).is_some();
        changed.clear();
        if is_outside {
            let known = self.free.len();
            self.take_in(apex, seen_from, changed);
            changed.extend_from_slice(&self.free[known.saturating_sub(changed.len())..]);
        }
        is_outside
    }

    /// The corners of the triangle of each slot; `None` for a slot without one.
    pub fn triangle(&self, slot: u32) -> Option<[u32; 3]> {
        let face = self.faces.get(slot as usize).filter(|face| !face.removed);
        face.map(|face| face.triangle.corners)
    }

    pub fn num_slots(&self) -> u32 {
        self.faces.len() as u32
    }

    pub fn into_triangles(self) -> Vec<Triangle> {
        // The number of remaining faces before each.
        let counts = self.faces.iter().scan(0, |count, face| {
            *count += u32::from(!face.removed);
            Some(*count - u32::from(!face.removed))
        });
        let number: Vec<u32> = counts.collect();
        let remaining = self.faces.into_iter().filter(|face| !face.removed);
        remaining
            .map(|Face { triangle: Triangle { corners, neighbours }, .. }| Triangle {
                corners,
                neighbours: neighbours.map(|n| number[n as usize]),
            })
            .collect()
    }
}

/// A point, metres.
pub type Point = [f64; 3];

/// Whether the predicates are exact for this coordinate: 0, or a magnitude of 1e-60 to 1e60. Such numbers are multiples
/// of 2^-252, so products of three differences are multiples of 2^-756 and below 1e182: doubles represent every bit
/// that an expansion needs. All finite f32 values qualify.
pub fn in_range(x: f64) -> bool {
    x == 0.0 || (1e-60..=1e60).contains(&x.abs())
}

/// The side of the plane through `a`, `b`, `c` that `p` is on, exact: `Greater` on the side from which the three appear
/// counterclockwise, `Equal` on the plane.
pub fn side_of_plane(a: Point, b: Point, c: Point, p: Point) -> Ordering {
    let at = |[x, y, z]: Point| Coord3D { x, y, z };
    // robust returns the sign of the tetrahedron's volume: positive below the plane.
    compare_to_zero(-robust::orient3d(at(a), at(b), at(c), at(p)))
}

/// The orientation of `a`, `b`, `c`, exact: `Greater` for counterclockwise, `Equal` for collinear.
pub fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Ordering {
    let at = |[x, y]: [f64; 2]| Coord { x, y };
    compare_to_zero(robust::orient2d(at(a), at(b), at(c)))
}

/// Whether three points are collinear, exact: they are if all three axis-aligned projections are.
pub fn collinear(a: Point, b: Point, c: Point) -> bool {
    [[0, 1], [1, 2], [2, 0]].iter().all(|[i, j]| {
        let shadow = |p: Point| [p[*i], p[*j]];
        turn(shadow(a), shadow(b), shadow(c)) == Ordering::Equal
    })
}

/// Order by x, then y, then z.
pub fn lexicographic(a: &Point, b: &Point) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}

fn compare_to_zero(x: f64) -> Ordering {
    // Adding 0 turns -0.0 into 0.0; total_cmp distinguishes the two.
    (x + 0.0).total_cmp(&0.0)
}
