//! Parts of the crate, compared with closed forms and other readers.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod carried;
mod choices;
mod drake;
mod fitted_spheres;
mod gazebo;
mod hostile_names;
mod inertia;
mod invented_names;
mod locked;
mod made;
mod mjcf;
mod mjcf_actuators;
mod mjcf_inertia;
mod mjcf_surface;
mod moveit;
mod names;
mod other_attributes;
mod pairs;
mod pairs_of_formats;
mod robot_file;
mod sdf;
mod setup;
mod setup_words;
mod simplify;
mod source_shapes;
mod spheres;
mod spheres_cover_cell;
mod spheres_cover_filled;
mod spheres_judge;
mod spheres_surface;
mod srdf;
mod srdf_import;
mod srdf_merge;
mod states;
mod textured_box;
mod textures;
mod there_and_back;
mod urdf;
mod usd;
mod usd_input;
mod usd_joints;
mod usd_parts;
mod yaml;
