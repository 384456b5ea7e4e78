//! Parts of the crate, compared with closed forms and other readers.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod element;
mod gazebo;
mod inertia;
mod invented_names;
mod locked;
mod made;
mod mjcf_inertia;
mod mjcf_surface;
mod names;
mod other_attributes;
mod pairs;
mod setup_words;
mod simplify;
mod spheres_cover_cell;
mod spheres_cover_filled;
mod spheres_judge;
mod spheres_surface;
mod srdf_merge;
mod textured_box;
mod textures;
mod yaml;
