//! The validator as a library: valid robots, random faults, documents that only match their schemas, figures from other
//! implementations.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod cancelled;
mod core_rules_random;
mod corpus;
mod distances;
mod distances_plan;
mod extension_schema;
mod kinematics_figures;
mod learned_counts;
mod no_crash;
mod reference;
mod reference_motion;
mod rules_bounds_unlimited_bounds_wrong;
mod rules_chain_quaternion_not_canonical;
mod rules_connections_explicit_paths_missing;
mod rules_connections_walk;
mod rules_dof_dof_count_differs;
mod rules_dof_dof_mappings_disagree;
mod rules_legacy_adjusted_mappings_wrong;
mod rules_meshes_mesh_file_name;
mod rules_meshes_piece_count_mismatch;
mod rules_shapes_needlessly_large_sphere;
mod rules_source_inertia_breaks_triangle;
mod rules_source_inertia_not_positive_definite;
mod rules_source_mimic_leaves_limits;
mod rules_source_moments;
mod rules_urdf_cycle;
mod rules_urdf_parts;
mod rules_urdf_source_differences;
mod rules_urdf_zero_axis;
mod shape_rules_random;
mod solids_apart;
mod solids_cut;
mod solids_dents;
mod solids_glb_chunks;
mod solids_placed;
mod solids_polytope;
mod solids_primitive;
mod solids_stl_records;
mod soundness;
mod undeclared_need;
mod urdf_text;
mod urdf_text_compare;
mod urdf_text_numbers;
mod views_enclosure;
mod views_repeated;
mod views_shape_pair;
mod views_tangled;
