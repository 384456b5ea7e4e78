//! `urdd_export`: each format is read by a second reader written here, and compared with the URDD.
//! `tests/figures/exports` tests what the target programs read from the files.

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
