//! Meshes of USD as triangles.

use nalgebra::Matrix3;
use urdd_geometry::Mesh;
use urdd_usd::{Prim, Value};

use super::scene::word;

/// Why a mesh is left out.
pub type Problem = &'static str;

/// Triangles of a mesh, each with the face that it is part of.
pub struct Faces {
    pub mesh: Mesh,
    pub of_triangle: Vec<u32>,
}

/// Reads a mesh. Faces of more corners become fans; points are moved by a matrix, whose mirrors turn faces round.
pub fn faces(prim: &Prim, linear: &Matrix3<f64>) -> Result<Faces, Problem> {
    let numbers = |name: &str| prim.value(name).and_then(Value::numbers);
    let points = numbers("points").filter(|points| !points.is_empty()).ok_or("it has no points")?;
    let counts = numbers("faceVertexCounts").unwrap_or_default();
    let indices = numbers("faceVertexIndices").unwrap_or_default();
    let (triples, rest) = points.as_chunks::<3>();
    if !rest.is_empty() {
        return Err("its points do not have three numbers each");
    }
    let vertices: Vec<[f64; 3]> =
        triples.iter().map(|point| (linear * nalgebra::Vector3::from(*point)).into()).collect();
    let is_turned =
        (word(prim, "orientation") == Some("leftHanded")) != (linear.determinant() < 0.0);
    let (mut triangles, mut of_triangle) = (Vec::new(), Vec::new());
    let mut rest = indices;
    for (face, count) in counts.iter().enumerate() {
        let Some((corners, after)) = rest.split_at_checked(*count as usize) else {
            return Err("its faces have more corners than there are");
        };
        rest = after;
        if corners.iter().any(|corner| !(0.0..vertices.len() as f64).contains(corner)) {
            return Err("its faces name points that it does not have");
        }
        for pair in corners.windows(2).skip(1) {
            let [a, b, c] = [corners[0] as u32, pair[0] as u32, pair[1] as u32];
            triangles.push(if is_turned { [a, c, b] } else { [a, b, c] });
            of_triangle.push(face as u32);
        }
    }
    Ok(Faces { mesh: Mesh { vertices, triangles }, of_triangle })
}

impl Faces {
    /// The triangles of some faces.
    pub fn part(&self, is_of: impl Fn(u32) -> bool) -> Mesh {
        let all = self.mesh.triangles.iter().zip(&self.of_triangle);
        let triangles =
            all.filter(|(_, face)| is_of(**face)).map(|(triangle, _)| *triangle).collect();
        let mut mesh = Mesh { vertices: self.mesh.vertices.clone(), triangles };
        mesh.drop_unused_vertices();
        mesh
    }
}
