//! Names of programs in sentences.

use urdd_format::report::ProgramResult;

/// The names that settings have for programs that read URDFs. A distribution of ROS stands for its urdfdom, `gazebo` for
/// each of its versions.
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
    "fortress",
    "harmonic",
    "jetty",
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
const INSIDE: &str = "inertial visual collision origin geometry material color texture mass inertia com axis limit lower \
    upper effort velocity acceleration deceleration jerk dynamics damping friction mimic calibration safety_controller \
    safety parent child";

fn is_inside(word: &str) -> bool {
    INSIDE.split(' ').any(|known| known == word)
}

/// The kind of a part of a robot: `collision` of `link/arm/collision/0`, `link` of `link/arm/tip`, whose name has a slash,
/// `transmission` of `transmission/wrist_3`; `?` for something that is no part.
pub fn kind(part: &str) -> &str {
    let words: Vec<&str> = part.split('/').collect();
    match words[..] {
        [.., "?"] => "?",
        ["robot" | "", .., last] => last,
        // A link may be called `limit`.
        [kind, _] => kind,
        [.., last] if is_inside(last) => last,
        [.., of @ ("visual" | "collision"), _] => of,
        [first, ..] => first,
        [] => part,
    }
}

/// The link, joint or material that a part is of: `arm` of `link/arm/visual/0`.
pub fn owner(part: &str) -> &str {
    let mut owner = part.split_once('/').map_or(part, |(_, owner)| owner);
    while let Some((above, last)) = owner.rsplit_once('/') {
        let is_shape = ["/visual", "/collision"].iter().any(|shape| above.ends_with(shape));
        let is_index = is_shape && last.bytes().all(|byte| byte.is_ascii_digit());
        if !is_index && !is_inside(last) {
            break;
        }
        owner = above;
    }
    owner
}

/// The names of some of the programs, in their order: of a family once, where all of it is among them. Otherwise the
/// versions of a family share its name: `Gazebo Harmonic` and `Jetty`.
fn names(all: &[ProgramResult], some: impl Fn(&ProgramResult) -> bool) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    let mut last = "";
    for program in all.iter().filter(|program| some(program)) {
        let mut family = all.iter().filter(|other| other.family == program.family);
        let name: &str = if family.all(&some) { &program.family } else { &program.name };
        let version = name.strip_prefix(last).and_then(|rest| rest.strip_prefix(' '));
        let name =
            version.filter(|rest| !last.is_empty() && !rest.starts_with('(')).unwrap_or(name);
        last = &program.family;
        if !names.contains(&name) {
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

#[cfg(test)]
mod tests {
    use super::kind;

    #[test]
    fn a_part_is_of_its_kind_whatever_its_name() {
        for (part, expected) in [
            ("link/arm/collision/0", "collision"),
            ("link/arm/visual/0/material", "material"),
            ("link/arm/tip", "link"),
            ("link/limit", "link"),
            ("joint/elbow/limit", "limit"),
            ("joint/elbow/limit/velocity", "velocity"),
            ("transmission/wrist_3", "transmission"),
            ("transmission/arm/wrist_3", "transmission"),
            ("robot/gazebo", "gazebo"),
            ("robot/transmission/?", "?"),
            ("robot", "robot"),
        ] {
            assert_eq!(kind(part), expected, "{part}");
        }
    }
}
