//! What programs do with a URDF, in sentences and as a line: ``ROS refuses it (LNT060 at 28:5) · MuJoCo loads it
//! without the mimic of `tip` ``.

use std::collections::BTreeMap;

use crate::check::Examined;
use crate::run;
use urdd_format::readable::counted;
use urdd_format::report::{
    Deed, Does, Place, ProgramEffect, ProgramResult, Report, Severity, Urdd,
};

pub use crate::settings::NAMES;

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

/// What MuJoCo and three.js never have.
const SHAPES: [&str; 2] = ["visual", "collision"];

/// Maximum number of names of a kind in a line; the rest are counted.
const NAMED: usize = 3;

/// What each program does with an examined URDF, as the report for people says it: those of the settings and the worst
/// first, programs that do the same in one line.
pub fn lines(examined: Examined) -> Vec<String> {
    let urdd = run::urdd(examined, Severity::Error);
    describe(&urdd).into_iter().map(|(_, line)| line).collect()
}

/// What each program does, those of the settings and the worst first; programs that do the same once.
pub(super) fn describe(urdd: &Urdd) -> Vec<(Option<Deed>, String)> {
    type Group = (bool, Option<Deed>, Outcome);
    let group = |program: &ProgramResult| -> Group {
        (program.is_chosen, program.does, outcome(urdd, program))
    };
    let mut groups: Vec<(Group, Vec<&str>)> = Vec::new();
    for program in &urdd.programs {
        let group = group(program);
        match groups.iter_mut().find(|(known, _)| *known == group) {
            Some((_, programs)) => programs.push(&program.program),
            None => groups.push((group, vec![&program.program])),
        }
    }
    groups.sort_by_key(|((is_chosen, does, _), _)| (!is_chosen, std::cmp::Reverse(*does)));
    let describe = |((_, does, outcome), programs): &(Group, Vec<&str>)| {
        let is_one = |program: &ProgramResult| programs.contains(&program.program.as_str());
        let (names, are_many) = subject(&urdd.programs, is_one);
        (*does, format!("{names} {}", outcome.words(are_many)))
    };
    groups.iter().map(describe).collect()
}

/// What a program does with a URDF, in a few words behind a mark; empty where it was not asked, or only does what is usual.
pub(super) fn cell(urdd: &Urdd, program: &str) -> (&'static str, String) {
    let Some(program) = urdd.programs.iter().find(|one| one.program == program) else {
        return ("", String::new());
    };
    match (program.does, outcome(urdd, program)) {
        (None, _) => ("loads", String::new()),
        (_, Outcome::Refused(Deed::Crashes, why)) => ("**crashes**", why),
        (_, Outcome::Refused(_, why)) => ("**refuses**", why),
        (_, Outcome::Loaded(lost, others)) => ("loads", losses(&lost, others).join(", ")),
    }
}

/// How many of many URDFs each program loads, reads otherwise and refuses.
pub(super) fn counts(report: &Report) -> Vec<(&str, [usize; 3])> {
    let mut counts: Vec<(&str, [usize; 3])> = Vec::new();
    for program in report.urdds.iter().flat_map(|urdd| &urdd.programs) {
        let which = match program.does {
            None => 0,
            Some(Deed::Reads | Deed::Drops) => 1,
            Some(Deed::Refuses | Deed::Crashes) => 2,
        };
        match counts.iter_mut().find(|(name, _)| *name == program.name) {
            Some((_, counts)) => counts[which] += 1,
            None => {
                let mut first = [0; 3];
                first[which] = 1;
                counts.push((&program.name, first));
            }
        }
    }
    counts
}

/// Why a program refuses most of those URDFs that it refuses although no finding says so, and how many.
pub(super) fn unsaid<'r>(report: &'r Report, name: &str) -> Option<(&'r str, usize)> {
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for urdd in &report.urdds {
        let program = urdd.programs.iter().find(|program| program.name == name);
        let refusing = program.filter(|one| one.does >= Some(Deed::Refuses));
        let Some(program) = refusing else { continue };
        if let Cause::Effect(effect) = causes(urdd, program).0 {
            *reasons.entry(&effect.reason).or_default() += 1;
        }
    }
    reasons.into_iter().max_by_key(|(_, count)| *count)
}

/// What becomes of a file in a program.
#[derive(PartialEq)]
enum Outcome {
    /// There is no robot: how, and where it is said why.
    Refused(Deed, String),
    /// There is one, without parts of each kind, and with so many values otherwise; and so much that the report left out.
    Loaded(BTreeMap<String, Lost>, [usize; 2]),
}

/// Parts of a kind that are lost.
#[derive(PartialEq, Default)]
struct Lost {
    count: usize,
    /// Their names, or those of what they are in, in the order of the file. Shapes that a program never has are not named.
    names: Vec<String>,
    is_inside: bool,
}

fn outcome(urdd: &Urdd, program: &ProgramResult) -> Outcome {
    match program.does {
        Some(deed @ (Deed::Refuses | Deed::Crashes)) => Outcome::Refused(deed, why(urdd, program)),
        _ => loaded(program),
    }
}

/// Why a program refuses a file.
enum Cause<'u> {
    Finding(&'u str, &'u Place),
    /// No finding says it.
    Effect(&'u ProgramEffect),
    Unknown,
}

