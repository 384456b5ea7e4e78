//! Names of programs in sentences.

use urdd_format::report::ProgramResult;

/// The names that settings have for programs that read URDFs. A distribution of ROS stands for its urdfdom.
pub const NAMES: &[&str] = &[
    "ros",
    "lyrical",
    "rolling",
    "jazzy",
    "kilted",
    "humble",
    "noetic",
    "iron",
    "gazebo",
    "mujoco",
    "mujoco3.3",
    "pinocchio",
    "drake",
    "pybullet",
    "isaac",
    "newton",
    "three",
];

/// The programs that were asked of which `some` is true, as the subject of a sentence, and whether its verb is a plural.
pub fn subject(all: &[ProgramResult], some: impl Fn(&ProgramResult) -> bool) -> (String, bool) {
    let names = names(all, some);
    // `Isaac and Newton` are two.
    let are_many = names.len() > 1 || names.iter().any(|name| name.contains(" and "));
    (listed(&names), are_many)
}

/// What parts of links and joints have below their names: elements of URDF, and what readers name besides.
const INSIDE: &[&str] = &[
    "inertial",
    "visual",
    "collision",
    "origin",
    "geometry",
    "material",
    "color",
    "texture",
    "mass",
    "inertia",
    "com",
    "axis",
    "limit",
    "lower",
    "upper",
    "effort",
    "velocity",
    "dynamics",
    "damping",
    "friction",
    "mimic",
    "calibration",
    "safety_controller",
    "safety",
    "parent",
    "child",
];

/// The kind of a part of a robot: `collision` of `link/arm/collision/0`, `link` of `link/arm/tip`, whose name has a slash;
/// `?` for something that is no part.
pub fn kind(part: &str) -> &str {
    let mut words = part.split('/').rev();
    let last = words.next().unwrap_or_default();
    let above = words.next().filter(|above| matches!(*above, "visual" | "collision"));
    let first = part.split('/').next().unwrap_or_default();
    match above {
        _ if last == "?" || INSIDE.contains(&last) => last,
        Some(above) => above,
        None if matches!(first, "link" | "joint" | "material") => first,
        None => last,
    }
}

/// The names of some of the programs, in their order: of a family once, where all of it is among them.
fn names(all: &[ProgramResult], some: impl Fn(&ProgramResult) -> bool) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for program in all.iter().filter(|program| some(program)) {
        let mut family = all.iter().filter(|other| other.family == program.family);
        let name = if family.all(&some) { &program.family } else { &program.name };
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names
}

/// `A, B and C`.
pub fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}
