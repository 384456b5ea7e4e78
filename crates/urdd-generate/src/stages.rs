//! How each module is built from the modules before it.
//!
//! A slow stage declares its inputs besides other modules. It is skipped if these inputs, and the files of the modules
//! that it depends on, are unchanged. Later stages then load its results from the files.

use super::connections::{MOST_LINKS_IN_PAIRS, MOST_LINKS_WITH_PAIRS, connections_module};
use super::error::GenerateError;
use super::geometry_stages as geometry;
use super::learned;
use super::made::{Content, Made, MadeFile, document};
use super::meshes::original::original_meshes;
use super::reuse::SettingsTexts;
use super::work::Work;
use urdd_directory::document::{Document, Member, Rows};
use urdd_format::registry::ModuleKind;

/// When a module of the old URDD is kept instead of built again.
pub(super) enum Reuse {
    /// Never: it takes no time to build.
    Never,
    /// If the modules that it depends on and the version of the stage are the same. The text changes whenever the stage
    /// builds something else from the same inputs.
    SameInputs(&'static str),
    /// As `SameInputs`, but compares the text that this function returns for the settings.
    SameSettings(fn(&Work) -> String),
}

impl Reuse {
    /// The inputs of the module besides other modules; `None` if it is always built.
    pub fn inputs(&self, work: &Work) -> Option<String> {
        match self {
            Reuse::Never => None,
            Reuse::SameInputs(version) => Some((*version).to_owned()),
            Reuse::SameSettings(settings) => Some(settings(work)),
        }
    }
}

/// One stage.
pub(super) struct Stage {
    pub kind: ModuleKind,
    /// When the module of the old URDD is kept.
    pub reuse: Reuse,
    /// Builds the module.
    pub make: Make,
}

/// How a module is built.
#[derive(Clone, Copy)]
pub(super) enum Make {
    /// For every robot.
    Always(fn(&mut Work) -> Result<Made, GenerateError>),
    /// For robots for which it is useful.
    WhereOfUse(fn(&mut Work) -> Result<Option<Made>, GenerateError>),
}

/// Every stage, in the order of the specification.
const STAGES: &[Stage] = &[
    Stage {
        kind: ModuleKind::Urdf,
        reuse: Reuse::Never,
        make: Make::Always(|work| document(&work.source.reading.robot)),
    },
    Stage {
        kind: ModuleKind::Dof,
        reuse: Reuse::Never,
        make: Make::Always(|work| document(&work.dof)),
    },
    Stage {
        kind: ModuleKind::Chain,
        reuse: Reuse::Never,
        make: Make::Always(|work| document(&work.chain)),
    },
    Stage {
        kind: ModuleKind::Connections,
        // With hundreds of links this is megabytes of text.
        reuse: Reuse::SameInputs("2"),
        make: Make::Always(connections),
    },
    Stage {
        kind: ModuleKind::Bounds,
        reuse: Reuse::Never,
        make: Make::Always(|work| document(&work.bounds)),
    },
    Stage {
        kind: ModuleKind::KinematicsSamples,
        reuse: Reuse::Never,
        make: Make::Always(|work| document(&work.samples)),
    },
    Stage {
        kind: ModuleKind::Composition,
        reuse: Reuse::Never,
        make: Make::Always(|work| document(&work.composition)),
    },
    Stage {
        kind: ModuleKind::OriginalMeshes,
        reuse: Reuse::Never,
        make: Make::Always(meshes),
    },
    Stage {
        kind: ModuleKind::PlainMeshes,
        reuse: Reuse::SameSettings(geometry::plain_settings),
        make: Make::Always(geometry::plain),
    },
    Stage {
        kind: ModuleKind::ConvexHullMeshes,
        reuse: Reuse::SameSettings(geometry::hulls_settings),
        make: Make::Always(geometry::hulls),
    },
    Stage {
        kind: ModuleKind::ConvexDecompositionMeshes,
        reuse: Reuse::SameSettings(geometry::decomposition_settings),
        make: Make::Always(geometry::pieces),
    },
    Stage {
        kind: ModuleKind::LinkShapesApproximations,
        reuse: Reuse::SameInputs(""),
        make: Make::Always(geometry::boxes_and_spheres),
    },
    Stage {
        kind: ModuleKind::LinkShapesMaxDistanceFromOrigin,
        reuse: Reuse::SameInputs(""),
        make: Make::Always(geometry::distances_from_origin),
    },
    Stage {
        kind: ModuleKind::LinkShapesDistanceStatistics,
        reuse: Reuse::SameSettings(geometry::statistics_settings),
        make: Make::Always(geometry::distance_statistics),
    },
    Stage {
        kind: ModuleKind::LinkShapesSimpleSkips,
        reuse: Reuse::SameInputs("2"),
        make: Make::Always(geometry::skips_by_distance),
    },
    Stage {
        kind: ModuleKind::LinkShapesSkips,
        reuse: Reuse::SameSettings(geometry::skips_settings),
        make: Make::Always(geometry::edited_skips),
    },
    Stage {
        kind: ModuleKind::SelfCollisionModel,
        reuse: Reuse::SameSettings(learned::settings),
        make: Make::WhereOfUse(learned::self_collision_model),
    },
];

/// The stage of a module.
pub(super) fn of(kind: ModuleKind) -> Option<&'static Stage> {
    STAGES.iter().find(|stage| stage.kind == kind)
}

/// The inputs of each module besides other modules.
pub(super) fn settings_texts(work: &Work) -> SettingsTexts {
    let texts = STAGES
        .iter()
        .filter_map(|stage| Some((stage.kind, stage.reuse.inputs(work)?)));
    texts.collect()
}

/// With 180 links in a line these tables have 5 million numbers.
fn connections(work: &mut Work) -> Result<Made, GenerateError> {
    let module = connections_module(&work.chain);
    if module.link_to_link_paths.is_none() {
        let links = work.chain.links_in_chain.len();
        work.too_large(
            format!(
                "the robot has {links} links, and the paths of all pairs grow too large above {MOST_LINKS_WITH_PAIRS} links, or {MOST_LINKS_IN_PAIRS} links in the paths"
            ),
            "connections_module leaves them out; they follow from its root paths and lowest common ancestors",
        );
    }
    let pairs = module.link_to_link_paths.map(Rows::new);
    let descents = module.link_connection_paths.map(Rows::new);
    let document = Document::Object(vec![
        ("root_paths", Member::Rows(Rows::new(module.root_paths))),
        (
            "lowest_common_ancestors",
            Member::Rows(Rows::new(module.lowest_common_ancestors)),
        ),
        ("link_to_link_paths", Member::rows_or_null(pairs)),
        ("link_connection_paths", Member::rows_or_null(descents)),
    ]);
    let files = Vec::new();
    Ok(Made { document, files })
}

fn meshes(work: &mut Work) -> Result<Made, GenerateError> {
    let mut original = original_meshes(work.source, work.settings)?;
    work.notes.append(&mut original.notes);
    let files = std::mem::take(&mut original.files).into_iter();
    let files = files.map(|(path, bytes)| MadeFile {
        path,
        content: Content::Shared(bytes),
    });
    let files = files.collect();
    let made = document(&original.module)?;
    work.original = Some(original);
    Ok(Made { files, ..made })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::selection;

    #[test]
    fn whatever_can_be_selected_has_a_stage() {
        let kinds = selection::kinds().into_iter();
        let without: Vec<ModuleKind> = kinds.filter(|kind| of(*kind).is_none()).collect();
        assert_eq!(
            without,
            [],
            "add a stage, or say in selection.rs that it is not selectable"
        );
    }
}
