//! MSH: the mesh modules and the contents of their files.

mod convexity;
pub mod file_paths;
mod formats;
mod hull_of_mesh;
pub mod lists;
mod of_urdf;
mod originals;
mod pieces;

use crate::rule::rules;

rules! {
    convexity, file_paths, formats, hull_of_mesh, lists, of_urdf, originals, pieces
}
