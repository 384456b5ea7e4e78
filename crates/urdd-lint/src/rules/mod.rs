//! LNT: what is odd about a URDF, rules about one thing in a file.

mod checked_in_urdf_is_stale;
mod default_configuration;
mod files;
mod frames;
mod limits;
#[doc(hidden)]
pub mod mass_beyond_shapes;
mod masses;
mod names;
pub mod prelude;
mod shapes;
mod srdfs;
mod whole_file;

use prelude::rules;

rules! {
    checked_in_urdf_is_stale, default_configuration, files, frames, limits, mass_beyond_shapes,
    masses, names, shapes, srdfs, whole_file,
}
