//! What programs say, by the fault that they say it of; how bad that is, and in words.

use std::collections::{BTreeMap, HashSet};

use urdd_findings::code::Code;
use urdd_findings::finding::Finding;
use urdd_findings::programs::{kind, subject};
use urdd_format::report::{Consequence, Does, Fix, ProgramResult, Severity};
use urdd_programs::{Deed, Effect, Effects, Fault, Program};

/// What a program does with a file.
pub struct Answer {
    pub program: Program,
    /// Whether the settings name it.
    pub is_chosen: bool,
    pub effects: Effects,
}

/// A fault, by all programs that do something because of it.
#[derive(Debug, Clone)]
pub struct Faulty {
    /// Where it is: the first byte of the element or attribute in the text.
    pub at: usize,
    /// What is wrong, as the program has it that does the worst.
    pub fault: Fault,
    /// What programs do.
    pub said: Vec<Said>,
}

/// What a program does because of a fault.
#[derive(Debug, Clone)]
pub struct Said {
    pub program: Program,
    /// Whether the settings name it.
    pub is_chosen: bool,
    pub effect: Effect,
}

/// A fault that no other rule finds, as LNT060 and LNT061 report it.
#[derive(Debug, Clone)]
pub struct Left {
    /// LNT060, or LNT061 if every program has the robot nevertheless.
    pub code: Code,
    /// Where it is in the text.
    pub offset: usize,
    pub message: String,
    pub severity: Severity,
    /// What it leads to, if that is not what the rule says.
    pub consequence: Option<Consequence>,
    pub programs: Vec<Does>,
    pub fix: Option<Fix>,
}

/// The faults of a file, in order of place. What a program does with every robot is none. All that is wrong with an attribute
/// is one fault.
pub fn faults(answers: Vec<Answer>, text: &str) -> Vec<Faulty> {
    let refusing = answers.iter().filter(|answer| !answer.effects.loads());
    let refusing: Vec<Program> = refusing.map(|answer| answer.program).collect();
    let mut by_place: BTreeMap<usize, Vec<Faulty>> = BTreeMap::new();
    for Answer { program, is_chosen, effects } in answers {
        for effect in effects.0.into_iter().filter(|effect| effect.fault.is_of_robot()) {
            let (at, fault) = (effect.at, effect.fault.clone());
            let is_attribute = text.as_bytes().get(at).is_some_and(|byte| *byte != b'<');
            let here = by_place.entry(at).or_default();
            let new = Faulty { at, fault, said: vec![Said { program, is_chosen, effect }] };
            let is_same = |one: &&mut Faulty| is_attribute || one.fault.is_alike(&new.fault);
            match here.iter_mut().find(is_same) {
                Some(known) => known.add(new),
                None => here.push(new),
            }
        }
    }
    // What a program loses of a robot that it does not have says nothing.
    let is_something = |faulty: &Faulty| {
        let mut said = faulty.said.iter();
        said.any(|said| said.is_refused() || !refusing.contains(&said.program))
    };
    by_place.into_values().flatten().filter(is_something).collect()
}

impl Left {
    /// A finding of LNT060 or LNT061 with what it says besides the message.
    pub fn reported(&self, mut finding: Finding) -> Finding {
        finding.severity = Some(self.severity);
        finding.consequence = self.consequence;
        finding.place.programs.clone_from(&self.programs);
        finding.fix(self.fix.clone())
    }
}

impl Faulty {
    /// The worst that a program does because of it.
    fn worst(&self) -> Option<Deed> {
        self.said.iter().map(|said| said.effect.deed).max()
    }

    /// The rule that reports it, if no other one does.
    pub fn code(&self) -> Code {
        if self.said.iter().any(Said::is_refused) { Code::LNT060 } else { Code::LNT061 }
    }

    /// Whether colours and textures are all that programs lose or read otherwise.
    pub fn is_of_looks(&self) -> bool {
        let is_look = |part: &str| part.starts_with("material/") || part.ends_with("/material");
        self.said.iter().all(|said| is_look(&said.effect.part))
    }

