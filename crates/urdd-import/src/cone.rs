//! Cones, which a URDF does not have, as meshes.

use urdd_geometry::Mesh;

/// The number of sides of a cone.
const SIDES: u32 = 64;

/// A cone of radius 1 and length 1 along z, about the middle of its length, its tip at the top.
pub fn cone() -> Mesh {
    let rim = (0..SIDES).map(|side| {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
        [angle.cos(), angle.sin(), -0.5]
    });
    let vertices: Vec<[f64; 3]> = rim.chain([[0.0, 0.0, 0.5], [0.0, 0.0, -0.5]]).collect();
    let (tip, middle) = (SIDES, SIDES + 1);
    let triangles = (0..SIDES).flat_map(|side| {
        let next = (side + 1) % SIDES;
        [[side, next, tip], [next, side, middle]]
    });
    let mut mesh = Mesh { vertices, triangles: triangles.collect() };
    mesh.round_to_f32();
    mesh
}
