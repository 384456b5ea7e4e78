//! Visual geometry with fewer triangles, by meshoptimizer's edge collapses. The deviation is measured on both surfaces.

use std::collections::HashMap;

use meshoptimizer_rs::{
    Attributes, Error, LodQualityMesh, LodQualityOptions, Positions, SimplifyOptions,
    SimplifySettings, Workspace, measure_lod_quality, simplify, simplify_with_attributes,
};
use rayon::prelude::*;

use crate::Note;
use urdd_directory::range::{OutOfRange, Range};
use urdd_geometry::Mesh;
use urdd_geometry::read::Part;

/// [`Detail`].
const VISUALS: Range =
    Range::above_zero("visuals", "(a part between 0 and 1, or a whole number of triangles)");

/// How much visual geometry there is: fewer triangles for simulators.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Detail {
    /// None.
    Nothing,
    /// All.
    #[default]
    Full,
    /// At most this part of its triangles, between 0 and 1.
    Ratio(f64),
    /// At most as many triangles in total, where collapses allow it. All meshes get the same error.
    Triangles(usize),
}

impl Detail {
    /// A part of all triangles, or a number of them.
    ///
    /// # Errors
    /// If it is neither.
    pub fn new(given: f64) -> Result<Detail, OutOfRange> {
        match VISUALS.check(given)? {
            ratio if ratio < 1.0 => Ok(Detail::Ratio(ratio)),
            count if count.fract() == 0.0 => Ok(Detail::Triangles(count as usize)),
            given => Err(OutOfRange { range: VISUALS, given }),
        }
    }

    pub(super) fn is_in_range(self) -> Result<(), OutOfRange> {
        let (given, is_right) = match self {
            Detail::Nothing | Detail::Full => return Ok(()),
            Detail::Ratio(ratio) => (ratio, ratio > 0.0 && ratio < 1.0),
            Detail::Triangles(count) => (count as f64, count > 0),
        };
        if is_right { Ok(()) } else { Err(OutOfRange { range: VISUALS, given }) }
    }
}

/// Samples on a surface, besides the corners of its triangles.
const SAMPLES: f64 = 10_000.0;

/// The error that edge collapses may make, m: [`FINEST`] times a power of [`STEP`], below [`STEPS`].
const FINEST: f64 = 1e-5;
const STEP: f64 = 1.25;
const STEPS: u32 = 64;

/// Simplifies meshes, and says by how much: all with the same error, the least with which there are few enough triangles.
/// A mesh that cannot be simplified stays as it is. What is left of a mesh has the texture coordinates that it had, and a
/// texture moves on it by no more than that error.
pub fn simplify_all(mut parts: Vec<&mut Part>, detail: Detail) -> Option<Note> {
    let from: usize = parts.iter().map(|part| part.mesh.triangles.len()).sum();
    let most = match detail {
        Detail::Nothing | Detail::Full => return None,
        Detail::Ratio(ratio) => (from as f64 * ratio).ceil() as usize,
        Detail::Triangles(most) => most,
    };
    if most >= from {
        return None;
    }
    let surfaces: Vec<Surface> = parts.par_iter().map(|part| Surface::new(part)).collect();
    let with_error = |step: u32| -> Vec<Option<Vec<u32>>> {
        let error = (FINEST * STEP.powi(step as i32)) as f32;
        surfaces.par_iter().map(|surface| surface.simplified(error).ok()).collect()
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
    let changes = parts.par_iter_mut().zip(&surfaces).zip(best);
    let deviations = changes.map(|((part, surface), found)| {
        let Some(found) = found.filter(|found| found.len() < surface.indices.len()) else {
            return 0.0;
        };
        // What cannot be measured is not changed.
        let Ok(deviation) = surface.deviation(&found, part.mesh.area()) else { return 0.0 };
        surface.compact(&found, part);
        deviation
    });
    let deviation = deviations.reduce(|| 0.0, f64::max);
    Some(Note::Simplified {
        from,
        to: parts.iter().map(|part| part.mesh.triangles.len()).sum(),
        micrometres: (deviation * 1e6).ceil() as u64,
    })
}

/// A mesh in meshoptimizer's form.
struct Surface {
    vertices: Vec<[f32; 3]>,
    indices: Vec<u32>,
    /// Texture coordinates of the vertices, if there are any.
    uvs: Vec<[f32; 2]>,
    /// Metres on the surface for one texture, about.
    uv_size: f32,
}

impl Surface {
    /// Vertices with equal positions and texture coordinates are one: otherwise each triangle of an STL would be a surface
    /// of its own.
    fn new(part: &Part) -> Self {
        let uv = part.texture.as_ref().map_or(&[][..], |texture| &texture.uv);
        let (mut vertices, mut uvs, mut places) = (Vec::new(), Vec::new(), HashMap::new());
        let place_of = |(at, vertex): (usize, &[f64; 3])| {
            // Adding 0 makes -0 equal to 0.
            let position = vertex.map(|coordinate| coordinate as f32 + 0.0);
            let uv = uv.get(at).map(|uv| uv.map(|coordinate| coordinate as f32 + 0.0));
            let key = (position.map(f32::to_bits), uv.map(|uv| uv.map(f32::to_bits)));
            *places.entry(key).or_insert_with(|| {
                vertices.push(position);
                uvs.extend(uv);
                (vertices.len() - 1) as u32
            })
        };
        let places: Vec<u32> = part.mesh.vertices.iter().enumerate().map(place_of).collect();
        let indices = part.mesh.triangles.as_flattened().iter();
        let indices = indices.map(|index| places[*index as usize]).collect();
        let size = part.mesh.bounds().map_or(0.0, |bounds| bounds.extent());
        Surface { vertices, indices, uvs, uv_size: size as f32 }
    }

    /// The triangles that are left with this error, m. A surface never vanishes.
    fn simplified(&self, error: f32) -> Result<Vec<u32>, Error> {
        let settings = SimplifySettings {
            target_index_count: 0,
            target_error: error,
            options: SimplifyOptions::ERROR_ABSOLUTE,
        };
        let positions = Positions::from_packed(&self.vertices);
        let mut workspace = Workspace::default();
        let found = match &self.uvs[..] {
            [] => simplify(&self.indices, positions, settings, &mut workspace)?,
            uvs => {
                let uvs = Attributes::from_interleaved(uvs.as_flattened(), uvs.len(), 2, 2, 0)?;
                let weights = [self.uv_size; 2];
                let (indices, workspace) = (&self.indices, &mut workspace);
                simplify_with_attributes(
                    indices, positions, uvs, &weights, None, settings, workspace,
                )?
            }
        };
        Ok(if found.indices.is_empty() { self.indices.clone() } else { found.indices })
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

    /// Makes a part of the vertices that triangles use, in their order.
    fn compact(&self, indices: &[u32], part: &mut Part) {
        let mut places = vec![u32::MAX; self.vertices.len()];
        let (mut mesh, mut uvs) = (Mesh::default(), Vec::new());
        for triangle in indices.as_chunks::<3>().0 {
            mesh.triangles.push(triangle.map(|index| {
                let place = &mut places[index as usize];
                if *place == u32::MAX {
                    *place = mesh.vertices.len() as u32;
                    mesh.vertices.push(self.vertices[index as usize].map(f64::from));
                    uvs.extend(self.uvs.get(index as usize).map(|uv| uv.map(f64::from)));
                }
                *place
            }));
        }
        part.mesh = mesh;
        if let Some(texture) = &mut part.texture {
            texture.uv = uvs;
        }
    }
}
