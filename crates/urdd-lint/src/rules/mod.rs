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
        absolute_path::Declared::RULE,
        absurd_velocity_or_effort::Declared::RULE,
        angle_looks_like_degrees::Declared::RULE,
        axis_missing::Declared::RULE,
        axis_not_unit::Declared::RULE,
        backslash_in_path::Declared::RULE,
        center_of_mass_outside::Declared::RULE,
        collada_unit::Declared::RULE,
        collada_up_axis::Declared::RULE,
        color_out_of_range::Declared::RULE,
        continuous_with_limits::Declared::RULE,
        gazebo_reference_unknown::Declared::RULE,
        heavy_collision_mesh::Declared::RULE,
        inertia_beyond_geometry::Declared::RULE,
        inertia_far_below_geometry::Declared::RULE,
        inertial_incomplete::Declared::RULE,
        letter_case::Declared::RULE,
        limit_incomplete::Declared::RULE,
        limits_look_like_degrees::Declared::RULE,
        material_not_defined::Declared::RULE,
        mesh_in_millimetres::Declared::RULE,
        mesh_names_clash::Declared::RULE,
        mesh_not_found::Declared::RULE,
        mesh_not_readable::Declared::RULE,
        mirrored_scale::Declared::RULE,
        misplaced::Declared::RULE,
        misspelt::Declared::RULE,
        moving_link_without_inertial::Declared::RULE,
        name_refused::Declared::RULE,
        odd_density::Declared::RULE,
        package_not_found::Declared::RULE,
        root_link_with_inertial::Declared::RULE,
        ros2_control_unknown_joint::Declared::RULE,
        same_default_inertia::Declared::RULE,
        self_collision_in_default::Declared::RULE,
        size_not_positive::Declared::RULE,
        srdf_unknown_name::Declared::RULE,
        stl_refused::Declared::RULE,
        texture_missing::Declared::RULE,
        transmission_unknown_joint::Declared::RULE,
        unknown_element_or_attribute::Declared::RULE,
        visual_and_collision_apart::Declared::RULE,
        visual_without_collision::Declared::RULE,
        xacro_not_expanded::Declared::RULE,
        zero_outside_limits::Declared::RULE,
    ];
    rules.sort_by_key(|rule| rule.description.code);
    rules
}
