//! Meshes of USD as triangles.

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};
use urdd_geometry::Mesh;
use urdd_usd::{Prim, Value};

use super::look::Image;
use super::scene::word;

/// Why a mesh is left out.
pub type Problem = &'static str;

/// Triangles of a mesh, each with the face that it is part of, and its corners in the list of those of faces.
pub struct Faces {
    pub mesh: Mesh,
    pub of_triangle: Vec<u32>,
    corners: Vec<[u32; 3]>,
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
        triples.iter().map(|point| (linear * Vector3::from(*point)).into()).collect();
    let is_turned =
        (word(prim, "orientation") == Some("leftHanded")) != (linear.determinant() < 0.0);
    let (mut triangles, mut of_triangle, mut corners) = (Vec::new(), Vec::new(), Vec::new());
    let mut first = 0;
    for (face, count) in counts.iter().enumerate() {
        let count = *count as usize;
        let own = indices.get(first..).and_then(|rest| rest.get(..count));
        let own = own.ok_or("its faces have more corners than there are")?;
        if own.iter().any(|corner| !(0.0..vertices.len() as f64).contains(corner)) {
            return Err("its faces name points that it does not have");
        }
        for second in 1..count.saturating_sub(1) {
            let [b, c] = if is_turned { [second + 1, second] } else { [second, second + 1] };
            triangles.push([0, b, c].map(|corner| own[corner] as u32));
            corners.push([0, b, c].map(|corner| (first + corner) as u32));
            of_triangle.push(face as u32);
        }
        first += count;
    }
    Ok(Faces { mesh: Mesh { vertices, triangles }, of_triangle, corners })
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

    /// The same with places in an image, one for each vertex; none if the mesh does not say them.
    pub fn painted(
        &self,
        prim: &Prim,
        image: &Image,
        is_of: impl Fn(u32) -> bool,
    ) -> Option<(Mesh, Vec<[f64; 2]>)> {
        let name = format!("primvars:{}", image.primvar);
        let of = prim.property(&name)?;
        let (pairs, _) = of.value.as_ref()?.numbers()?.as_chunks::<2>();
        let indices = prim.value(&format!("{name}:indices")).and_then(Value::numbers);
        let kind = of.fields.iter().find(|(name, _)| **name == *"interpolation");
        let kind = kind.and_then(|(_, kind)| kind.text()).map_or("constant", |kind| kind);
        let (mut mesh, mut uv) = (Mesh::default(), Vec::new());
        let mut known: HashMap<(u32, usize), u32> = HashMap::new();
        for (at, triangle) in self.mesh.triangles.iter().enumerate() {
            let face = self.of_triangle[at];
            if !is_of(face) {
                continue;
            }
            let mut corners = [0; 3];
            for side in 0..3 {
                let place = match kind {
                    "faceVarying" => self.corners[at][side],
                    "vertex" | "varying" => triangle[side],
                    "uniform" => face,
                    _ => 0,
                } as usize;
                let place =
                    indices.map_or(Some(place), |all| all.get(place).map(|of| *of as usize));
                let place = place?;
                corners[side] = match known.get(&(triangle[side], place)) {
                    Some(known) => *known,
                    None => {
                        let [u, v] = *pairs.get(place)?;
                        let pair = image.moved * Vector3::new(u, v, 1.0);
                        uv.push(pair.iter().all(|of| of.is_finite()).then(|| pair.into())?);
                        mesh.vertices.push(self.mesh.vertices[triangle[side] as usize]);
                        known.insert((triangle[side], place), uv.len() as u32 - 1);
                        uv.len() as u32 - 1
                    }
                };
            }
            mesh.triangles.push(corners);
        }
        Some((mesh, uv))
    }
}
