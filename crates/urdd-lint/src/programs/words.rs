//! What programs do, in words.

use urdd_findings::programs::{kind, subject};
use urdd_format::report::ProgramResult;
use urdd_programs::Deed;

use super::faults::{Faulty, Said};

/// What is wrong, what programs do, and what to do about it.
pub fn message(faulty: &Faulty, programs: &[ProgramResult]) -> String {
    let Faulty { fault, said, .. } = faulty;
    format!("{fault}: {}; {}", doings(said, programs), fault.advice())
}

/// What programs do: "ROS and Drake refuse the robot; MuJoCo leaves out the limit".
pub fn doings(said: &[Said], programs: &[ProgramResult]) -> String {
    let mut groups: Vec<(Verb, Vec<&Said>)> = Vec::new();
    for one in said {
        let verb = Verb::of(one);
        match groups.iter_mut().find(|(known, _)| *known == verb) {
            Some((_, group)) => group.push(one),
            None => groups.push((verb, vec![one])),
        }
    }
    groups.sort_by_key(|(verb, group)| (std::cmp::Reverse(verb.deed), group[0].program));
    let doing = |(verb, group): &(Verb, Vec<&Said>)| {
        let is_one =
            |result: &ProgramResult| group.iter().any(|said| said.program.id() == result.program);
        let (names, are_many) = subject(programs, is_one);
        format!("{names} {}", verb.words(are_many))
    };
    groups.iter().map(doing).collect::<Vec<_>>().join("; ")
}

/// What a program does.
#[derive(PartialEq)]
struct Verb<'a> {
    deed: Deed,
    part: &'a str,
    makes: Option<&'a str>,
}

impl<'a> Verb<'a> {
    fn of(said: &'a Said) -> Self {
        Verb { deed: said.deed, part: &said.part, makes: said.makes.as_deref() }
    }

    fn words(&self, are_many: bool) -> String {
        let (s, es) = if are_many { ("", "") } else { ("s", "es") };
        match (self.deed, self.makes) {
            (Deed::Refuses, _) => format!("refuse{s} the robot"),
            (Deed::Crashes, _) => format!("crash{es}"),
            (Deed::Drops, _) if kind(self.part) == "?" => format!("ignore{s} it"),
            (Deed::Drops, _) => format!("leave{s} out {}", part(self.part)),
            (Deed::Reads, Some(made)) if !made.is_empty() => format!("read{s} `{made}`"),
            (Deed::Reads, _) => format!("read{s} {} otherwise", part(self.part)),
        }
    }
}

/// A part of a robot: `joint/elbow/limit` is "the limit". Which joint it is, the place says.
fn part(part: &str) -> String {
    format!("the {}", kind(part).replace('_', " "))
}
