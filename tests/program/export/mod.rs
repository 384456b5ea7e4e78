//! `urdd_export`: each format read again by a second reader written here, and held to the URDD. What the programs
//! themselves make of the files is held by `tests/figures/exports`.

mod command;
mod drake;
mod fitted_spheres;
mod mjcf;
mod names;
mod pairs;
mod spheres;
mod srdf;
mod srdf_import;
mod urdf;
