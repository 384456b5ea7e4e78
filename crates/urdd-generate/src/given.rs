//! What comes with a robot besides its URDF: from its parts, or from the description that it was imported from; named
//! configurations that a person decided on, and the reference configuration: one of them that takes the place of the default
//! configuration where pairs of links that touch are skipped. SPEC 8.6 knows the default configuration alone, so edits of
//! skips say the rest.

use std::collections::HashSet;
use std::path::Path;

use serde_json::Value;

use crate::donor::edits::Decisions;
use crate::error::ReferenceFault;
use urdd_directory::file_type::setup_beside;
use urdd_directory::outputs::{self, Output, OutputError, Target};
use urdd_format::bounds::BoundsModule;
use urdd_format::composition::CompositionModule;
use urdd_format::dof::DofModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::named_configurations::{
    ConfigurationEdit, NamedConfiguration, NamedDofs, PositionFault,
};
use urdd_format::short::Short;
use urdd_import::Imported;
use urdd_source::note::{Note, NoteKind};

#[derive(Default, Clone, Copy)]
pub(crate) struct GivenDecisions<'a> {
    /// Edits of skips. Those of the URDD that is replaced follow them.
    pub edits: &'a [SkipEdit],
    /// Named configurations. Those of the URDD that is replaced take precedence.
    pub configurations: &'a [ConfigurationEdit],
    /// The skip reasons to use when no URDD is replaced and the settings give none.
    pub skipped_reasons: Option<&'a Vec<SkippedReason>>,
    pub composition: Option<&'a CompositionModule>,
    /// The original, if the robot was imported.
    pub origin: Option<&'a Value>,
}

impl GivenDecisions<'_> {
    /// The user's decisions: those given, then `there`, those of the URDD that is replaced; without one `is_new` is true.
    pub fn decisions(&self, is_new: bool, mut there: Decisions) -> Decisions {
        if let (true, Some(reasons)) = (is_new, self.skipped_reasons) {
            there.skipped_reasons.clone_from(reasons);
        }
        let words = |edit: &SkipEdit| {
            let [a, b, reason] = [&edit.link_a, &edit.link_b, &edit.reason].map(String::clone);
            (a, b, edit.skip, reason)
        };
        let own: HashSet<_> = self.edits.iter().map(words).collect();
        there.edits.retain(|edit| !own.contains(&words(edit)));
        there.edits.splice(..0, self.edits.iter().cloned());
        let names: HashSet<_> = there.configurations.iter().map(|edit| &edit.name).collect();
        let new = self.configurations.iter();
        let new: Vec<_> = new.filter(|edit| !names.contains(&edit.name)).cloned().collect();
        there.configurations.extend(new);
        there
    }
}

impl<'a> From<&'a Imported> for GivenDecisions<'a> {
    fn from(imported: &'a Imported) -> Self {
        GivenDecisions {
            edits: &imported.skips,
            configurations: &imported.configurations,
            origin: Some(&imported.origin),
            ..GivenDecisions::default()
        }
    }
}

/// Writes what an import says for exports beside the URDD, `NAME.export.toml`, unless there is such a file: it may be a
/// person's. Says so then, and where it cannot be written.
pub(super) fn write_setup(imported: &Imported, target: &Path) -> Option<Note> {
    let text = imported.setup()?;
    let path = setup_beside(target);
    let own = Output { path: path.file_name()?.into(), bytes: text, replaces: false };
    let assumed = match outputs::write(Target::File(&path), vec![own]).err()? {
        OutputError::Exists(_) => {
            "it stays as it is; `urdd import` writes the new one elsewhere".to_owned()
        }
        error => format!("it is not written: {error}"),
    };
    Some(Note {
        kind: NoteKind::LeftBehind,
        file: path.display().to_string(),
        line: 0,
        column: 0,
        problem: "the description says other gains, or another base, than this file".to_owned(),
        assumed,
    })
}

#[derive(Debug, Clone, Default)]
pub(crate) struct Named {
    pub configurations: Vec<NamedConfiguration>,
    /// Positions that this robot cannot have: the configuration, and what is wrong.
    pub lost: Vec<(String, String)>,
}

impl Named {
    /// Leaves out the positions that this robot cannot have.
    pub fn of(edits: &[ConfigurationEdit], dof: &DofModule, bounds: &BoundsModule) -> Self {
        let dofs = NamedDofs::new(dof, bounds);
        let mut named = Named::default();
        for edit in edits {
            let mut kept = edit.clone();
            kept.positions.retain(|position| {
                let (name, dof, at) = (&edit.name, &position.dof_name, position.position);
                let problem = match dofs.fault(position) {
                    None => return true,
                    Some(PositionFault::UnknownDof) => format!(
                        "the configuration `{name}` has a position of the DOF `{dof}`, but the robot has no such DOF"
                    ),
                    Some(PositionFault::OutOfBounds([lower, upper])) => format!(
                        "the configuration `{name}` has the DOF `{dof}` at {at}, but its bounds are {lower} and {upper}"
                    ),
                };
                named.lost.push((name.to_string(), problem));
                false
            });
            named.configurations.push(dofs.named(&kept));
        }
        named
    }
}

/// The word for the default configuration, where no configuration has this name.
const DEFAULT: &str = "default";

/// The configuration of this name; `None` for the default configuration, or where none is asked for.
pub(super) fn reference(
    name: Option<&str>,
    named: &Named,
) -> Result<Option<NamedConfiguration>, ReferenceFault> {
    let Some(name) = name else { return Ok(None) };
    if let Some((_, problem)) = named.lost.iter().find(|(of, _)| of == name) {
        return Err(ReferenceFault::Position(problem.clone()));
    }
    let all = &named.configurations;
    if let Some(found) = all.iter().find(|one| one.name.as_str() == name) {
        return Ok(Some(found.clone()));
    }
    if name == DEFAULT {
        return Ok(None);
    }
    let known = all.iter().map(|one| Short::of(one.name.as_str())).collect();
    Err(ReferenceFault::Unknown { name: Short::of(name), known })
}

/// A person's decisions without what followed from an earlier reference. Without a new one, pairs that touch in the default
/// configuration are skipped again.
pub(super) fn without_reference(mut decisions: Decisions, is_new: bool) -> Decisions {
    decisions.edits.retain(|edit| edit.reference().is_none());
    if !is_new {
        decisions.skipped_reasons.push(SkippedReason::Default);
    }
    decisions
}