    /// Adds what programs do because of the same fault. Of each program, the worst counts.
    pub fn add(&mut self, other: Faulty) {
        if self.worst() < other.worst() {
            (self.at, self.fault) = (other.at, other.fault);
        }
        for said in other.said {
            match self.said.iter_mut().find(|known| known.program == said.program) {
                Some(known) if known.effect.deed < said.effect.deed => *known = said,
                Some(_) => {}
                None => self.said.push(said),
            }
        }
    }

    /// How bad it is. Where the settings name programs (`has_chosen`): an error if one of these refuses the file, a warning
    /// if one reads it otherwise, an information if only others do. Else an error if ROS or two of the others refuse it, or a
    /// warning.
    pub fn severity(&self, has_chosen: bool) -> Severity {
        if !has_chosen {
            let refusing = self.said.iter().filter(|one| one.is_refused());
            let families: HashSet<&str> = refusing.map(|one| one.program.family()).collect();
            let is_error = families.contains("ROS") || families.len() > 1;
            return if is_error { Severity::Error } else { Severity::Warning };
        }
        let mut chosen = self.said.iter().filter(|one| one.is_chosen).peekable();
        match (chosen.peek().is_some(), chosen.any(Said::is_refused)) {
            (_, true) => Severity::Error,
            (true, false) => Severity::Warning,
            (false, false) => Severity::Info,
        }
    }

    /// What programs do, as places of findings have it.
    pub fn does(&self) -> Vec<Does> {
        let does =
            |one: &Said| Does { program: one.program.id().to_owned(), does: one.effect.deed };
        self.said.iter().map(does).collect()
    }

    /// As LNT060 and LNT061 report it.
    pub fn left(&self, programs: &[ProgramResult], severity: Severity, fix: Option<Fix>) -> Left {
        Left {
            code: self.code(),
            offset: self.at,
            message: self.message(programs),
            severity,
            consequence: self.is_of_looks().then_some(Consequence::Appearance),
            programs: self.does(),
            fix,
        }
    }

    /// What is wrong, what programs do, and what to do about it.
    pub fn message(&self, programs: &[ProgramResult]) -> String {
        format!("{}: {}; {}", self.fault, self.doings(programs), self.fault.advice())
    }

    /// What programs do: "ROS and Drake refuse the robot; MuJoCo leaves out the limit".
    pub fn doings(&self, programs: &[ProgramResult]) -> String {
        let mut groups: Vec<Vec<&Said>> = Vec::new();
        for one in &self.said {
            match groups.iter_mut().find(|group| group[0].is_like(one)) {
                Some(group) => group.push(one),
                None => groups.push(vec![one]),
            }
        }
        groups.sort_by_key(|group| (std::cmp::Reverse(group[0].effect.deed), group[0].program));
        let doing = |group: &Vec<&Said>| {
            let is_one = |result: &ProgramResult| {
                group.iter().any(|said| said.program.id() == result.program)
            };
            let (names, are_many) = subject(programs, is_one);
            format!("{names} {}", group[0].words(are_many))
        };
        groups.iter().map(doing).collect::<Vec<_>>().join("; ")
    }
}

impl Said {
    /// Whether the program has no robot because of it.
    fn is_refused(&self) -> bool {
        self.effect.deed >= Deed::Refuses
    }

    /// Whether another program does the same.
    fn is_like(&self, other: &Said) -> bool {
        let (one, other) = (&self.effect, &other.effect);
        (one.deed, &one.part, &one.makes) == (other.deed, &other.part, &other.makes)
    }

    fn words(&self, are_many: bool) -> String {
        let (s, es) = if are_many { ("", "") } else { ("s", "es") };
        // `joint/elbow/limit` is "the limit". Which joint it is, the place says.
        let kind = kind(&self.effect.part);
        let part = || format!("the {}", kind.replace('_', " "));
        match (self.effect.deed, self.effect.makes.as_deref()) {
            (Deed::Refuses, _) => format!("refuse{s} the robot"),
            (Deed::Crashes, _) => format!("crash{es}"),
            (Deed::Drops, _) if kind == "?" => format!("ignore{s} it"),
            (Deed::Drops, _) => format!("leave{s} out {}", part()),
            (Deed::Reads, Some(made)) if !made.is_empty() => format!("read{s} `{made}`"),
            (Deed::Reads, _) => format!("read{s} {} otherwise", part()),
        }
    }
}
