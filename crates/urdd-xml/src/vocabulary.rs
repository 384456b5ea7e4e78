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

const fn known(
    name: &'static str,
    attributes: &'static [&'static str],
    children: &'static [&'static str],
) -> Known {
    Known { name, attributes, children, other_attributes: &[], other_children: &[] }
}

/// Every element of URDF.
pub const KNOWN: &[Known] = &[
    Known {
        other_attributes: &["scale"],
        other_children: &[
            "sensor",
            "mujoco",
            "loop_joint",
            "force_element",
            "frame",
            "collision_filter_group",
            "group",
            "group_state",
            "disable_collisions",
            "passive_joint",
            "end_effector",
            "virtual_joint",
            "model_state",
            "property",
            "deformable",
            "gripper",
        ],
        ..known(
            "robot",
            &["name", "version"],
            &["link", "joint", "material", "transmission", "gazebo", "ros2_control"],
        )
    },
    Known {
        other_attributes: &["type", "concave"],
        other_children: &[
            "contact",
            "self_collision_checking",
            "audio_source",
            "sensor",
            "gazebo",
            "inertia_scaling",
            "friction_anchor",
            "laser_inertia",
            "self_collision",
        ],
        ..known("link", &["name"], &["inertial", "visual", "collision"])
    },
    known("inertial", &[], &["origin", "mass", "inertia"]),
    Known {
        other_attributes: &["concave"],
        other_children: &["verbose"],
        ..known("visual", &["name"], &["origin", "geometry", "material"])
    },
    Known {
        other_attributes: &["concave", "group", "mask"],
        other_children: &["verbose", "contact_coefficients", "surface", "contact", "material"],
        ..known("collision", &["name"], &["origin", "geometry"])
    },
    Known {
        other_children: &[
            "plane",
            "cdf",
            "sdf",
            "ellipsoid",
            "superellipsoid",
            "cone",
            "heightmap",
            "convex",
            "empty",
        ],
        ..known("geometry", &[], &["mesh", "box", "cylinder", "capsule", "sphere"])
    },
    Known {
        other_children: &["specular", "ambient", "emissive", "shininess", "script", "diffuse"],
        ..known("material", &["name"], &["color", "texture"])
    },
    Known {
        other_children: &["transmission", "gazebo", "sensor", "hardware", "drive"],
        ..known(
            "joint",
            &["name", "type"],
            &[
                "origin",
                "parent",
                "child",
                "axis",
                "limit",
                "dynamics",
                "mimic",
                "safety_controller",
                "calibration",
            ],
        )
    },
    known("origin", &["xyz", "rpy", "quat_xyzw"], &[]),
    known("mass", &["value"], &[]),
    Known {
        // The other half of the same tensor.
        other_attributes: &["iyx", "izx", "izy"],
        ..known("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"], &[])
    },
    known("color", &["rgba"], &[]),
    known("texture", &["filename"], &[]),
    known("parent", &["link"], &[]),
    known("child", &["link"], &[]),
    known("axis", &["xyz"], &[]),
    Known {
        other_attributes: &["k_velocity", "k_position"],
        ..known(
            "limit",
            &["lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"],
            &[],
        )
    },
    Known {
        other_attributes: &[
            "coulomb_window",
            "coulomb",
            "stiffness",
            "rotor_inertia",
            "armature",
            "spring_reference",
            "spring_stiffness",
        ],
        ..known("dynamics", &["damping", "friction"], &[])
    },
    known("mimic", &["joint", "multiplier", "offset"], &[]),
    known(
        "safety_controller",
        &["soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"],
        &[],
    ),
    Known {
        other_attributes: &["reference_position"],
        ..known("calibration", &["rising", "falling"], &[])
    },
    Known { other_attributes: &["convex"], ..known("mesh", &["filename", "scale"], &[]) },
    known("box", &["size"], &[]),
    known("cylinder", &["radius", "length"], &[]),
    known("capsule", &["radius", "length"], &[]),
    known("sphere", &["radius"], &[]),
];

/// The element of a name.
pub fn of(name: &str) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.name == name)
}
