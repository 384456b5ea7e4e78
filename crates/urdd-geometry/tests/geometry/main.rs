//! Geometry, compared with closed forms, brute force and properties. The scripts in `tests/figures/geometry` generate
//! figures with other implementations on real meshes.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod across;
mod bounding_sphere;
mod brute_force;
mod decompose;
mod decomposed_shapes;
mod dice;
mod distance;
mod hull;
mod instruction_sets;
#[path = "../../src/tests/levels.rs"]
mod levels;
mod mesh_operations;
mod mesh_primitives;
mod mesh_read_collada;
mod mesh_read_gltf;
mod mesh_read_hostile;
mod mesh_read_obj;
mod mesh_read_stl;
mod mesh_write;
mod often;
mod oriented_box;
mod parry;
mod penetration;
mod solids;
mod statistics;
mod surface;
