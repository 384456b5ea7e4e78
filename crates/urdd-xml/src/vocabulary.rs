//! The elements and attributes of URDF (SPEC 6.1.8), and those that some programs read beside them.

/// An element: its attributes, and the elements in it.
pub struct Known {
    /// Its name.
    pub name: &'static str,
    /// Its attributes.
    pub attributes: &'static [&'static str],
    /// The elements in it.
    pub children: &'static [&'static str],
    /// Attributes of extensions.
    pub other_attributes: &'static [&'static str],
    /// Elements of extensions; nobody looks into them.
    pub other_children: &'static [&'static str],
}

/// Elements whose content is other programs' matter.
pub const CLOSED: &[&str] = &["transmission", "gazebo", "ros2_control"];

/// A line or two for each element: its name, attributes and children, then those of extensions.
macro_rules! known {
    ($($name:ident [$($attribute:ident)*] [$($child:ident)*]
        $(or [$($other_attribute:ident)*] [$($other_child:ident)*])?;)*) => {
        &[$(Known {
            name: stringify!($name),
            attributes: &[$(stringify!($attribute)),*],
            children: &[$(stringify!($child)),*],
            other_attributes: &[$($(stringify!($other_attribute)),*)?],
            other_children: &[$($(stringify!($other_child)),*)?],
        }),*]
    };
}

/// Every element of URDF.
pub const KNOWN: &[Known] = known! {
    robot [name version] [link joint material transmission gazebo ros2_control]
        or [scale] [sensor mujoco loop_joint force_element frame collision_filter_group group group_state
            disable_collisions passive_joint end_effector virtual_joint model_state property deformable gripper];
    link [name] [inertial visual collision]
        or [type concave] [contact self_collision_checking audio_source sensor gazebo inertia_scaling
            friction_anchor laser_inertia self_collision];
    inertial [] [origin mass inertia];
    visual [name] [origin geometry material] or [concave] [verbose];
    collision [name] [origin geometry]
        or [concave group mask] [verbose contact_coefficients surface contact material];
    geometry [] [mesh box cylinder capsule sphere]
        or [] [plane cdf sdf ellipsoid superellipsoid cone heightmap convex empty];
    material [name] [color texture] or [] [specular ambient emissive shininess script diffuse];
    joint [name type] [origin parent child axis limit dynamics mimic safety_controller calibration]
        or [] [transmission gazebo sensor hardware drive];
    origin [xyz rpy quat_xyzw] [];
    mass [value] [];
    // The other half of the same tensor.
    inertia [ixx ixy ixz iyy iyz izz] [] or [iyx izx izy] [];
    color [rgba] [];
    texture [filename] [];
    parent [link] [];
    child [link] [];
    axis [xyz] [];
    limit [lower upper effort velocity acceleration deceleration jerk] [] or [k_velocity k_position] [];
    dynamics [damping friction] []
        or [coulomb_window coulomb stiffness rotor_inertia armature spring_reference spring_stiffness] [];
    mimic [joint multiplier offset] [];
    safety_controller [soft_lower_limit soft_upper_limit k_position k_velocity] [];
    calibration [rising falling] [] or [reference_position] [];
    mesh [filename scale] [] or [convex] [];
    box [size] [];
    cylinder [radius length] [];
    capsule [radius length] [];
    sphere [radius] [];
};

/// The element of a name.
pub fn of(name: &str) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.name == name)
}
