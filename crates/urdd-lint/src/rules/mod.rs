//! LNT: what is odd about a URDF, rules about one thing in a file.

mod axes;
mod center_of_mass_outside;
mod closed_chain;
mod continuous_with_limits;
mod densities;
mod effort_too_small;
#[doc(hidden)]
pub mod inertia_beyond_geometry;
mod inertials;
mod limits;
mod meshes;
mod missing_files;
mod name_refused;
mod of_programs;
mod origins;
mod paths;
mod prelude;
mod references;
mod self_collision_in_default;
mod shapes;
mod srdf_not_read;
mod srdf_unknown_name;
mod unknown_names;
mod xacro;

use crate::rule::rules;

rules! {
    axes, center_of_mass_outside, closed_chain, continuous_with_limits, densities,
    effort_too_small, inertia_beyond_geometry, inertials, limits, meshes, missing_files,
    name_refused, of_programs, origins, paths, references, self_collision_in_default, shapes,
    srdf_not_read, srdf_unknown_name, unknown_names, xacro,
}
