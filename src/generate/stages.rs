//! How each module is made of those before it.
//!
//! A stage that takes long says what it depends on besides other modules; it is passed over where
//! that, and the files of those modules, are as they were. What it made is then taken up from the
//! files, by whoever needs it.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde::Serialize;

use super::error::GenerateError;
use super::fault::{Fault, PlacedFault};
use super::geometry_stages::{self as geometry, Edits};
use super::meshes::original::{OriginalMeshes, original_meshes};
use super::note::{Note, NoteKind};
use super::old::Old;
use super::robot::Settings;
use super::solids::Hoard;
use super::source::Source;
use super::{bounds, chain, connections, dof, kinematics_samples};
use crate::directory::document::{Document, Rows};
use crate::format::bounds::BoundsModule;
use crate::format::chain::ChainModule;
use crate::format::dof::DofModule;
use crate::format::kinematics_samples::KinematicsSamplesModule;
use crate::format::registry::ModuleKind;

/// What stages work with.
pub(super) struct Work<'a> {
    pub source: &'a Source,
    pub settings: &'a Settings,
    /// The URDD that is replaced.
    pub old: Option<&'a Old>,
    pub dof: DofModule,
    pub chain: ChainModule,
    pub bounds: BoundsModule,
    pub samples: KinematicsSamplesModule,
    pub original: Option<OriginalMeshes>,
    /// Meshes and shapes.
    pub hoard: Hoard,
    /// A person's edits of the skips, once they are read.
    pub edits: OnceLock<Edits>,
    pub notes: Vec<Note>,
}

impl<'a> Work<'a> {
    /// With what nearly every stage needs, and takes no time to make.
    ///
    /// # Errors
    /// Where mimics or poses are beyond 64-bit numbers.
    pub fn new(
        source: &'a Source,
        settings: &'a Settings,
        root: &Path,
        old: Option<&'a Old>,
    ) -> Result<Self, GenerateError> {
        let reading = &source.reading;
        let refused = |fault| GenerateError::Refused {
            file: source.shown.clone(),
            faults: vec![PlacedFault {
                line: 1,
                column: 1,
                fault,
            }],
        };
        let dof = dof::dof_module(&reading.robot, &reading.tree).map_err(refused)?;
        let chain = chain::chain_module(&reading.robot, &reading.tree);
        let bounds = bounds::bounds_module(&reading.robot, &dof);
        let samples = kinematics_samples::kinematics_samples_module(&dof, &chain, &bounds)
            .map_err(|error| refused(Fault::NoPoses(error.to_string())))?;
        Ok(Work {
            dof,
            chain,
            bounds,
            samples,
            source,
            settings,
            hoard: Hoard::new(root),
            edits: OnceLock::new(),
            old,
            original: None,
            notes: Vec::new(),
        })
    }

    /// Notes that something is not made of this robot.
    pub fn leave_out(&mut self, problem: String, assumed: &str) {
        self.notes.push(Note {
            kind: NoteKind::LeftOut,
            file: self.source.shown.clone(),
            line: 0,
            column: 0,
            problem,
            assumed: assumed.to_owned(),
        });
    }
}

/// A module that was made.
pub(super) struct Made {
    pub document: Document,
    /// The files that the document names.
    pub files: Vec<MadeFile>,
}

/// A file of a module.
pub(super) struct MadeFile {
    /// Path relative to the URDD's root.
    pub path: String,
    pub content: Content,
}

/// What a file holds.
pub(super) enum Content {
    Bytes(Vec<u8>),
    /// The same as another file.
    CopyOf(PathBuf),
}

/// One stage.
pub(super) struct Stage {
    pub kind: ModuleKind,
    /// What the module depends on besides those of [`ModuleKind::depends_on`], as text: the settings
    /// that matter to it, and a number that goes up whenever the stage makes something else of the
    /// same. `None` for a module that is made anew each time, since that takes no time.
    pub settings: fn(&Work) -> Option<String>,
    /// Makes the module.
    pub make: fn(&mut Work) -> Result<Made, GenerateError>,
}

