//! Whether two meshes are the same surface, in any order of triangles; the distinct vertices of one, and its open edges.

use std::collections::{HashMap, HashSet};

use crate::Mesh;

/// How equal two meshes must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Likeness {
    /// The same triangles with the same multiplicity.
    SameTriangles,
    /// The same triangles with any multiplicity.
    SameSurface,
}

/// The difference of a mesh from the expected one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Difference {
    /// Number of missing triangles.
    pub missing: usize,
    /// The excess triangles.
    pub extra: Vec<usize>,
    /// Number of triangles facing the other way.
    pub turned: usize,
    /// Its place: a corner or the centroid of the first differing triangle, metres.
    pub place: [f64; 3],
    /// Largest distance of an excess corner from the nearest expected one, or the other way round; 0 if only triangles
    /// differ. Metres.
    pub distance: f64,
}

/// The largest absolute coordinate of a mesh's triangles, metres.
pub fn extent(mesh: &Mesh) -> f64 {
    let corners = mesh.triangles.iter().flatten();
    let places = corners.map(|vertex| mesh.vertices[*vertex as usize]);
    let larger = |most: f64, x: f64| if x.abs() > most { x.abs() } else { most };
    places.fold(0.0, |most, place| place.into_iter().fold(most, larger))
}

/// A triangle needs a counterpart if its smallest height is more than this multiple of the tolerance (SPEC 7.6.1). Corners
/// that agree are at most sqrt 3 tolerances apart, so heights of counterparts differ by at most 2 sqrt 3 of them: what is
/// thinner than the tolerance in one mesh, and left out there, needs none in the other.
const NEEDS_COUNTERPART: f64 = 5.0;

/// Whether a triangle must be in a mesh that is compared with its own.
pub fn needs_counterpart(corners: [[f64; 3]; 3], tolerance: f64) -> bool {
    !is_thin(corners, NEEDS_COUNTERPART * tolerance)
}

/// The difference of a mesh from the expected one. Corners within `tolerance` are equal. Thin triangles need no
/// counterpart, and may be one.
pub fn difference(
    expected: &Mesh,
    actual: &Mesh,
    tolerance: f64,
    likeness: Likeness,
) -> Difference {
    if same_in_order(expected, actual, tolerance) {
        return Difference::default();
    }
    Matching::new(expected, actual, tolerance).difference(likeness)
}

/// Whether two meshes have the same triangles in the same order, apart from those that need no counterpart.
fn same_in_order(a: &Mesh, b: &Mesh, tolerance: f64) -> bool {
    let near = |p: [f64; 3], q: [f64; 3]| (0..3).all(|i| (p[i] - q[i]).abs() <= tolerance);
    let (mut i, mut j) = (0, 0);
    loop {
        match (a.triangles.get(i), b.triangles.get(j)) {
            (None, None) => return true,
            (Some(s), Some(t))
                if a.corners(*s).into_iter().zip(b.corners(*t)).all(|(p, q)| near(p, q)) =>
            {
                (i, j) = (i + 1, j + 1);
            }
            (Some(s), _) if !needs_counterpart(a.corners(*s), tolerance) => i += 1,
            (_, Some(t)) if !needs_counterpart(b.corners(*t), tolerance) => j += 1,
            _ => return false,
        }
    }
}

/// Whether a triangle is thinner than `tolerance`: its smallest height.
pub fn is_thin(corners: [[f64; 3]; 3], tolerance: f64) -> bool {
    let [a, b, c] = corners.map(nalgebra::Vector3::from);
    let sides = [(b - a), (c - b), (a - c)];
    let longest = sides.iter().map(|s| s.norm()).fold(0.0, f64::max);
    // Twice the area is the longest side times the smallest height.
    sides[0].cross(&sides[2]).norm() <= tolerance * longest
}

/// The corners of two meshes, with those within the tolerance merged.
pub struct Matching<'a> {
    meshes: [&'a Mesh; 2],
    tolerance: f64,
    /// For each vertex of each mesh, the index of its merged point.
    pub places: [Vec<u32>; 2],
}

/// Triangles on the same three points: their number in each mesh, by orientation.
#[derive(Default)]
struct Count {
    all: [[u32; 2]; 2],
    /// Those that need a counterpart.
    needing: [[u32; 2]; 2],
}

impl Difference {
    /// Whether the meshes differ.
    pub fn is_any(&self) -> bool {
        self.missing > 0 || self.turned > 0 || !self.extra.is_empty()
    }
}

