//! LNT: what is odd about a URDF, one rule a file.

use crate::rule::LintRule;

macro_rules! rules {
    ($($rule:ident)*) => {
        $(mod $rule;)*

        /// Every rule, in the order of their codes.
        pub fn all() -> Vec<&'static LintRule> {
            let mut rules = vec![$(&$rule::RULE),*];
            rules.sort_by_key(|rule| rule.description.code);
            rules
        }
    };
}

rules! {
    absolute_path
    absurd_velocity_or_effort
    angle_looks_like_degrees
    axis_missing
    axis_not_unit
    backslash_in_path
    center_of_mass_outside
    collada_unit
    collada_up_axis
    color_out_of_range
    continuous_with_limits
    gazebo_reference_unknown
    heavy_collision_mesh
    inertia_beyond_geometry
    inertia_far_below_geometry
    inertial_incomplete
    letter_case
    limit_incomplete
    limits_look_like_degrees
    material_not_defined
    mesh_in_millimetres
    mesh_names_clash
    mesh_not_found
    mesh_not_readable
    mirrored_scale
    misplaced
    misspelt
    moving_link_without_inertial
    name_refused
    odd_density
    package_not_found
    root_link_with_inertial
    ros2_control_unknown_joint
    same_default_inertia
    self_collision_in_default
    size_not_positive
    srdf_unknown_name
    stl_refused
    texture_missing
    transmission_unknown_joint
    unknown_element_or_attribute
    visual_and_collision_apart
    visual_without_collision
    xacro_not_expanded
    zero_outside_limits
}
