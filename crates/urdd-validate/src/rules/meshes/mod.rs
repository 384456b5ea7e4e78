//! MSH: the mesh modules and the contents of their files.

mod convexity;
pub mod file_paths;
mod formats;
mod hull_of_mesh;
pub mod lists;
mod made_of;
mod mesh_format_mismatch;
mod of_urdf;
mod originals;
mod outreach;
mod pieces_leave_surface;

use crate::rule::rules;

rules! {
    convexity, file_paths, formats, hull_of_mesh, lists, made_of, mesh_format_mismatch, of_urdf,
    originals, outreach, pieces_leave_surface
}
