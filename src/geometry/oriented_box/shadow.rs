//! The smallest box with one axis given: how far the hull reaches along the axis, times the smallest
//! rectangle about its shadow across it.

use nalgebra::Vector3;

use super::super::hull::ConvexHull;
use super::calipers::{Rectangle, outline, smallest_rectangle};

/// An edge of the hull between two triangles whose planes differ.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// The vertices, in the order in which `left` has them.
    pub vertices: [u32; 2],
    /// The triangle that has the edge in this direction.
    pub left: u32,
    /// The other triangle.
    pub right: u32,
}

/// A hull, made ready for many shadows.
pub struct Caster {
    /// x, y and z of the vertices, from the first vertex on.
    coordinates: [Vec<f64>; 3],
    /// x, y and z of the triangles' unit normals; zero where a triangle has none.
    normals: [Vec<f64>; 3],
    /// Edges whose triangles' normals differ.
    pub edges: Vec<Edge>,
    largest: Vector3<f64>,
    /// No two vertices are farther apart.
    diameter: f64,
    lit: Vec<bool>,
    /// The outline's vertex after this one, where it is on the outline.
    next: Vec<u32>,
    polygon: Vec<[f64; 2]>,
}

/// A box with one axis given.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Cubic metres.
    pub volume: f64,
    /// No box gets smaller by more than this per radian that its axes turn, cubic metres.
    pub steepness: f64,
    /// The three unit axes, right-handed; the given one is the first.
    pub axes: [Vector3<f64>; 3],
}