impl<'a> Matching<'a> {
    /// Merges the corners of the two meshes.
    pub fn new(expected: &'a Mesh, actual: &'a Mesh, tolerance: f64) -> Self {
        let meshes = [expected, actual];
        let points: Vec<[f64; 3]> =
            meshes.iter().flat_map(|mesh| mesh.vertices.iter().copied()).collect();
        let mut joined = Groups::new(points.len());
        let size = (2.0 * tolerance).max(f64::MIN_POSITIVE);
        let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::with_capacity(points.len());
        let mut exact: HashMap<[u64; 3], u32> = HashMap::with_capacity(points.len());
        for (at, point) in points.iter().enumerate() {
            let bits = bits(*point);
            if let Some(same) = exact.get(&bits) {
                joined.join(*same as usize, at);
                continue;
            }
            exact.insert(bits, at as u32);
            let scaled = point.map(|x| x / size);
            let cell = scaled.map(|x| x.floor() as i64);
            // A point within the tolerance, half a cell, is in this cell or in the next one on the near side.
            let side = scaled.map(|x| if x.fract().rem_euclid(1.0) < 0.5 { -1 } else { 1 });
            for corner in 0..8 {
                let neighbour: [i64; 3] = std::array::from_fn(|i| match corner >> i & 1 {
                    0 => cell[i],
                    _ => cell[i].saturating_add(side[i]),
                });
                for &other in cells.get(&neighbour).into_iter().flatten() {
                    let q = points[other as usize];
                    if (0..3).all(|i| (point[i] - q[i]).abs() <= tolerance) {
                        joined.join(other as usize, at);
                    }
                }
            }
            cells.entry(cell).or_default().push(at as u32);
        }
        let mut first: Vec<u32> = (0..points.len()).map(|at| joined.first(at) as u32).collect();
        let second = first.split_off(expected.vertices.len());
        Matching { meshes, tolerance, places: [first, second] }
    }

    /// The points of a triangle in ascending order, and its orientation; `None` if two are one.
    fn key(&self, which: usize, triangle: [u32; 3]) -> Option<([u32; 3], usize)> {
        let [a, b, c] = triangle.map(|vertex| self.places[which][vertex as usize]);
        if a == b || b == c || c == a {
            return None;
        }
        let mut sorted = [a, b, c];
        sorted.sort_unstable();
        let even = [[a, b, c], [b, c, a], [c, a, b]].contains(&sorted);
        Some((sorted, usize::from(even)))
    }

    fn difference(&self, likeness: Likeness) -> Difference {
        let needs = |which: usize, triangle: [u32; 3]| {
            needs_counterpart(self.meshes[which].corners(triangle), self.tolerance)
        };
        let mut counts: HashMap<[u32; 3], Count> = HashMap::new();
        for which in 0..2 {
            for triangle in &self.meshes[which].triangles {
                if let Some((key, facing)) = self.key(which, *triangle) {
                    let count = counts.entry(key).or_default();
                    count.all[which][facing] += 1;
                    count.needing[which][facing] += u32::from(needs(which, *triangle));
                }
            }
        }
        let mut difference = Difference::default();
        let mut first: Option<[[f64; 3]; 3]> = None;
        let mut lost = [Vec::new(), Vec::new()];
        for (which, lost) in lost.iter_mut().enumerate() {
            for (at, triangle) in self.meshes[which].triangles.iter().enumerate() {
                if !needs(which, *triangle) {
                    continue;
                }
                let Some((key, facing)) = self.key(which, *triangle) else { continue };
                let Some(count) = counts.get_mut(&key) else { continue };
                let (here, there) = (&mut count.needing[which], count.all[1 - which]);
                let (total_here, total_there) = (here[0] + here[1], there[0] + there[1]);
                // Whether the other mesh lacks it, or has it with the other orientation.
                let (differs, is_turned) = match likeness {
                    Likeness::SameTriangles => {
                        (total_here > total_there, here[facing] > there[facing])
                    }
                    Likeness::SameSurface => {
                        (total_there == 0, there[facing] == 0 && here[1 - facing] == 0)
                    }
                };
                if differs {
                    // Each excess one counts once.
                    if likeness == Likeness::SameTriangles {
                        here[if here[facing] > 0 { facing } else { 1 - facing }] -= 1;
                    }
                    match which {
                        0 => difference.missing += 1,
                        _ => difference.extra.push(at),
                    }
                    lost.push(*triangle);
                } else if which == 1 && is_turned {
                    difference.turned += 1;
                } else {
                    continue;
                }
                first.get_or_insert(self.meshes[which].corners(*triangle));
            }
        }
        if let Some([a, b, c]) = first {
            difference.place = std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3.0);
        }
        if let Some((place, distance)) = self.farthest(&lost) {
            (difference.place, difference.distance) = (place, distance);
        }
        difference
    }

    /// Of the corners of missing triangles that the other mesh does not have, the one farthest from all its corners.
    /// Only some are measured, so that the work is bounded.
    fn farthest(&self, lost: &[Vec<[u32; 3]>; 2]) -> Option<([f64; 3], f64)> {
        const MAX_CORNERS: usize = 64;
        let mut farthest: Option<([f64; 3], f64)> = None;
        for (which, lost) in lost.iter().enumerate() {
            let other = self.meshes[1 - which];
            let known: HashSet<u32> = self.places[1 - which].iter().copied().collect();
            let corners = lost.iter().flatten().copied();
            let alone: Vec<u32> = corners
                .filter(|vertex| !known.contains(&self.places[which][*vertex as usize]))
                .collect();
            let step = (alone.len() / MAX_CORNERS).max(1);
            for vertex in alone.into_iter().step_by(step).take(MAX_CORNERS) {
                let point = self.meshes[which].vertices[vertex as usize];
                let nearest = nearest(other, point);
                if farthest.is_none_or(|(_, most)| nearest > most) && nearest.is_finite() {
                    farthest = Some((point, nearest));
                }
            }
        }
        farthest
    }
}

