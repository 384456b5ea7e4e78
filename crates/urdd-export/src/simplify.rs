//! Visual geometry with fewer triangles, by meshoptimizer's edge collapses. The deviation is measured on both surfaces.

use std::collections::HashMap;

use meshoptimizer_rs::{
    Error, LodQualityMesh, LodQualityOptions, Positions, SimplifyOptions, SimplifySettings,
    Workspace, measure_lod_quality, simplify,
};
use rayon::prelude::*;

use super::error::Note;
use super::options::Detail;
use urdd_geometry::Mesh;

/// Samples on a surface, besides the corners of its triangles.
const SAMPLES: f64 = 10_000.0;

/// The error that edge collapses may make, m: [`FINEST`] times a power of [`STEP`], below [`STEPS`].
const FINEST: f64 = 1e-5;
const STEP: f64 = 1.25;
const STEPS: u32 = 64;

/// Simplifies meshes, and says by how much: all with the same error, the least with which there are few enough triangles.
/// A mesh that cannot be simplified stays as it is.
pub fn simplify_all(mut meshes: Vec<&mut Mesh>, detail: Detail) -> Option<Note> {
    let from: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    let most = match detail {
        Detail::Full => return None,
        Detail::Ratio(ratio) => (from as f64 * ratio).ceil() as usize,
        Detail::Triangles(most) => most,
    };
    if most >= from {
        return None;
    }
    let surfaces: Vec<Surface> = meshes.par_iter().map(|mesh| Surface::new(mesh)).collect();
    let with_error = |step: u32| -> Vec<Option<Vec<u32>>> {
        let error = (FINEST * STEP.powi(step as i32)) as f32;
        let each = surfaces.par_iter();
        each.map(|surface| surface.simplified(error).ok()).collect()
    };
    let count = |found: &[Option<Vec<u32>>]| -> usize {
        let each = found.iter().zip(&surfaces);
        each.map(|(found, surface)| found.as_ref().unwrap_or(&surface.indices).len() / 3).sum()
    };
    // Bisects: few enough triangles at `high`, which is tried last, and too many below `low`.
    let (mut low, mut high) = (0, STEPS);
    let mut best = None;
    while low < high {
        let step = u32::midpoint(low, high);
        let found = with_error(step);
        if count(&found) <= most {
            high = step;
            best = Some(found);
        } else {
            low = step + 1;
        }
    }
    let best = best.unwrap_or_else(|| with_error(STEPS));
    let changes = meshes.par_iter_mut().zip(&surfaces).zip(best);
    let deviations = changes.map(|((mesh, surface), found)| {
        let Some(found) = found.filter(|found| found.len() < surface.indices.len()) else {
            return 0.0;
        };
        // What cannot be measured is not changed.
        let Ok(deviation) = surface.deviation(&found, mesh.area()) else {
            return 0.0;
        };
        **mesh = compact(&surface.vertices, &found);
        deviation
    });
    let deviation = deviations.reduce(|| 0.0, f64::max);
    Some(Note::Simplified {
        from,
        to: meshes.iter().map(|mesh| mesh.triangles.len()).sum(),
        micrometres: (deviation * 1e6).ceil() as u64,
    })
}

/// A mesh in meshoptimizer's form.
struct Surface {
    vertices: Vec<[f32; 3]>,
    indices: Vec<u32>,
}

impl Surface {
    fn new(mesh: &Mesh) -> Self {
        let (vertices, indices) = welded(mesh);
        Surface { vertices, indices }
    }

    /// The triangles that are left with this error, m. A surface never vanishes.
    fn simplified(&self, error: f32) -> Result<Vec<u32>, Error> {
        let settings = SimplifySettings {
            target_index_count: 0,
            target_error: error,
            options: SimplifyOptions::ERROR_ABSOLUTE,
        };
        let positions = Positions::from_packed(&self.vertices);
        let found = simplify(&self.indices, positions, settings, &mut Workspace::default())?;
        Ok(match found.indices.is_empty() {
            true => self.indices.clone(),
            false => found.indices,
        })
    }

    /// The greatest sampled distance between this surface and a simplified one, m.
    fn deviation(&self, indices: &[u32], area: f64) -> Result<f64, Error> {
        let positions = Positions::from_packed(&self.vertices);
        let mut options = LodQualityOptions::default();
        options.samples_per_unit_area = SAMPLES / area.max(f64::MIN_POSITIVE);
        let quality = measure_lod_quality(
            LodQualityMesh::new(&self.indices, positions),
            LodQualityMesh::new(indices, positions),
            &options,
            &mut Workspace::default(),
        )?;
        Ok(quality.symmetric.max)
    }
}

/// Vertices with equal positions as one: otherwise each triangle of an STL would be a surface of its own.
fn welded(mesh: &Mesh) -> (Vec<[f32; 3]>, Vec<u32>) {
    let mut places = HashMap::new();
    let mut vertices = Vec::new();
    let place_of = |vertex: &[f64; 3]| {
        // Adding 0 makes -0 equal to 0.
        let position = vertex.map(|coordinate| coordinate as f32 + 0.0);
        *places.entry(position.map(f32::to_bits)).or_insert_with(|| {
            vertices.push(position);
            (vertices.len() - 1) as u32
        })
    };
    let places: Vec<u32> = mesh.vertices.iter().map(place_of).collect();
    let indices = mesh.triangles.as_flattened().iter();
    (vertices, indices.map(|index| places[*index as usize]).collect())
}

/// A mesh of the vertices that triangles use, in their order.
fn compact(vertices: &[[f32; 3]], indices: &[u32]) -> Mesh {
    let mut places = vec![u32::MAX; vertices.len()];
    let mut mesh = Mesh::default();
    for triangle in indices.as_chunks::<3>().0 {
        mesh.triangles.push(triangle.map(|index| {
            let place = &mut places[index as usize];
            if *place == u32::MAX {
                *place = mesh.vertices.len() as u32;
                mesh.vertices.push(vertices[index as usize].map(f64::from));
            }
            *place
        }));
    }
    mesh
}
