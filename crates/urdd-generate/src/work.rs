//! The state that stages share.

use std::collections::HashMap;
use std::path::Path;

use super::artifacts::Artifacts;
use super::edits::{Decisions, Edits};
use super::error::GenerateError;
use super::fault::Fault;
use super::meshes::names::mesh_files;
use super::meshes::original::OriginalMeshes;
use super::note::{Note, NoteKind};
use super::progress::Progress;
use super::reuse::Reusable;
use super::settings::Settings;
use super::source::Source;
use super::{bounds, chain, dof, kinematics_samples};
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::composition::CompositionModule;
use urdd_format::dof::DofModule;
use urdd_format::kinematics_samples::KinematicsSamplesModule;
use urdd_format::meshes::MeshFiles;
use urdd_format::registry::ModuleKind;

/// The state that stages share.
pub(super) struct Work<'a> {
    pub source: &'a Source,
    pub settings: &'a Settings,
    pub dof: DofModule,
    pub chain: ChainModule,
    pub bounds: BoundsModule,
    pub samples: KinematicsSamplesModule,
    pub original: Option<OriginalMeshes>,
    /// Meshes and shapes.
    pub artifacts: Artifacts,
    /// The user's edits of the skips.
    pub edits: Edits,
    pub notes: Vec<Note>,
    /// How the robot was composed, if it was.
    pub composition: Option<&'a CompositionModule>,
    /// The SHA-256 of each file that was written or kept, by path.
    pub digests: HashMap<String, String>,
    /// The results of other URDDs for links with the same content.
    pub reusable: Reusable,
    /// Receives the progress.
    pub progress: &'a dyn Progress,
}

impl<'a> Work<'a> {
    /// Builds what nearly every stage needs and takes no time.
    ///
    /// # Errors
    /// If mimic joints or poses overflow binary64.
    pub fn new(
        source: &'a Source,
        settings: &'a Settings,
        root: &Path,
        edits: Decisions,
    ) -> Result<Self, GenerateError> {
        let reading = &source.reading;
        let refused = |fault| source.refused(fault);
        let dof = dof::dof_module(&reading.robot, &reading.tree).map_err(refused)?;
        let chain = chain::chain_module(&reading.robot, &reading.tree);
        let bounds = bounds::bounds_module(&reading.robot, &dof);
        let samples = kinematics_samples::kinematics_samples_module(&dof, &chain, &bounds)
            .map_err(|error| refused(Fault::NoPoses(error.to_string())))?;
        Ok(Work {
            edits: Edits::of(edits, &chain),
            dof,
            chain,
            bounds,
            samples,
            source,
            settings,
            artifacts: Artifacts::new(root),
            original: None,
            notes: Vec::new(),
            composition: None,
            digests: HashMap::new(),
            reusable: Reusable::default(),
            progress: &(),
        })
    }

    /// The file names of a link's mesh, or of one of its pieces.
    pub fn mesh_files(&self, kind: ModuleKind, link: usize, piece: Option<usize>) -> MeshFiles {
        let name = &self.chain.links_in_chain[link].name;
        mesh_files(kind, link, name, piece, self.settings.mesh_formats)
    }

    /// Notes that a part of a module is left out for this robot.
    pub fn leave_out(&mut self, problem: String, assumed: &str) {
        self.note(NoteKind::LeftOut, problem, assumed);
    }

    /// Notes that a table is left out because it would be too large, as the specification allows.
    pub fn too_large(&mut self, problem: String, assumed: &str) {
        self.note(NoteKind::TooLarge, problem, assumed);
    }

    /// Notes that a selected module is left out because it would be of no use.
    pub fn of_no_use(&mut self, problem: String, assumed: &str) {
        self.note(NoteKind::OfNoUse, problem, assumed);
    }

    fn note(&mut self, kind: NoteKind, problem: String, assumed: &str) {
        self.notes.push(Note {
            kind,
            file: self.source.shown.clone(),
            line: 0,
            column: 0,
            problem,
            assumed: assumed.to_owned(),
        });
    }
}