/// Why a program refuses a file, and a finding for which it would refuse it once that is mended.
fn causes<'u>(
    urdd: &'u Urdd,
    program: &'u ProgramResult,
) -> (Cause<'u>, Option<(&'u str, &'u Place)>) {
    // What follows from a finding is among its related places.
    let places = urdd.findings.iter().flat_map(|finding| {
        let all = finding.places.iter().flat_map(|place| [place].into_iter().chain(&place.related));
        all.map(move |place| (finding.code.as_str(), place))
    });
    let finding = |is_supposed: bool| {
        let is_why = |does: &Does| {
            let is_its = does.program == program.program && does.is_supposed == is_supposed;
            is_its && does.does >= Deed::Refuses
        };
        places.clone().find(|(_, place)| place.programs.iter().any(is_why))
    };
    let (first, next) = (finding(false), finding(true));
    let is_first = |effect: &&ProgramEffect| effect.does >= Deed::Refuses && !effect.is_supposed;
    let effect = || program.effects.iter().find(is_first);
    let cause = match first {
        Some((code, place)) => Cause::Finding(code, place),
        None => effect().map_or(Cause::Unknown, Cause::Effect),
    };
    (cause, next)
}

/// The finding of it; where there is none, what the program says. And what would be next.
fn why(urdd: &Urdd, program: &ProgramResult) -> String {
    let of_finding = |code: &str, place: &Place| {
        let at = place.line.zip(place.column);
        // A file that the robot's own includes has a name.
        let own = urdd.path.rsplit('/').next();
        let other = place.file.as_deref().filter(|file| own != Some(*file));
        let file = other.map(|file| format!("{file}:")).unwrap_or_default();
        at.map_or_else(
            || code.to_owned(),
            |(line, column)| format!("{code} at {file}{line}:{column}"),
        )
    };
    let (cause, next) = causes(urdd, program);
    let mut why = match cause {
        Cause::Finding(code, place) => of_finding(code, place),
        Cause::Effect(effect) => match effect.line.zip(effect.column) {
            Some((line, column)) => format!("{} at {line}:{column}", effect.reason),
            None => effect.reason.clone(),
        },
        Cause::Unknown => String::new(),
    };
    if let Some((code, place)) = next {
        why += &format!("; with that mended, {}", of_finding(code, place));
    }
    why
}

fn loaded(program: &ProgramResult) -> Outcome {
    let mut lost: BTreeMap<String, Lost> = BTreeMap::new();
    let mut others = 0;
    for effect in &program.effects {
        let part = effect.part.as_deref().filter(|part| kind(part) != "?");
        match (effect.does, part) {
            (Deed::Drops, Some(part)) => {
                let (kind, name) = (kind(part), owner(part));
                let lost = lost.entry(kind.to_owned()).or_default();
                lost.count += 1;
                lost.is_inside |= !part.starts_with(kind);
                let is_named = name != kind && !(effect.is_usual && SHAPES.contains(&kind));
                let name = is_named.then(|| name.to_owned());
                lost.names.extend(name.filter(|name| !lost.names.contains(name)));
            }
            _ if effect.is_usual => {}
            _ => others += 1,
        }
    }
    Outcome::Loaded(lost, [others, program.effects_cut.get()])
}

impl Outcome {
    fn words(&self, are_many: bool) -> String {
        let s = if are_many { "" } else { "s" };
        match self {
            Outcome::Refused(Deed::Crashes, why) => {
                let es = if are_many { "" } else { "es" };
                format!("crash{es} on it ({why})")
            }
            Outcome::Refused(_, why) => format!("refuse{s} it ({why})"),
            Outcome::Loaded(lost, others) => {
                let losses = losses(lost, *others);
                // ``loads it without the limit of `elbow`, 2 values read otherwise``
                let between = if lost.is_empty() { ", " } else { " " };
                let between = if losses.is_empty() { "" } else { between };
                format!("load{s} it{between}{}", losses.join(", "))
            }
        }
    }
}

impl Lost {
    /// ``the joints `a`, `b`, `c` and 2 more``, ``the mimic of `a` ``, `3 visuals`.
    fn words(&self, kind: &str) -> String {
        let words = match kind {
            // One of the limits of a joint, while the others are read.
            "lower" | "upper" | "effort" | "velocity" | "acceleration" | "deceleration"
            | "jerk" => format!("{kind} limit"),
            _ => kind.replace('_', " "),
        };
        if self.names.is_empty() {
            return counted(self.count, &words);
        }
        let s = if self.count > 1 && !words.ends_with('s') { "s" } else { "" };
        let of = if self.is_inside { "of " } else { "" };
        let mut names: Vec<String> =
            self.names.iter().take(NAMED).map(|name| format!("`{name}`")).collect();
        let more = self.names.len().saturating_sub(NAMED);
        names.extend((more > 0).then(|| format!("{more} more")));
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        format!("the {words}{s} {of}{}", listed(&names))
    }
}

/// ``without the joints `a` and `b` ``, and `2 values read otherwise`, as far as they are so.
fn losses(lost: &BTreeMap<String, Lost>, [others, cut]: [usize; 2]) -> Vec<String> {
    let lost: Vec<String> = lost.iter().map(|(kind, lost)| lost.words(kind)).collect();
    let lost: Vec<&str> = lost.iter().map(String::as_str).collect();
    let without = (!lost.is_empty()).then(|| format!("without {}", listed(&lost)));
    let otherwise = (others > 0).then(|| format!("{} read otherwise", counted(others, "value")));
    let more = (cut > 0).then(|| format!("and {cut} more"));
    without.into_iter().chain(otherwise).chain(more).collect()
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
