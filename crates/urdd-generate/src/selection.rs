//! Which modules are made.

use std::collections::BTreeSet;

use thiserror::Error;

use urdd_format::registry::{MODULES, ModuleKind, Profile};
use urdd_format::root_metadata::ConformanceClass;

/// A word that names no module.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no module `{word}`; there are: {}", known())]
pub struct UnknownModule {
    /// The word.
    pub word: String,
}

fn known() -> String {
    let names = kinds().into_iter().map(short);
    let classes = ["core", "geometry", "shapes", "all"];
    names.chain(classes).collect::<Vec<_>>().join(", ")
}

/// The modules of version 1, in the order of the specification, that can be asked for. What is made of a robot that is
/// put together from others, nobody needs to ask for.
fn kinds() -> Vec<ModuleKind> {
    let current = MODULES.iter().filter(|spec| spec.profile == Profile::V1);
    let kinds = current.map(|spec| spec.kind);
    kinds
        .filter(|kind| *kind != ModuleKind::Composition)
        .collect()
}

/// A module's name without `_module`.
fn short(kind: ModuleKind) -> &'static str {
    kind.name().strip_suffix("_module").unwrap_or(kind.name())
}

/// The modules to make: what was asked for, what that is derived from, and the core class, without
/// which nothing is a URDD.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection(BTreeSet<ModuleKind>);

/// What this program makes of every robot, unless it is told otherwise: all but what has to be trained.
fn by_default() -> impl Iterator<Item = ModuleKind> {
    let kinds = kinds().into_iter();
    kinds.filter(|kind| *kind != ModuleKind::SelfCollisionModel)
}

impl Selection {
    /// Every module that this program makes of a robot, unless it is told otherwise.
    pub fn all() -> Self {
        Selection(by_default().collect())
    }

    /// Reads words: names of modules, with or without `_module`, and of conformance classes.
    ///
    /// # Errors
    /// The first word that is neither.
    pub fn parse<'a>(words: impl IntoIterator<Item = &'a str>) -> Result<Self, UnknownModule> {
        let kinds = kinds();
        let up_to = |class: ConformanceClass| {
            let is_of = move |kind: &ModuleKind| kind.class().is_none_or(|of| of <= class);
            by_default().filter(is_of).collect::<Vec<_>>()
        };
        let mut asked = up_to(ConformanceClass::Core);
        asked.retain(|kind| kind.class().is_some());
        for word in words {
            let word = word.trim();
            let named = kinds
                .iter()
                .copied()
                .find(|kind| word == kind.name() || word == short(*kind));
            match (word, named) {
                (_, Some(kind)) => asked.push(kind),
                ("core", _) => asked.extend(up_to(ConformanceClass::Core)),
                ("geometry", _) => asked.extend(up_to(ConformanceClass::Geometry)),
                ("shapes", _) => asked.extend(up_to(ConformanceClass::Shapes)),
                ("all", _) => asked.extend(by_default()),
                _ => {
                    let word = word.to_owned();
                    return Err(UnknownModule { word });
                }
            }
        }
        let mut selection = BTreeSet::new();
        while let Some(kind) = asked.pop() {
            if selection.insert(kind) {
                asked.extend(kind.depends_on());
            }
        }
        Ok(Selection(selection))
    }

    /// Whether a module is made.
    pub fn has(&self, kind: ModuleKind) -> bool {
        self.0.contains(&kind)
    }

    /// The modules, in the order of the specification.
    pub fn kinds(&self) -> impl Iterator<Item = ModuleKind> + '_ {
        self.0.iter().copied()
    }
}