/// Every stage, in the order of the specification.
const STAGES: &[Stage] = &[
    Stage {
        kind: ModuleKind::Urdf,
        settings: |_| None,
        make: |work| document(&work.source.reading.robot),
    },
    Stage {
        kind: ModuleKind::Dof,
        settings: |_| None,
        make: |work| document(&work.dof),
    },
    Stage {
        kind: ModuleKind::Chain,
        settings: |_| None,
        make: |work| document(&work.chain),
    },
    Stage {
        kind: ModuleKind::Connections,
        // With hundreds of links it is megabytes of text.
        settings: |_| Some("1".to_owned()),
        make: connections,
    },
    Stage {
        kind: ModuleKind::Bounds,
        settings: |_| None,
        make: |work| document(&work.bounds),
    },
    Stage {
        kind: ModuleKind::KinematicsSamples,
        settings: |_| None,
        make: |work| document(&work.samples),
    },
    Stage {
        kind: ModuleKind::OriginalMeshes,
        settings: |_| None,
        make: meshes,
    },
    Stage {
        kind: ModuleKind::PlainMeshes,
        settings: geometry::plain_settings,
        make: geometry::plain,
    },
    Stage {
        kind: ModuleKind::ConvexHullMeshes,
        settings: |_| Some(String::new()),
        make: geometry::hulls,
    },
    Stage {
        kind: ModuleKind::ConvexDecompositionMeshes,
        settings: geometry::decomposition_settings,
        make: geometry::pieces,
    },
    Stage {
        kind: ModuleKind::LinkShapesApproximations,
        settings: |_| Some(String::new()),
        make: geometry::boxes_and_spheres,
    },
    Stage {
        kind: ModuleKind::LinkShapesMaxDistanceFromOrigin,
        settings: |_| Some(String::new()),
        make: geometry::distances_from_origin,
    },
    Stage {
        kind: ModuleKind::LinkShapesDistanceStatistics,
        settings: geometry::statistics_settings,
        make: geometry::distance_statistics,
    },
    Stage {
        kind: ModuleKind::LinkShapesSimpleSkips,
        settings: |_| Some(String::new()),
        make: geometry::skips_by_distance,
    },
    Stage {
        kind: ModuleKind::LinkShapesSkips,
        settings: geometry::skips_settings,
        make: geometry::edited_skips,
    },
];

/// The modules that there are stages for, in the order of the specification.
pub(super) fn kinds() -> Vec<ModuleKind> {
    STAGES.iter().map(|stage| stage.kind).collect()
}

/// The stage of a module.
pub(super) fn of(kind: ModuleKind) -> Option<&'static Stage> {
    STAGES.iter().find(|stage| stage.kind == kind)
}

pub(super) fn document(module: &impl Serialize) -> Result<Made, GenerateError> {
    let document = serde_json::to_value(module).map_err(|error| GenerateError::Internal {
        file: String::new(),
        reason: error.to_string(),
    })?;
    let files = Vec::new();
    Ok(Made {
        document: Document::Whole(document),
        files,
    })
}

/// With 300 links in a line these are 8 million numbers.
fn connections(work: &mut Work) -> Result<Made, GenerateError> {
    let module = connections::connections_module(&work.chain);
    let document = Document::Lists(vec![
        ("root_paths", Some(Rows::new(module.root_paths))),
        (
            "lowest_common_ancestors",
            Some(Rows::new(module.lowest_common_ancestors)),
        ),
        (
            "link_to_link_paths",
            module.link_to_link_paths.map(Rows::new),
        ),
        (
            "link_connection_paths",
            module.link_connection_paths.map(Rows::new),
        ),
    ]);
    let files = Vec::new();
    Ok(Made { document, files })
}

fn meshes(work: &mut Work) -> Result<Made, GenerateError> {
    let source = work.source;
    let mut original = original_meshes(
        &source.reading.robot,
        &source.folder,
        &work.settings.packages,
        &source.shown,
        &source.mesh_places,
    );
    work.notes.append(&mut original.notes);
    let files = original.files.iter().map(|(path, from)| MadeFile {
        path: path.clone(),
        content: Content::CopyOf(from.clone()),
    });
    let files = files.collect();
    let made = document(&original.module)?;
    work.original = Some(original);
    Ok(Made { files, ..made })
}
