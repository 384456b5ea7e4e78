//! The faults that programs name: what programs do because of each, how bad that is, and which rules see it.

use std::collections::{BTreeMap, HashSet};

use urdd_findings::code::Code;
use urdd_findings::code::Code::*;
use urdd_findings::finding::Finding;
use urdd_findings::report::programs::{kind, subject};
use urdd_format::report::{Consequence, Does, Fix, ProgramResult, Severity};
use urdd_programs::{Deed, Effect, Fault, MASSLESS, MASSLESS_WITH_OTHERS, Program};

/// A fault, by all programs that do something because of it.
#[derive(Debug, Clone)]
pub struct Faulty {
    /// Where it is: the first byte of the element or attribute in the text.
    pub at: usize,
    /// What is wrong, as the program has it that does the worst.
    pub fault: Fault,
    pub said: Vec<Said>,
    /// How it is mended, if that has one right answer.
    pub fix: Option<Fix>,
}

/// What a program does because of a fault.
#[derive(Debug, Clone)]
pub struct Said {
    pub program: Program,
    /// Whether the settings name it.
    pub is_chosen: bool,
    pub effect: Effect,
}

/// The faults of a file, in order of place. What a program does with every robot is none. All that is wrong with an attribute
/// is one fault.
pub fn faults(said: Vec<Said>, text: &str) -> Vec<Faulty> {
    let mut by_place: BTreeMap<usize, Vec<Faulty>> = BTreeMap::new();
    for said in said.into_iter().filter(|said| said.effect.fault.is_of_robot()) {
        let (at, fault) = (said.effect.at, said.effect.fault.clone());
        let is_attribute = text.as_bytes().get(at).is_some_and(|byte| *byte != b'<');
        let here = by_place.entry(at).or_default();
        let new = Faulty { at, fault, said: vec![said], fix: None };
        let is_same = |one: &&mut Faulty| is_attribute || one.fault.is_alike(&new.fault);
        match here.iter_mut().find(is_same) {
            Some(known) => known.add(new),
            None => here.push(new),
        }
    }
    by_place.into_values().flatten().collect()
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
    fn is_of_looks(&self) -> bool {
        let is_look = |part: &str| part.starts_with("material/") || part.ends_with("/material");
        self.said.iter().all(|said| is_look(&said.effect.part))
    }

    /// Adds what programs do because of the same fault. Of each program, the worst counts.
    pub fn add(&mut self, other: Faulty) {
        if self.worst() < other.worst() {
            (self.at, self.fault) = (other.at, other.fault);
        }
        self.fix = self.fix.take().or(other.fix);
        for said in other.said {
            match self.said.iter_mut().find(|known| known.program == said.program) {
                Some(known) if known.effect.deed < said.effect.deed => *known = said,
                // What is refused first is no supposition.
                Some(known) => known.effect.is_supposed &= said.effect.is_supposed,
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
        let does = |one: &Said| Does {
            program: one.program.id().to_owned(),
            does: one.effect.deed,
            is_supposed: one.effect.is_supposed,
        };
        self.said.iter().map(does).collect()
    }

    /// A finding of LNT060, or of LNT061 if every program has the robot nevertheless: what is wrong, what programs do, and what
    /// to do about it. `place` makes a finding of a message.
    pub fn reported(
        self,
        programs: &[ProgramResult],
        severity: Severity,
        place: impl FnOnce(String) -> Finding,
    ) -> (Code, Finding) {
        let (doings, advice) = (self.doings(programs), self.fault.advice());
        let mut finding = place(format!("{}: {doings}; {advice}", self.fault));
        finding.severity = Some(severity);
        // What is lost, if that is not what the rule says.
        finding.consequence = self.is_of_looks().then_some(Consequence::Appearance);
        finding.place.programs = self.does();
        (self.code(), finding.fix(self.fix))
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

/// How far from the fault the finding of a rule may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reach {
    /// At the same element.
    Element,
    /// At the element that it is in, or at one beside it.
    Beside,
    /// In the same link or joint.
    Part,
    /// At the part that the fault names.
    Named,
    /// At the robot as a whole.
    Robot,
    /// Anywhere in the file.
    File,
}

use Reach::{Beside, Element, File, Named, Part, Robot};

/// Rules, and how far from a fault they see it.
type Seeing = (Reach, &'static [Code]);

const OF_INERTIA: &[Code] = &[SRC003, SRC004, SRC005, LNT006, LNT008];
const OF_FILES: &[Code] = &[LNT026, LNT027, LNT028, LNT029, LNT030];
/// Whatever is missing.
const OF_MISSING: Seeing = (Element, &[URD011, LNT015]);

/// How far from a fault a rule sees it; `None` if it is about something else.
pub fn sees(code: Code, fault: &Fault) -> Option<Reach> {
    let seeing = seeing(fault).iter().find(|(_, codes)| codes.contains(&code));
    seeing.map(|(reach, _)| *reach)
}

/// The rules that see a fault. The first place of a rule counts.
fn seeing(fault: &Fault) -> &'static [Seeing] {
    match fault {
        Fault::Xml(_) | Fault::NotRobot => &[(File, &[URD011])],
        Fault::Tree(_) => &[(File, &[URD004, URD005, URD006])],
        // A mass that is next to nothing makes no density.
        Fault::Inertia(_) if [MASSLESS, MASSLESS_WITH_OTHERS].contains(fault) => {
            &[(Beside, &[URD011]), (Robot, &[LNT006]), (Part, &[LNT003]), (Part, OF_INERTIA)]
        }
        // LNT006: no link has a mass.
        Fault::Inertia(_) => &[(Beside, &[URD011]), (Robot, &[LNT006]), (Part, OF_INERTIA)],
        // A joint names a link without a name.
        Fault::Empty("link") => &[(Named, &[LNT015]), (Element, &[URD004, URD007]), OF_MISSING],
        Fault::Missing(name) | Fault::MissingElement(name) | Fault::Empty(name) => {
            seeing_missing(name)
        }
        Fault::NotANumber { .. } | Fault::Count { .. } => {
            &[(Beside, OF_INERTIA), (Element, &[URD011])]
        }
        Fault::Value { .. } => &[(Element, &[URD011, URD012])],
        Fault::Range { .. } => &[
            (Element, &[LNT012, LNT013, LNT023, LNT033, LNT048, URD010, URD011, SRC009]),
            (Element, OF_INERTIA),
        ],
        Fault::Type(_) => &[(Beside, &[URD012])],
        Fault::Repeated(_) => &[(Beside, &[SRC008, LNT008, URD011])],
        Fault::NotUnique { .. } => &[(Element, &[URD002, URD003, LNT015])],
        Fault::Unknown { .. } => &[
            (Part, &[URD007, URD008]),
            (Named, &[LNT041, LNT048]),
            (Element, &[LNT042, LNT043, URD011]),
        ],
        Fault::UnknownElement { .. } | Fault::UnknownAttribute { .. } => {
            &[(Beside, &[URD011, LNT008]), (Element, &[LNT040, LNT046, LNT047])]
        }
        Fault::Shape(_) => &[(Element, &[LNT040, LNT046, LNT047, URD011])],
        Fault::Limits(_) => &[(Element, &[SRC001, LNT014])],
        Fault::NotFound(_) => &[(Element, OF_FILES)],
        Fault::Mesh(_) => {
            &[(Beside, OF_FILES), (Beside, &[LNT020, LNT022, LNT023, LNT024, LNT034, LNT035])]
        }
        Fault::Name { .. } => &[(Named, &[LNT015])],
        Fault::Version(_) => &[(Element, &[URD011])],
        Fault::Other(_) => {
            &[(Part, &[URD009, URD010]), (Beside, &[LNT008, URD011, URD012, LNT046])]
        }
        Fault::NeverRead(_) | Fault::Way(_) | Fault::ForOthers(_) => &[],
        // What rules say of joints and links is about the robot's own.
        Fault::Control(..) | Fault::ControlValue { .. } => &[],
    }
}

/// The rules that see that an element or attribute is missing.
fn seeing_missing(name: &str) -> &'static [Seeing] {
    match name {
        // The root, in Gazebo, where no link has a mass.
        "inertial" => &[(Robot, &[LNT006]), (Part, &[LNT008]), OF_MISSING],
        "mass" | "inertia" | "value" => &[(Part, &[LNT006, LNT008]), OF_MISSING],
        name if name.len() == 3 && name.starts_with('i') => {
            &[(Part, &[LNT006, LNT008]), OF_MISSING]
        }
        "limit" | "lower" | "upper" | "effort" | "velocity" => {
            &[(Part, &[SRC006, LNT017]), OF_MISSING]
        }
        "axis" | "xyz" => &[(Part, &[LNT016]), OF_MISSING],
        "joint" => &[(Element, &[URD008]), OF_MISSING],
        "link" => &[(Element, &[URD004, URD007]), OF_MISSING],
        "filename" => &[(Element, OF_FILES), OF_MISSING],
        _ => &[OF_MISSING],
    }
}