impl Caster {
    pub fn new(hull: &ConvexHull) -> Self {
        let mesh = hull.mesh();
        let vertex = |i: u32| Vector3::from(mesh.vertices[i as usize]);
        let areas = mesh.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(vertex);
            (b - a).cross(&(c - a))
        });
        let unit = |area: Vector3<f64>| area.try_normalize(0.0).unwrap_or_default();
        let normals: Vec<Vector3<f64>> = areas.clone().map(unit).collect();
        let largest = areas.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        let mut halves: Vec<(u32, u32, bool, u32)> = Vec::with_capacity(3 * normals.len());
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            for k in 0..3 {
                let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
                halves.push((from.min(to), from.max(to), from > to, t as u32));
            }
        }
        halves.sort_unstable();
        let edges = halves
            .chunks_exact(2)
            .map(|pair| Edge {
                vertices: [pair[0].0, pair[0].1],
                left: pair[0].3,
                right: pair[1].3,
            })
            .filter(|edge| normals[edge.left as usize] != normals[edge.right as usize])
            .collect();
        let split = |v: &[Vector3<f64>]| [0, 1, 2].map(|k| v.iter().map(|p| p[k]).collect());
        // From a vertex on, to keep the digits of what is small and far away.
        let vertices: Vec<Vector3<f64>> = (0..mesh.vertices.len() as u32)
            .map(|i| vertex(i) - vertex(0))
            .collect();
        let sides = [0, 1, 2].map(|k| {
            let along = || vertices.iter().map(|p| p[k]);
            along().fold(0.0, f64::max) - along().fold(0.0, f64::min)
        });
        Self {
            largest: largest.map(unit).unwrap_or_default(),
            diameter: Vector3::from(sides).norm(),
            coordinates: split(&vertices),
            lit: vec![false; normals.len()],
            normals: split(&normals),
            edges,
            next: vec![0; vertices.len()],
            polygon: Vec::new(),
        }
    }

    pub fn triangles(&self) -> usize {
        self.lit.len()
    }

    pub fn normal(&self, triangle: usize) -> Vector3<f64> {
        let [x, y, z] = &self.normals;
        Vector3::new(x[triangle], y[triangle], z[triangle])
    }

    /// The unit normal of the largest triangle.
    pub fn largest_normal(&self) -> Vector3<f64> {
        self.largest
    }

    /// The unit vector along an edge.
    pub fn along(&self, edge: &Edge) -> Vector3<f64> {
        let [x, y, z] = &self.coordinates;
        let [from, to] = edge.vertices.map(|i| i as usize);
        Vector3::new(x[to] - x[from], y[to] - y[from], z[to] - z[from]).normalize()
    }

    /// The least and the greatest coordinate along a direction.
    pub fn reach(&self, axis: &Vector3<f64>) -> [f64; 2] {
        let [x, y, z] = &self.coordinates;
        let mut low = [f64::INFINITY; 4];
        let mut high = [f64::NEG_INFINITY; 4];
        for (i, ((x, y), z)) in x.iter().zip(y).zip(z).enumerate() {
            let along = axis.x * x + axis.y * y + axis.z * z;
            low[i % 4] = if along < low[i % 4] {
                along
            } else {
                low[i % 4]
            };
            high[i % 4] = if along > high[i % 4] {
                along
            } else {
                high[i % 4]
            };
        }
        let fold = |v: [f64; 4], f: fn(f64, f64) -> f64| f(f(v[0], v[1]), f(v[2], v[3]));
        [fold(low, f64::min), fold(high, f64::max)]
    }

    /// The smallest box with this unit vector as an axis; `None` where the shadow is a point.
    pub fn smallest_box(&mut self, axis: &Vector3<f64>) -> Option<Candidate> {
        let [low, high] = self.reach(axis);
        let (u, v) = across(axis);
        let Rectangle {
            area,
            half_perimeter,
            side,
        } = self.shadow([axis, &u, &v])?;
        let second = u * side[0] + v * side[1];
        let axes = [*axis, second, axis.cross(&second)];
        let steepness = self.diameter * (area + (high - low) * half_perimeter);
        Some(Candidate {
            volume: (high - low) * area,
            steepness,
            axes,
        })
    }

    /// The smallest rectangle about the shadow along `axis`, in the coordinates `u` and `v`.
    ///
    /// The shadow's outline is the border of the triangles that face along the axis.
    fn shadow(&mut self, [axis, u, v]: [&Vector3<f64>; 3]) -> Option<Rectangle> {
        let [x, y, z] = &self.normals;
        for (lit, ((x, y), z)) in self.lit.iter_mut().zip(x.iter().zip(y).zip(z)) {
            *lit = axis.x * x + axis.y * y + axis.z * z > GRAZING;
        }
        let mut border = 0;
        let mut vertex = 0;
        for edge in &self.edges {
            let left = self.lit[edge.left as usize];
            if left != self.lit[edge.right as usize] {
                let [from, to] = edge.vertices;
                let (from, to) = if left { (from, to) } else { (to, from) };
                self.next[from as usize] = to;
                vertex = from;
                border += 1;
            }
        }
        let [x, y, z] = &self.coordinates;
        let project = |i: usize| {
            let p = Vector3::new(x[i], y[i], z[i]);
            [u.dot(&p), v.dot(&p)]
        };
        self.polygon.clear();
        let start = vertex;
        for _ in 0..border {
            self.polygon.push(project(vertex as usize));
            vertex = self.next[vertex as usize];
        }
        if border < 3 || vertex != start {
            // Rounding has torn the border, or nothing is lit: the hull is flat and seen edge on.
            self.polygon.clear();
            self.polygon.extend((0..x.len()).map(project));
            outline(&mut self.polygon);
        }
        smallest_rectangle(&mut self.polygon)
    }
}

/// A triangle is taken to lie along the axis, not to face it, if the cosine between its normal and
/// the axis is below this: then its shadow is thinner than this part of its size.
const GRAZING: f64 = 1e-9;

/// Two unit vectors that make a right-handed frame with a third, which comes first.
fn across(axis: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let mut least = Vector3::zeros();
    least[axis.iamin()] = 1.0;
    let u = axis.cross(&least).normalize();
    (u, axis.cross(&u))
}
