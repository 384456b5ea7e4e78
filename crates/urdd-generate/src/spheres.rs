//! The stage that makes `link_shapes_spheres_module`: SPEC 8.9.

use nalgebra::Isometry3;

use super::checked_pieces::CheckedPieces;
use super::context::Context;
use super::error::Result;
use super::made::{Made, made};
use super::meshes::written::WrittenMesh;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_format::registry::ModuleKind;
use urdd_kinematics::ConfigurationError;
use urdd_source::note::NoteKind;
use urdd_spheres::module::{Given, NoSpheres, Subject, module};
use urdd_spheres::pairs::Pairs;
use urdd_spheres::samples::Moves;

/// Fits and nests spheres, or takes those that a person gave.
pub(super) fn spheres(
    context: &Context,
    pieces: &[Vec<WrittenMesh>],
    skips: &LinkShapesSkipsModule,
) -> Result<Made> {
    let pieces = CheckedPieces::new(pieces, skips);
    let pairs = Pairs::new(pieces.in_order(), |a, b| pieces.is_checked(a, b))
        .map_err(|error| context.unmeasurable(pieces.fault(error)))?;
    if pairs.links.is_empty() {
        let problem = "no link has a shape, so there is nothing that spheres could stand for";
        return Ok(context.of_no_use(ModuleKind::LinkShapesSpheres, problem.to_owned()));
    }
    let names: Vec<&str> =
        context.chain.links_in_chain.iter().map(|link| link.name.as_str()).collect();
    let given: Vec<Given> = context.spheres.iter().map(|list| list.by_link(&names)).collect();
    let subject =
        Subject { robot: &Moving(context), pairs: &pairs, num_links: names.len(), given: &given };
    let progress = |done: usize, total: usize| {
        context.progress.part(ModuleKind::LinkShapesSpheres, done, total);
    };
    let mut notes = Vec::new();
    for list in &context.spheres {
        let has_piece = |name: &str| {
            names
                .iter()
                .position(|link| *link == name)
                .is_some_and(|link| pairs.links.contains(&link))
        };
        for (name, spheres) in list.links.iter().filter(|(name, _)| !has_piece(name)) {
            let what = match names.contains(&name.as_str()) {
                true => "which has no shape",
                false => "which the robot does not have",
            };
            let problem =
                format!("{} given spheres are of the link `{name}`, {what}", spheres.len());
            notes.push(context.note(NoteKind::LeftOut, problem, "these spheres are left out"));
        }
    }
    match module(&subject, &context.settings.cancellation, &progress) {
        Ok(module) => Ok(Made { notes, ..made(&module)? }),
        Err(NoSpheres::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(NoSpheres::Robot(error)) => Err(context.unmeasurable(error)),
        Err(NoSpheres::Piece(link, error)) => Err(context.unmeasurable(format!(
            "distances cannot be computed for link `{}`: {error}",
            names[link]
        ))),
    }
}

/// The robot, as the modules that are made move it.
struct Moving<'a>(&'a Context<'a>);

impl Moves for Moving<'_> {
    type Error = ConfigurationError;

    fn start(&self) -> Result<Vec<f64>, ConfigurationError> {
        let reference = self.0.reference.as_ref().map(|one| one.configuration.clone());
        Ok(reference.unwrap_or_else(|| self.0.space.default_configuration()))
    }

    fn sampled(&self, k: u64) -> Result<Vec<f64>, ConfigurationError> {
        Ok(self.0.space.sampled(k))
    }

    fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, ConfigurationError> {
        self.0.kinematics.link_poses(configuration)
    }
}
