//! Helpers for the tests of shapes: point sets, and measures that use none of the code under test.
#![allow(dead_code, reason = "each test file uses its own part")]

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Rotation3, Vector3};
use urdd_geometry::mesh::Mesh;

pub type Point = [f64; 3];

/// Numbers in [0, 1) from a seed: SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    pub fn point(&mut self) -> Point {
        [self.signed(), self.signed(), self.signed()]
    }

    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, (self.unit() * (i + 1) as f64) as usize);
        }
    }
}

/// Rounded to single precision, as vertices are.
pub fn single(p: Point) -> Point {
    p.map(|x| f64::from(x as f32))
}

/// Turned by roll, pitch and yaw, moved, and rounded to single precision.
pub fn placed(points: &[Point], rpy: Point, xyz: Point) -> Vec<Point> {
    let rotation = Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
    let place = |p: &Point| single((rotation * Vector3::from(*p) + Vector3::from(xyz)).into());
    points.iter().map(place).collect()
}

/// The corners of a box about the origin.
pub fn box_corners(sides: Point) -> Vec<Point> {
    let sign = |i: usize, k: usize| if i >> k & 1 == 0 { -0.5 } else { 0.5 };
    (0..8).map(|i| [0, 1, 2].map(|k| sign(i, k) * sides[k])).collect()
}

/// The corners of a prism about z with a regular polygon across.
pub fn prism(corners: u32, radius: f64, height: f64) -> Vec<Point> {
    let angle = |i| f64::from(i) * std::f64::consts::TAU / f64::from(corners);
    let end =
        |z: f64| (0..corners).map(move |i| [radius * angle(i).cos(), radius * angle(i).sin(), z]);
    end(-height / 2.0).chain(end(height / 2.0)).collect()
}

/// Whether a value is close to the expected one, relative to it.
#[track_caller]
pub fn assert_near(actual: f64, expected: f64, relative: f64) {
    let error = (actual - expected).abs();
    assert!(error <= relative * expected.abs(), "{actual} is not {expected}");
}

/// The volume inside a closed mesh.
pub fn volume(mesh: &Mesh) -> f64 {
    let at = |i: u32| Vector3::from(mesh.vertices[i as usize]);
    let origin = at(0);
    let signed = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| at(i) - origin);
        a.dot(&b.cross(&c)) / 6.0
    };
    mesh.triangles.iter().map(signed).sum()
}

/// The area of a mesh.
pub fn area(mesh: &Mesh) -> f64 {
    let at = |i: u32| Vector3::from(mesh.vertices[i as usize]);
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(at);
        (b - a).cross(&(c - a)).norm() / 2.0
    };
    mesh.triangles.iter().map(of).sum()
}

/// The largest distance between points.
pub fn extent(points: &[Point]) -> f64 {
    let far = |p: &Point| {
        let away = |q: &Point| (Vector3::from(*p) - Vector3::from(*q)).norm();
        points.iter().map(away).fold(0.0, f64::max)
    };
    far(&points[0])
}

/// The maximum distance of a point beyond the plane of a triangle.
pub fn outside(mesh: &Mesh, points: &[Point]) -> f64 {
    let mut worst = f64::NEG_INFINITY;
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| Vector3::from(mesh.vertices[i as usize]));
        // Lengths about 1: the squares of tiny ones vanish.
        let size = (b - a).amax().max((c - a).amax());
        let normal = ((b - a) / size).cross(&((c - a) / size)).normalize();
        for p in points {
            worst = worst.max(normal.dot(&(Vector3::from(*p) - a)));
        }
    }
    worst
}

/// Asserts that each edge is in two triangles, once in each direction, that the mesh is connected and has the topology
/// of a sphere, and that all its vertices are used and among the points.
pub fn assert_closed_subset(mesh: &Mesh, points: &[Point]) {
    let mut edges: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for [a, b, c] in &mesh.triangles {
        for edge in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    for ((from, to), count) in &edges {
        assert_eq!(*count, 1, "edge {from} {to}");
        assert!(edges.contains_key(&(*to, *from)), "edge {from} {to} has one side");
    }
    let (v, e, f) = (mesh.vertices.len(), edges.len() / 2, mesh.triangles.len());
    assert_eq!(v + f, e + 2, "Euler: {v} vertices, {e} edges, {f} triangles");
    let used: BTreeSet<u32> = mesh.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), v);
    let bits = |p: &Point| p.map(|x| (x + 0.0).to_bits());
    let given: BTreeSet<_> = points.iter().map(bits).collect();
    assert!(mesh.vertices.iter().all(|p| given.contains(&bits(p))));
}
