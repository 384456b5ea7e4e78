//! The elements of a URDF, with their attributes and what they contain.

/// An element.
pub struct Word {
    /// The element that contains it; empty for any.
    pub parent: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Its attributes.
    pub attributes: &'static [&'static str],
    /// What it contains.
    pub children: &'static [&'static str],
}

const fn word(
    parent: &'static str,
    name: &'static str,
    attributes: &'static [&'static str],
    children: &'static [&'static str],
) -> Word {
    Word {
        parent,
        name,
        attributes,
        children,
    }
}

const SHAPES: &[&str] = &["mesh", "box", "cylinder", "sphere", "capsule"];

/// The elements. Where two have the same name, the one with the right parent counts.
const WORDS: &[Word] = &[
    word(
        "",
        "robot",
        &["name", "version", "xmlns:xacro"],
        &[
            "link",
            "joint",
            "material",
            "transmission",
            "gazebo",
            "ros2_control",
        ],
    ),
    word(
        "robot",
        "link",
        &["name"],
        &["inertial", "visual", "collision"],
    ),
    word("link", "inertial", &[], &["origin", "mass", "inertia"]),
    word(
        "link",
        "visual",
        &["name"],
        &["origin", "geometry", "material"],
    ),
    word("link", "collision", &["name"], &["origin", "geometry"]),
    word("", "origin", &["xyz", "rpy", "quat_xyzw"], &[]),
    word("", "mass", &["value"], &[]),
    word(
        "",
        "inertia",
        &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"],
        &[],
    ),
    word("", "geometry", &[], SHAPES),
    word("", "mesh", &["filename", "scale"], &[]),
    word("", "box", &["size"], &[]),
    word("", "cylinder", &["radius", "length"], &[]),
    word("", "capsule", &["radius", "length"], &[]),
    word("", "sphere", &["radius"], &[]),
    word("", "material", &["name"], &["color", "texture"]),
    word("", "color", &["rgba"], &[]),
    word("", "texture", &["filename"], &[]),
    word("transmission", "joint", &["name"], &["hardwareInterface"]),
    word(
        "ros2_control",
        "joint",
        &["name"],
        &["command_interface", "state_interface", "param"],
    ),
    word(
        "",
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
    ),
    word("", "parent", &["link"], &[]),
    word("", "child", &["link"], &[]),
    word("", "axis", &["xyz"], &[]),
    word("", "limit", &["lower", "upper", "effort", "velocity"], &[]),
    word("", "dynamics", &["damping", "friction"], &[]),
    word("", "mimic", &["joint", "multiplier", "offset"], &[]),
    word(
        "",
        "safety_controller",
        &[
            "soft_lower_limit",
            "soft_upper_limit",
            "k_position",
            "k_velocity",
        ],
        &[],
    ),
    word("", "calibration", &["rising", "falling"], &[]),
    word(
        "",
        "transmission",
        &["name"],
        &["type", "joint", "actuator"],
    ),
    word(
        "",
        "actuator",
        &["name"],
        &["hardwareInterface", "mechanicalReduction"],
    ),
    word("", "gazebo", &["reference"], &[]),
    word(
        "",
        "ros2_control",
        &["name", "type"],
        &["hardware", "joint", "sensor", "gpio"],
    ),
];

/// The types of joints.
pub const JOINT_TYPES: &[&str] = &[
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "spherical",
];

/// The element of a name in another element.
pub fn find(parent: &str, name: &str) -> Option<&'static Word> {
    let named = || WORDS.iter().filter(|word| word.name == name);
    let in_parent = named().find(|word| word.parent == parent);
    in_parent.or_else(|| {
        named()
            .find(|word| word.parent.is_empty() || word.parent == "robot" || word.parent == "link")
    })
}
