//! Texture coordinates of triangles.

use std::collections::HashMap;

use crate::mesh::Mesh;

/// Texture coordinates of the corners of polygons, while these become triangles. Without textures, it does nothing.
#[derive(Default)]
pub(super) struct UvCorners {
    of_vertex: HashMap<u32, u32>,
    triangles: Vec<[u32; 3]>,
}

impl UvCorners {
    /// Those of triangles whose corners have the same index for both.
    pub(super) fn of(triangles: Vec<[u32; 3]>) -> Self {
        Self { of_vertex: HashMap::new(), triangles }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.of_vertex.is_empty()
    }

    /// Notes the texture coordinate of a corner of the current polygon.
    pub(super) fn note(&mut self, vertex: u32, uv: u32) {
        self.of_vertex.insert(vertex, uv);
    }

    /// Gives texture coordinates to the triangles that the current polygon became, the last ones.
    pub(super) fn follow(&mut self, triangles: &[[u32; 3]]) {
        if self.is_empty() {
            return;
        }
        let uv_of = |vertex: u32| self.of_vertex.get(&vertex).copied().unwrap_or(u32::MAX);
        let new = triangles.iter().skip(self.triangles.len());
        self.triangles.extend(new.map(|triangle| triangle.map(uv_of)));
    }

    /// A mesh of these triangles with a vertex for each pair of position and texture coordinate, and these coordinates,
    /// of which two numbers count; none without values. Leaves out a triangle with a missing vertex.
    pub(super) fn mesh(
        &self,
        vertices: &[[f64; 3]],
        triangles: &[[u32; 3]],
        values: &[[f64; 3]],
    ) -> (Mesh, Vec<[f64; 2]>) {
        let (mut mesh, mut uvs, mut places) = (Mesh::default(), Vec::new(), HashMap::new());
        for (triangle, corners) in triangles.iter().zip(&self.triangles) {
            if triangle.iter().any(|index| *index as usize >= vertices.len()) {
                continue;
            }
            mesh.triangles.push([0, 1, 2].map(|at| {
                *places.entry((triangle[at], corners[at])).or_insert_with(|| {
                    let uv = values
                        .get(corners[at] as usize)
                        .filter(|uv| uv[..2].iter().all(|value| (*value as f32).is_finite()));
                    uvs.push(uv.map_or([0.0; 2], |uv| [uv[0], uv[1]]));
                    mesh.vertices.push(vertices[triangle[at] as usize]);
                    mesh.vertices.len() as u32 - 1
                })
            }));
        }
        uvs.truncate(if values.is_empty() { 0 } else { uvs.len() });
        (mesh, uvs)
    }
}
