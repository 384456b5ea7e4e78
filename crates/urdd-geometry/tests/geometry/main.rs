//! Geometry, held to closed forms, to brute force and to properties. Figures by peers on real meshes
//! are made by the scripts in `tests/figures/geometry`.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod across;
mod bounding_sphere;
mod brute_force;
mod decompose;
mod decomposed_shapes;
mod dice;
mod distance;
mod hull;
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
mod solids;
mod statistics;
