//! What all stages may use. It is complete before the first stage, and no stage changes it.

use crate::donor::edits::{Decisions, Edits};
use crate::error::{GenerateError, Result};
use crate::given::{Named, reference, without_reference};
use crate::kinematics::kinematics_samples_module;
use crate::loops::{Made, closed};
use crate::meshes::mesh_files;
use crate::settings::{Progress, Settings};
use crate::{kinematics, made};
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::composition::CompositionModule;
use urdd_format::dof::DofModule;
use urdd_format::kinematics_samples::KinematicsSamplesModule;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::loops::LoopsModule;
use urdd_format::meshes::MeshFiles;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::registry::ModuleKind;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics, KinematicsError};
use urdd_source::Source;
use urdd_source::fault::Fault;
use urdd_source::note::{Note, NoteKind};
use urdd_spheres::model::SphereList;

pub(crate) struct Context<'a> {
    pub source: &'a Source,
    pub settings: &'a Settings,
    pub composition: Option<&'a CompositionModule>,
    pub progress: &'a dyn Progress,
    pub dof: DofModule,
    pub chain: ChainModule,
    pub bounds: BoundsModule,
    pub space: ConfigurationSpace,
    pub kinematics: ForwardKinematics,
    pub samples: KinematicsSamplesModule,
    pub edits: Edits,
    pub named: Named,
    /// The configuration in which pairs that touch are skipped, in place of the default configuration: a named one, or the
    /// closed one of a robot with loops.
    pub reference: Option<NamedConfiguration>,
    pub spheres: Vec<SphereList>,
    pub loops: Option<LoopsModule>,
    pub loop_notes: Vec<Note>,
}

impl<'a> Context<'a> {
    /// Builds what nearly every stage needs and takes no time.
    /// Fails if a setting is out of its range, or mimic joints or poses overflow binary64.
    pub fn new(
        source: &'a Source,
        settings: &'a Settings,
        composition: Option<&'a CompositionModule>,
        decisions: Decisions,
        progress: &'a dyn Progress,
    ) -> Result<Self> {
        settings.check()?;
        let reading = &source.reading;
        let refused = |fault| GenerateError::from(source.refused(fault));
        let dof = kinematics::dof_module(&reading.robot, &reading.tree).map_err(refused)?;
        let chain = kinematics::chain_module(&reading.robot, &reading.tree);
        let bounds = kinematics::bounds_module(&reading.robot, &dof);
        let overflow = |error: KinematicsError| refused(Fault::NoPoses(error.to_string()));
        let space = ConfigurationSpace::new(&dof, &chain, &bounds.bounds).map_err(overflow)?;
        let kinematics = ForwardKinematics::new(&chain, &dof).map_err(overflow)?;
        let samples = kinematics_samples_module(&space, &kinematics, &chain).map_err(refused)?;
        let named = Named::of(&decisions.configurations, &dof, &bounds);
        let reference = reference(settings.reference.as_deref(), &named)
            .map_err(|fault| GenerateError::Reference { file: source.shown.clone(), fault })?;
        let found = Made {
            source,
            chain: &chain,
            dof: &dof,
            bounds: &bounds,
            space: &space,
            kinematics: &kinematics,
            cancellation: &settings.source.cancellation,
        };
        let beginning = reference.as_ref().map(|reference| &*reference.configuration);
        let (loops, loop_notes) = found.module(beginning)?;
        let reference = reference.or_else(|| loops.as_ref().and_then(closed));
        let spheres = decisions.spheres.clone();
        let decisions = match settings.reference.is_some() || loops.is_some() {
            true => without_reference(decisions, reference.is_some()),
            false => decisions,
        };
        Ok(Context {
            named,
            reference,
            spheres,
            loops,
            loop_notes,
            edits: Edits::of(decisions, &chain),
            source,
            settings,
            composition,
            progress,
            dof,
            chain,
            bounds,
            space,
            kinematics,
            samples,
        })
    }

    /// The skip reasons of the settings, otherwise those of the user's decisions; sorted, without duplicates.
    pub fn skipped_reasons(&self) -> Vec<SkippedReason> {
        let asked = self.settings.skipped_reasons.as_deref();
        let mut reasons = asked.unwrap_or(&self.edits.skipped_reasons).to_vec();
        if self.reference.is_some() {
            reasons.retain(|reason| *reason != SkippedReason::Default);
        }
        reasons.sort();
        reasons.dedup();
        reasons
    }

    /// The file names of a link's mesh, or of one of its pieces.
    pub fn mesh_files(&self, kind: ModuleKind, link: usize, piece: Option<usize>) -> MeshFiles {
        let name = &self.chain.links_in_chain[link].name;
        mesh_files(kind, link, name, piece, self.settings.mesh_formats)
    }

    /// Reports that a module's work on a mesh of a link is finished.
    pub fn finished(&self, kind: ModuleKind, link: usize) {
        self.progress.link(kind, &self.chain.links_in_chain[link].name);
    }

    /// A note about the whole robot.
    pub fn note(&self, kind: NoteKind, problem: String, assumed: &str) -> Note {
        Note {
            kind,
            file: self.source.shown.clone(),
            line: 0,
            column: 0,
            problem,
            assumed: assumed.to_owned(),
        }
    }

    /// No module, and a note that it would be of no use for this robot.
    pub fn of_no_use(&self, kind: ModuleKind, problem: String) -> made::Made {
        let assumed = format!("{} is left out", kind.name());
        let notes = vec![self.note(NoteKind::OfNoUse, problem, &assumed)];
        made::Made { document: None, files: Vec::new(), notes, product: () }
    }

    /// The error for geometry out of the range that can be computed.
    pub fn unmeasurable(&self, reason: impl ToString) -> GenerateError {
        GenerateError::Geometry { file: self.source.shown.clone(), reason: reason.to_string() }
    }
}
