//! LNT: what is odd about a URDF, one rule a file.

mod absolute_path;
mod absurd_velocity_or_effort;
mod angle_looks_like_degrees;
mod axis_missing;
mod axis_not_unit;
mod backslash_in_path;
mod center_of_mass_outside;
mod collada_unit;
mod collada_up_axis;
mod color_out_of_range;
mod continuous_with_limits;
mod effort_too_small;
mod gazebo_reference_unknown;
mod heavy_collision_mesh;
#[doc(hidden)]
pub mod inertia_beyond_geometry;
mod inertia_far_below_geometry;
mod inertial_incomplete;
mod letter_case;
mod limit_incomplete;
mod limits_look_like_degrees;
mod material_not_defined;
mod mesh_in_millimetres;
mod mesh_names_clash;
mod mesh_not_found;
mod mesh_not_readable;
mod mirrored_scale;
mod misplaced;
mod misspelt;
mod moving_link_without_inertial;
mod name_refused;
mod needs_arguments;
mod not_read_as_written;
mod odd_density;
mod origin_in_millimetres;
mod package_not_found;
mod prelude;
mod refused_by_programs;
mod root_link_with_inertial;
mod ros2_control_unknown_joint;
mod same_default_inertia;
mod self_collision_in_default;
mod size_not_positive;
mod srdf_not_read;
mod srdf_unknown_name;
mod stl_refused;
mod texture_missing;
mod transmission_unknown_joint;
mod unknown_element_or_attribute;
mod visual_and_collision_apart;
mod visual_without_collision;
mod xacro_not_expanded;
mod zero_outside_limits;

use crate::rule::rules;

rules! {
    absolute_path, absurd_velocity_or_effort, angle_looks_like_degrees, axis_missing,
    axis_not_unit, backslash_in_path, center_of_mass_outside, collada_unit, collada_up_axis,
    color_out_of_range, continuous_with_limits, effort_too_small, gazebo_reference_unknown, heavy_collision_mesh,
    inertia_beyond_geometry, inertia_far_below_geometry, inertial_incomplete, letter_case,
    limit_incomplete, limits_look_like_degrees, material_not_defined, mesh_in_millimetres,
    mesh_names_clash, mesh_not_found, mesh_not_readable, mirrored_scale, misplaced, misspelt,
    moving_link_without_inertial, name_refused, needs_arguments, not_read_as_written, odd_density,
    origin_in_millimetres, package_not_found, refused_by_programs, root_link_with_inertial,
    ros2_control_unknown_joint, same_default_inertia, self_collision_in_default, size_not_positive,
    srdf_not_read, srdf_unknown_name, stl_refused,
    texture_missing, transmission_unknown_joint, unknown_element_or_attribute,
    visual_and_collision_apart, visual_without_collision, xacro_not_expanded,
    zero_outside_limits,
}
