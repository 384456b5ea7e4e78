//! Parts of the crate, compared with closed forms and other readers.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod cancelled;
mod connections;
mod distinct;
mod free;
mod in_memory;
mod loops;
mod loops_left_out;
mod meshes_names;
mod shape_documents;
mod shapes_rounding;
mod spheres;