/// Distance of a point from the nearest vertex of a mesh, metres.
pub fn nearest(mesh: &Mesh, point: [f64; 3]) -> f64 {
    let square = |q: &[f64; 3]| (0..3).map(|i| (point[i] - q[i]).powi(2)).sum::<f64>();
    let least = mesh.vertices.iter().map(square).fold(f64::INFINITY, f64::min);
    least.sqrt()
}

/// The distinct vertices of a mesh's triangles, in order.
pub fn distinct(mesh: &Mesh) -> Vec<[f64; 3]> {
    let mut seen = HashSet::with_capacity(mesh.vertices.len());
    // Six triangles share a vertex, whose place is hashed once.
    let mut used = vec![false; mesh.vertices.len()];
    let corners = mesh.triangles.as_flattened().iter();
    let first = corners.filter(|vertex| !std::mem::replace(&mut used[**vertex as usize], true));
    let places = first.map(|vertex| mesh.vertices[*vertex as usize]);
    places.filter(|place| seen.insert(bits(*place))).collect()
}

/// A point as a key.
pub fn bits(place: [f64; 3]) -> [u64; 3] {
    // Adding 0 makes -0 equal to 0.
    place.map(|x| (x + 0.0).to_bits())
}

/// The middle of an edge that is not used equally often in both directions.
pub fn open_edge(mesh: &Mesh) -> Option<[f64; 3]> {
    let mut places: HashMap<[u64; 3], usize> = HashMap::new();
    let mut place = |vertex: u32| {
        let next = places.len();
        *places.entry(bits(mesh.vertices[vertex as usize])).or_insert(next)
    };
    let triangles: Vec<[usize; 3]> = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(&mut place))
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    let edges = |[a, b, c]: [usize; 3]| [[a, b], [b, c], [c, a]];
    let mut balance: HashMap<[usize; 2], i32> = HashMap::new();
    for [a, b] in triangles.iter().copied().flat_map(edges) {
        *balance.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
    }
    let open = |[a, b]: &[usize; 2]| balance.get(&[*a.min(b), *a.max(b)]) != Some(&0);
    let [a, b] = triangles.iter().copied().flat_map(edges).find(open)?;
    let mut of = vec![[0.0; 3]; places.len()];
    for vertex in &mesh.vertices {
        if let Some(at) = places.get(&bits(*vertex)) {
            of[*at] = *vertex;
        }
    }
    Some(std::array::from_fn(|i| (of[a][i] + of[b][i]) / 2.0))
}

/// Groups of the elements `0..count`. The first element represents its group, so that the result does not depend on the
/// order of joining.
pub(crate) struct Groups(Vec<u32>);

impl Groups {
    /// Each element is a group of its own.
    pub fn new(count: usize) -> Self {
        Groups((0..count as u32).collect())
    }

    /// The first element of the group of an element.
    pub fn first(&mut self, mut at: usize) -> usize {
        while self.0[at] as usize != at {
            let up = self.0[self.0[at] as usize];
            self.0[at] = up;
            at = up as usize;
        }
        at
    }

    /// Makes the groups of two elements one.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
