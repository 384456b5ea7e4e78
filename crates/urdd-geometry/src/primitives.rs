//! Box, cylinder, sphere and capsule: their extents, and their tessellation.
//!
//! All meshes are closed, face outward and are centred at the origin. The axis is along z, as in URDF and `MuJoCo`.
//! Every vertex is on the true surface. Vertices on the coordinate axes are exact, so extents are exact. The flat faces
//! are inside the true surface by at most this fraction of the radius:
//!
//! | shape | vertices | triangles | deviation |
//! |---|---|---|---|
//! | box | 8 | 12 | 0 |
//! | cylinder | 64 | 124 | 1 - cos(pi / 32) = 0.48 % |
//! | sphere | 642 | 1280 | 0.46 % |
//! | capsule | 514 | 1024 | 0.96 % |
//!
//! The sphere is an icosahedron with each face split in four, three times. Among bodies with as many vertices it is
//! nearly the roundest; a sphere of meridians and parallels crowds its vertices at the poles.

use std::f64::consts::PI;

use nalgebra::Matrix3;

use super::mesh::Mesh;
use super::oriented_box::corners;
use super::vector::{cross, dot, norm};

/// A shape of URDF, centred at the origin, its axis along z. Lengths in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// A box with half of its edge lengths along x, y and z.
    Box([f64; 3]),
    /// A cylinder with half of its length.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half of the length.
        half: f64,
    },
    /// A capsule with half of the length of its cylinder.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half of the length of its cylinder.
        half: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
}

/// Where the prism of 64 sides is that stands for a cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Prism {
    /// Its corners are on the cylinder.
    Inside,
    /// The middles of its sides are; the corners are up to 0.13 % of the radius outside.
    Around,
}

/// Its sides.
const SIDES: u32 = 64;

impl Primitive {
    /// The corners of a convex body, and how far around it the primitive reaches, m.
    pub fn core(&self, prism: Prism) -> (Vec<[f64; 3]>, f64) {
        match *self {
            Primitive::Box(half) => (corners(half).to_vec(), 0.0),
            Primitive::Sphere { radius } => (vec![[0.0; 3]], radius),
            Primitive::Capsule { radius, half } => {
                (vec![[0.0, 0.0, -half], [0.0, 0.0, half]], radius)
            }
            Primitive::Cylinder { radius, half } => {
                let outer = match prism {
                    Prism::Inside => radius,
                    Prism::Around => radius / (PI / f64::from(SIDES)).cos(),
                };
                let corner = |k: u32| {
                    let angle = 2.0 * PI * f64::from(k % SIDES) / f64::from(SIDES);
                    let z = if k < SIDES { -half } else { half };
                    [outer * angle.cos(), outer * angle.sin(), z]
                };
                ((0..2 * SIDES).map(corner).collect(), 0.0)
            }
        }
    }

    /// Cubic metres.
    pub fn volume(&self) -> f64 {
        match *self {
            Primitive::Box(half) => 8.0 * half[0] * half[1] * half[2],
            Primitive::Cylinder { radius, half } => PI * radius * radius * 2.0 * half,
            Primitive::Capsule { radius, half } => {
                PI * radius * radius * (2.0 * half + 4.0 / 3.0 * radius)
            }
            Primitive::Sphere { radius } => 4.0 / 3.0 * PI * radius * radius * radius,
        }
    }

    /// Half of the extents along x, y and z, metres, after a rotation.
    pub fn half_extents(&self, rotation: &Matrix3<f64>) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let row = rotation.row(axis);
            match *self {
                Primitive::Box(half) => (0..3).map(|i| (row[i] * half[i]).abs()).sum(),
                // A disk whose normal has the component n along an axis reaches radius * sqrt(1 - n²) along it.
                Primitive::Cylinder { radius, half } => {
                    row[2].abs() * half + radius * (1.0 - row[2] * row[2]).max(0.0).sqrt()
                }
                Primitive::Capsule { radius, half } => row[2].abs() * half + radius,
                Primitive::Sphere { radius } => radius,
            }
        })
    }
}

/// Vertices of a circle.
pub const SEGMENTS: usize = 32;
/// Circles from the equator to a pole of a capsule, including the equator.
pub const RINGS: usize = SEGMENTS / 4;
/// How many times the faces of the icosahedron are split.
const SPLITS: usize = 3;

/// Triangles of a box.
pub const CUBOID_TRIANGLES: usize = 12;
/// Triangles of a cylinder.
pub const CYLINDER_TRIANGLES: usize = 4 * SEGMENTS - 4;
/// Triangles of a capsule.
pub const CAPSULE_TRIANGLES: usize = 4 * RINGS * SEGMENTS;
/// Triangles of a sphere.
pub const SPHERE_TRIANGLES: usize = 20 << (2 * SPLITS);

/// A box with the edge lengths `size` along x, y and z, metres.
pub fn cuboid(size: [f64; 3]) -> Mesh {
    let half = size.map(|length| length / 2.0);
    // The index of a corner is 4 x + 2 y + z; each coordinate is 0 at the low side, else 1.
    let vertices = (0..8)
        .map(|corner| [4, 2, 1].map(|bit| if corner & bit == 0 { -1.0 } else { 1.0 }))
        .map(|side: [f64; 3]| std::array::from_fn(|axis| side[axis] * half[axis]))
        .collect();
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh { vertices, triangles }
}

/// A cylinder along z with the given radius and full length, metres.
pub fn cylinder(radius: f64, length: f64) -> Mesh {
    let mut mesh = Mesh::default();
    push_ring(&mut mesh, radius, -length / 2.0);
    push_ring(&mut mesh, radius, length / 2.0);
    join_rings(&mut mesh, 0);
    for corner in 1..index(SEGMENTS) - 1 {
        mesh.triangles.push([0, corner + 1, corner]);
        mesh.triangles.push([0, corner, corner + 1].map(|corner| corner + index(SEGMENTS)));
    }
    mesh
}

