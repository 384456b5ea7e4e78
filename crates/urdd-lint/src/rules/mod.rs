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
mod gazebo_reference_unknown;
mod heavy_collision_mesh;
mod inertia_beyond_geometry;
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
mod odd_density;
mod package_not_found;
mod root_link_with_inertial;
mod ros2_control_unknown_joint;
mod same_default_inertia;
mod self_collision_in_default;
mod size_not_positive;
mod srdf_unknown_name;
mod stl_refused;
mod texture_missing;
mod transmission_unknown_joint;
mod unknown_element_or_attribute;
mod visual_and_collision_apart;
mod visual_without_collision;
mod xacro_not_expanded;
mod zero_outside_limits;

use crate::rule::LintRule;

/// Every rule, in the order of their codes.
pub fn all() -> Vec<&'static LintRule> {
    let mut rules = vec![
        &absolute_path::RULE,
        &absurd_velocity_or_effort::RULE,
        &angle_looks_like_degrees::RULE,
        &axis_missing::RULE,
        &axis_not_unit::RULE,
        &backslash_in_path::RULE,
        &center_of_mass_outside::RULE,
        &collada_unit::RULE,
        &collada_up_axis::RULE,
        &color_out_of_range::RULE,
        &continuous_with_limits::RULE,
        &gazebo_reference_unknown::RULE,
        &heavy_collision_mesh::RULE,
        &inertia_beyond_geometry::RULE,
        &inertia_far_below_geometry::RULE,
        &inertial_incomplete::RULE,
        &letter_case::RULE,
        &limit_incomplete::RULE,
        &limits_look_like_degrees::RULE,
        &material_not_defined::RULE,
        &mesh_in_millimetres::RULE,
        &mesh_names_clash::RULE,
        &mesh_not_found::RULE,
        &mesh_not_readable::RULE,
        &mirrored_scale::RULE,
        &misplaced::RULE,
        &misspelt::RULE,
        &moving_link_without_inertial::RULE,
        &name_refused::RULE,
        &odd_density::RULE,
        &package_not_found::RULE,
        &root_link_with_inertial::RULE,
        &ros2_control_unknown_joint::RULE,
        &same_default_inertia::RULE,
        &self_collision_in_default::RULE,
        &size_not_positive::RULE,
        &srdf_unknown_name::RULE,
        &stl_refused::RULE,
        &texture_missing::RULE,
        &transmission_unknown_joint::RULE,
        &unknown_element_or_attribute::RULE,
        &visual_and_collision_apart::RULE,
        &visual_without_collision::RULE,
        &xacro_not_expanded::RULE,
        &zero_outside_limits::RULE,
    ];
    rules.sort_by_key(|rule| rule.description.code);
    rules
}
