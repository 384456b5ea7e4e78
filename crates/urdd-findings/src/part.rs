//! What a rule judged, and what it did not: parts of a robot's geometry, so that a fault in one leaves the others judged, and
//! why a rule was skipped.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::fmt;

use thiserror::Error;

use super::code::Code;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

/// A mesh of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The plain mesh of a link.
    Plain(usize),
    /// The convex hull of a link.
    Hull(usize),
    /// A convex piece of a link.
    Piece {
        /// The link.
        link: usize,
        /// Its index among the link's pieces.
        piece: usize,
    },
}

/// Why a part was not verified by a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Why {
    /// This rule found a fault in it, or in something it is compared with.
    #[error("{0} found a fault")]
    Failed(Code),
    #[error("a mesh file cannot be read, or its formats differ")]
    Unreadable,
    #[error("a mesh that the URDF names is not carried, or cannot be read")]
    SourceMissing,
    #[error("a mesh is outside of the robot's folder and packages; --allow-folder reads it")]
    Outside,
    #[error("a mesh is in a package that is not found; --package says where it is")]
    NoPackage,
    #[error("a mesh is in a format that is not read here")]
    OtherFormat,
}

/// A part that a rule did not verify.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NotVerified {
    /// The part.
    pub part: Part,
    /// The reason.
    pub why: Why,
}

impl Part {
    /// A part of a module of derived meshes.
    pub fn of(module: ModuleKind, link: usize, piece: usize) -> Option<Part> {
        match module {
            ModuleKind::PlainMeshes => Some(Part::Plain(link)),
            ModuleKind::ConvexHullMeshes => Some(Part::Hull(link)),
            ModuleKind::ConvexDecompositionMeshes => Some(Part::Piece { link, piece }),
            _ => None,
        }
    }

    /// The hull or piece that a shape is or bounds.
    pub fn of_shape(kind: ShapeKind, link: usize, piece: usize) -> Part {
        if kind.is_of_links() { Part::Hull(link) } else { Part::Piece { link, piece } }
    }

    /// Its module, link and piece (0 if links have one mesh).
    pub fn place(self) -> (ModuleKind, usize, usize) {
        match self {
            Part::Plain(link) => (ModuleKind::PlainMeshes, link, 0),
            Part::Hull(link) => (ModuleKind::ConvexHullMeshes, link, 0),
            Part::Piece { link, piece } => (ModuleKind::ConvexDecompositionMeshes, link, piece),
        }
    }

    /// The link.
    pub fn link(self) -> usize {
        match self {
            Part::Plain(link) | Part::Hull(link) | Part::Piece { link, .. } => link,
        }
    }
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Part::Plain(link) => write!(f, "the mesh of link {link}"),
            Part::Hull(link) => write!(f, "the hull of link {link}"),
            Part::Piece { link, piece } => write!(f, "piece {piece} of link {link}"),
        }
    }
}

/// The parts in which a rule found a fault.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faulted {
    parts: BTreeSet<Part>,
    elsewhere: bool,
}

impl Faulted {
    /// Adds the parts of a finding. Without parts, the fault does not belong to single parts.
    pub fn add(&mut self, parts: &[Part]) {
        self.parts.extend(parts);
        self.elsewhere |= parts.is_empty();
    }

    /// The parts.
    pub fn parts(&self) -> &BTreeSet<Part> {
        &self.parts
    }

    /// Whether there are faults besides those of single parts.
    pub fn elsewhere(&self) -> bool {
        self.elsewhere
    }

    /// Whether a convex piece, or something besides single parts, is faulty.
    pub fn has_pieces(&self) -> bool {
        self.elsewhere || self.parts.iter().any(|part| matches!(part, Part::Piece { .. }))
    }
}

/// The parts that a rule judges.
#[derive(Debug, Clone, Default)]
pub struct Scope {
    unsound: HashMap<Part, Code>,
    judged: usize,
    not_verified: BTreeSet<NotVerified>,
}

impl Scope {
    /// All parts except those in which other rules found a fault, given with the rule.
    pub fn without(unsound: HashMap<Part, Code>) -> Self {
        Scope { unsound, ..Scope::default() }
    }

    /// The same parts, none of them judged yet.
    pub fn afresh(&self) -> Self {
        Scope::without(self.unsound.clone())
    }

    /// Whether to judge a part against other parts: not if one of them is unsound. Records what is not judged.
    pub fn judges(&mut self, part: Part, by: &[Part]) -> bool {
        let mut needed = std::iter::once(&part).chain(by);
        match needed.find_map(|needed| self.unsound.get(needed)) {
            Some(code) => {
                self.leave_out(part, Why::Failed(*code));
                false
            }
            None => {
                self.judged += 1;
                true
            }
        }
    }

    /// Records that a part was not verified.
    pub fn leave_out(&mut self, part: Part, why: Why) {
        self.not_verified.insert(NotVerified { part, why });
    }

    /// The rule whose fault left nothing to judge, if so.
    pub fn nothing_left(&self) -> Option<Code> {
        if self.judged > 0 {
            return None;
        }
        self.not_verified.iter().find_map(|one| match one.why {
            Why::Failed(code) => Some(code),
            _ => None,
        })
    }

    /// The parts that were not verified.
    pub fn not_verified(&self) -> Vec<NotVerified> {
        self.not_verified.iter().copied().collect()
    }
}

/// Why a rule did not run, or did not run to its end. The texts are for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SkipReason {
    /// What it is about is not there, so that nothing is missed.
    Absent(Cow<'static, str>),
    /// It is for other kinds of descriptions.
    ForOthers(Cow<'static, str>),
    /// What it is about is there and not whole, so that something may be missed.
    Obstacle(Cow<'static, str>),
    /// It was left out, or what it compares with is not there.
    LeftOut(Cow<'static, str>),
    /// A rule that it needs found a fault.
    Failed(Code),
    /// A rule that it needs crashed.
    Crashed(Code),
    /// A rule that it needs was not among the rules to run.
    DidNotRun(Code),
    /// The rule takes something that it does not declare as a need: a fault of the rule. In debug builds it crashes.
    UndeclaredNeed,
    /// The settings ignore every finding, for this reason.
    Ignored(String),
}

impl SkipReason {
    /// A module that is not there.
    pub fn absent(kind: ModuleKind) -> Self {
        SkipReason::Absent(format!("there is no {}", kind.name()).into())
    }

    /// Something that is there and not whole.
    pub fn obstacle(why: impl fmt::Display) -> Self {
        SkipReason::Obstacle(why.to_string().into())
    }

    /// Whether a fault prevented the check, so that something may be missed.
    pub fn is_obstacle(&self) -> bool {
        matches!(
            self,
            SkipReason::Obstacle(_)
                | SkipReason::Failed(_)
                | SkipReason::Crashed(_)
                | SkipReason::UndeclaredNeed
        )
    }
}

impl fmt::Display for SkipReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SkipReason::Absent(why)
            | SkipReason::ForOthers(why)
            | SkipReason::Obstacle(why)
            | SkipReason::LeftOut(why) => f.write_str(why),
            SkipReason::Failed(code) => write!(f, "{code} found a fault"),
            SkipReason::Crashed(code) => write!(f, "{code} crashed"),
            SkipReason::DidNotRun(code) => write!(f, "{code} did not run"),
            SkipReason::UndeclaredNeed => {
                f.write_str("the rule has a fault: it takes something that it does not declare")
            }
            SkipReason::Ignored(reason) => write!(f, "ignored: {reason}"),
        }
    }
}