/// A capsule along z: a cylinder of the given radius and length with a hemisphere at each end, metres.
pub fn capsule(radius: f64, length: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let circle = circle();
    mesh.vertices.push([0.0, 0.0, -length / 2.0 - radius]);
    for &(cosine, sine) in &circle[1..=RINGS] {
        push_ring(&mut mesh, radius * sine, -length / 2.0 - radius * cosine);
    }
    for &(cosine, sine) in &circle[..RINGS] {
        push_ring(&mut mesh, radius * cosine, length / 2.0 + radius * sine);
    }
    let top = index(mesh.vertices.len());
    mesh.vertices.push([0.0, 0.0, length / 2.0 + radius]);
    let first = |ring: usize| 1 + index(ring * SEGMENTS);
    for corner in 0..SEGMENTS {
        let (here, next) = (index(corner), index((corner + 1) % SEGMENTS));
        mesh.triangles.push([0, first(0) + next, first(0) + here]);
        mesh.triangles.push([first(2 * RINGS - 1) + here, first(2 * RINGS - 1) + next, top]);
    }
    for ring in 0..2 * RINGS - 1 {
        join_rings(&mut mesh, first(ring));
    }
    mesh
}

/// A sphere of the given radius, metres.
pub fn sphere(radius: f64) -> Mesh {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut mesh = Mesh::default();
    for (one, long) in [(-1.0, -golden), (1.0, -golden), (-1.0, golden), (1.0, golden)] {
        mesh.vertices.extend([[0.0, one, long], [one, long, 0.0], [long, 0.0, one]].map(unit));
    }
    // Faces of the icosahedron: triples of adjacent corners, found by their dot products.
    let near = |a: usize, b: usize| dot(mesh.vertices[a], mesh.vertices[b]) > 0.4 && a != b;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let [p, q, r] = [a, b, c].map(|corner| mesh.vertices[corner]);
                    let outward = dot(cross(p, q), r) > 0.0;
                    let (b, c) = if outward { (b, c) } else { (c, b) };
                    mesh.triangles.push([a, b, c].map(index));
                }
            }
        }
    }
    for _ in 0..SPLITS {
        split(&mut mesh);
    }
    for vertex in &mut mesh.vertices {
        *vertex = vertex.map(|coordinate| coordinate * radius);
    }
    mesh
}

/// Splits each triangle in four and moves the new vertices out to the unit sphere.
fn split(mesh: &mut Mesh) {
    let mut middles = std::collections::BTreeMap::new();
    let mut triangles = Vec::with_capacity(mesh.triangles.len() * 4);
    for [a, b, c] in std::mem::take(&mut mesh.triangles) {
        let mut middle = |from: u32, to: u32| {
            *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                let [from, to] = [from, to].map(|corner| mesh.vertices[corner as usize]);
                mesh.vertices.push(unit(std::array::from_fn(|axis| from[axis] + to[axis])));
                index(mesh.vertices.len() - 1)
            })
        };
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    mesh.triangles = triangles;
}

/// Cosine and sine of each vertex of the circle: exact at the quarters, and exactly mirrored between them.
fn circle() -> [(f64, f64); SEGMENTS] {
    let quarter = SEGMENTS / 4;
    let eighth =
        |corner: usize| (std::f64::consts::TAU * corner as f64 / SEGMENTS as f64).sin_cos();
    std::array::from_fn(|corner| {
        let within = corner % quarter;
        let (sine, cosine) = if within * 2 <= quarter {
            eighth(within)
        } else {
            let (sine, cosine) = eighth(quarter - within);
            (cosine, sine)
        };
        match corner / quarter {
            0 => (cosine, sine),
            1 => (-sine, cosine),
            2 => (-cosine, -sine),
            _ => (sine, -cosine),
        }
    })
}

fn push_ring(mesh: &mut Mesh, radius: f64, height: f64) {
    mesh.vertices.extend(circle().map(|(cosine, sine)| [radius * cosine, radius * sine, height]));
}

/// Adds the wall between the ring that starts at `first` and the next ring.
fn join_rings(mesh: &mut Mesh, first: u32) {
    for corner in 0..SEGMENTS {
        let (a, b) = (first + index(corner), first + index((corner + 1) % SEGMENTS));
        let (d, c) = (a + index(SEGMENTS), b + index(SEGMENTS));
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
}

/// Primitive meshes have a few hundred vertices, so the cast is safe.
const fn index(at: usize) -> u32 {
    at as u32
}

fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = norm(vector);
    vector.map(|coordinate| coordinate / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    /// The extents agree with those of tessellated shapes, up to the tessellation.
    #[test]
    fn extents_are_those_of_the_surfaces() {
        let (radius, half) = (0.3, 0.25);
        let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
        for (shape, mut mesh) in [
            (Primitive::Box([0.1, 0.2, 0.3]), cuboid([0.2, 0.4, 0.6])),
            (Primitive::Cylinder { radius, half }, cylinder(0.3, 0.5)),
            (Primitive::Capsule { radius, half }, capsule(0.3, 0.5)),
            (Primitive::Sphere { radius }, sphere(0.3)),
        ] {
            mesh.transform(&turn.to_homogeneous());
            let (found, bounds) = (shape.half_extents(turn.matrix()), mesh.bounds().unwrap());
            for (axis, reach) in found.into_iter().enumerate() {
                for end in [-bounds.min[axis], bounds.max[axis]] {
                    let beyond = reach - end;
                    assert!((-1e-12..0.004).contains(&beyond), "{shape:?}: {found:?}");
                }
            }
        }
    }
}
