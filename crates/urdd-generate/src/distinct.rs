//! Processes identical meshes once. Robots often use one mesh on many links: the legs of a quadruped, the fingers of a
//! hand.

use std::collections::HashMap;
use std::hash::{Hash, Hasher};

use rayon::prelude::*;

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_geometry::Mesh;

/// The result of `work` for each mesh. Runs `work` once for meshes that are identical bit for bit, with the index of the
/// first.
/// Fails if cancelled; checked before each mesh.
pub fn for_each_content<T: Clone + Send>(
    meshes: &[&Mesh],
    cancellation: &Cancellation,
    work: impl Fn(usize, &Mesh) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut seen: HashMap<Content, usize> = HashMap::new();
    let mut distinct: Vec<(usize, &Mesh)> = Vec::new();
    let places: Vec<usize> = meshes
        .iter()
        .enumerate()
        .map(|(first, mesh)| {
            *seen.entry(Content(mesh)).or_insert_with(|| {
                distinct.push((first, mesh));
                distinct.len() - 1
            })
        })
        .collect();
    let made = distinct.into_par_iter().map(|(first, mesh)| {
        cancellation.check()?;
        Ok(work(first, mesh))
    });
    let made: Vec<T> = made.collect::<Result<_, Cancelled>>()?;
    Ok(places.into_iter().map(|place| made[place].clone()).collect())
}

/// A mesh, compared by the bits of its numbers. Its hash is that of a few of them: hashing all took longer than comparing
/// the few meshes with an equal hash.
struct Content<'a>(&'a Mesh);

/// Number of vertices that are hashed, or up to twice as many.
const HASHED: usize = 64;

impl Content<'_> {
    fn bits(&self) -> impl Iterator<Item = u64> {
        self.0.vertices.as_flattened().iter().map(|x| x.to_bits())
    }
}

impl PartialEq for Content<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.0.triangles == other.0.triangles && self.bits().eq(other.bits())
    }
}

impl Eq for Content<'_> {}

impl Hash for Content<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Mesh { vertices, triangles } = self.0;
        (vertices.len(), triangles.len()).hash(state);
        for vertex in vertices.iter().step_by((vertices.len() / HASHED).max(1)) {
            vertex.map(f64::to_bits).hash(state);
        }
    }
}
