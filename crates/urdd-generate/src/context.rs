//! What all stages may use. It is complete before the first stage, and no stage changes it.

use super::donor::edits::{Decisions, Edits};
use super::error::GenerateError;
use super::kinematics_samples::kinematics_samples_module;
use super::meshes::names::mesh_files;
use super::named::Named;
use super::progress::Progress;
use super::settings::Settings;
use super::{bounds, chain, dof, reference};
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::composition::CompositionModule;
use urdd_format::dof::DofModule;
use urdd_format::kinematics_samples::{ConfigurationKind, KinematicsSamplesModule};
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::MeshFiles;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::registry::ModuleKind;
use urdd_format::short::Short;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics, KinematicsError};
use urdd_source::Source;
use urdd_source::fault::Fault;
use urdd_source::note::{Note, NoteKind};

pub(crate) struct Context<'a> {
    pub source: &'a Source,
    pub settings: &'a Settings,
    /// How the robot was composed, if it was.
    pub composition: Option<&'a CompositionModule>,
    /// Receives the progress.
    pub progress: &'a dyn Progress,
    pub dof: DofModule,
    pub chain: ChainModule,
    pub bounds: BoundsModule,
    pub space: ConfigurationSpace,
    pub kinematics: ForwardKinematics,
    pub samples: KinematicsSamplesModule,
    /// The user's edits of the skips.
    pub edits: Edits,
    /// The user's named configurations.
    pub named: Named,
    /// The named configuration in which pairs that touch are skipped, in place of the default configuration.
    pub reference: Option<NamedConfiguration>,
}

/// The fault of a robot whose poses cannot be computed in a configuration; names the joint above the link where it
/// shows.
fn no_poses(kind: ConfigurationKind, error: &ConfigurationError, chain: &ChainModule) -> Fault {
    let ConfigurationError::Overflow { link_idx } = error else {
        return Fault::NoPoses(format!("{kind}: {error}"));
    };
    let mut joints = chain.joints_in_chain.iter();
    let joint = joints.find(|joint| joint.child_link_idx.get() == *link_idx);
    Fault::PosesTooLarge {
        joint: joint.map_or_else(Short::default, |joint| Short::of(&joint.joint_name)),
        configuration: kind.to_string(),
    }
}

impl<'a> Context<'a> {
    /// Builds what nearly every stage needs and takes no time.
    ///
    /// # Errors
    /// If a setting is out of its range, or mimic joints or poses overflow binary64.
    pub fn new(
        source: &'a Source,
        settings: &'a Settings,
        composition: Option<&'a CompositionModule>,
        decisions: Decisions,
        progress: &'a dyn Progress,
    ) -> Result<Self, GenerateError> {
        settings.check()?;
        let reading = &source.reading;
        let refused = |fault| GenerateError::from(source.refused(fault));
        let dof = dof::dof_module(&reading.robot, &reading.tree).map_err(refused)?;
        let chain = chain::chain_module(&reading.robot, &reading.tree);
        let bounds = bounds::bounds_module(&reading.robot, &dof);
        let overflow = |error: KinematicsError| refused(Fault::NoPoses(error.to_string()));
        let space = ConfigurationSpace::new(&dof, &chain, &bounds.bounds).map_err(overflow)?;
        let kinematics = ForwardKinematics::new(&chain, &dof).map_err(overflow)?;
        let samples = kinematics_samples_module(&space, &kinematics)
            .map_err(|(kind, error)| refused(no_poses(kind, &error, &chain)))?;
        let named = Named::of(&decisions.configurations, &dof, &bounds);
        let reference = reference::of(settings.reference.as_deref(), &named)
            .map_err(|fault| GenerateError::Reference { file: source.shown.clone(), fault })?;
        let decisions = match &settings.reference {
            Some(_) => reference::taken(decisions, reference.is_some()),
            None => decisions,
        };
        Ok(Context {
            named,
            reference,
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

    /// The error for geometry out of the range that can be computed.
    pub fn unmeasurable(&self, reason: impl ToString) -> GenerateError {
        GenerateError::Geometry { file: self.source.shown.clone(), reason: reason.to_string() }
    }
}
