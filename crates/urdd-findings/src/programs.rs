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

/// The names of some of the programs that were asked, in their order: of a family once, where all of it is among them.
pub fn names(all: &[ProgramResult], some: impl Fn(&ProgramResult) -> bool) -> Vec<&str> {
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
