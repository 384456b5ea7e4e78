//! Imports a list of spheres: `link_shapes_spheres_module` with a person's spheres in place of fitted ones.

mod list;

use super::moving::Moving;
use super::pairs;
use crate::ExportError;
use crate::error::unknown;
pub use list::{ListError, SphereFault, read_spheres};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_format::link_shapes_spheres::LinkShapesSpheresModule;
use urdd_format::registry::ModuleKind;
use urdd_format::short::Short;
use urdd_robot::{Files, Robot, RobotError, ShapeKind};
use urdd_spheres::model::SphereList;
use urdd_spheres::module::{NoSpheres, Subject, module};

/// A URDD's spheres after an import.
#[derive(Debug)]
pub struct ImportedSpheres {
    /// The module: levels that cover, and the list as the last level.
    pub module: LinkShapesSpheresModule,
    /// The files of the URDD that change.
    pub files: Files,
    /// How many spheres were taken.
    pub taken: usize,
    /// What of the list was left out, each with the reason.
    pub left_out: Vec<String>,
}

/// Why spheres are not imported.
#[derive(Debug, thiserror::Error)]
pub enum SpheresError {
    /// The list cannot be read.
    #[error(transparent)]
    List(#[from] ListError),
    /// None of its links has a shape.
    #[error("no sphere is of a link of this robot that has a shape: {0}")]
    OtherRobot(String),
    /// A query on the robot failed.
    #[error(transparent)]
    Robot(#[from] ExportError),
    /// It was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<RobotError> for SpheresError {
    fn from(error: RobotError) -> Self {
        SpheresError::Robot(error.into())
    }
}

/// Makes `link_shapes_spheres_module` of a list, in place of the spheres that the URDD has: the list is the last level, its
/// origin `Given`. Spheres of links that the robot does not have, or that have no shape, are left out.
///
/// # Errors
/// If a sphere is out of range, or no link of the list has a shape; if shapes, skips or kinematics of the URDD are missing or
/// unusable.
pub fn import_spheres(
    robot: &Robot,
    list: &SphereList,
    cancellation: &Cancellation,
) -> Result<ImportedSpheres, SpheresError> {
    let names = robot.link_names()?;
    let pairs = pairs::of(robot, names, ShapeKind::Pieces, None)?;
    let mut left_out = LeftOut::default();
    for reason in &list.left_out {
        left_out.add(|| reason.clone());
    }
    let mut taken = 0;
    for (name, spheres) in &list.links {
        list::check(name, spheres)?;
        let link = names.iter().position(|link| link == name);
        match link {
            None => {
                left_out.add(|| unknown("link", name, names.iter().map(String::as_str)).to_string())
            }
            Some(link) if pairs.links.binary_search(&link).is_err() => {
                left_out.add(|| format!("link `{}` has no shape", Short::of(name).escape_debug()));
            }
            Some(_) => taken += spheres.len(),
        }
    }
    let left_out = left_out.said();
    if taken == 0 {
        return Err(SpheresError::OtherRobot(left_out.join("; ")));
    }
    let given = [list.by_link(names)];
    let subject =
        Subject { robot: &Moving(robot), pairs: &pairs, num_links: names.len(), given: &given };
    let made = module(&subject, cancellation, &|_, _| ()).map_err(|error| match error {
        NoSpheres::Cancelled(cancelled) => SpheresError::Cancelled(cancelled),
        NoSpheres::Robot(error) => error.into(),
        NoSpheres::Piece(link, error) => {
            let module = ModuleKind::ConvexDecompositionMeshes;
            RobotError::Unusable { module, reason: format!("a piece of link {link}: {error}") }
                .into()
        }
    })?;
    let files = robot.with_spheres(&made)?;
    Ok(ImportedSpheres { module: made, files, taken, left_out })
}

/// What was left out. Of very many things, the first are named and the others counted.
#[derive(Default)]
struct LeftOut {
    named: Vec<String>,
    more: usize,
}

/// How many are named.
const MOST_NAMED: usize = 20;

impl LeftOut {
    fn add(&mut self, reason: impl FnOnce() -> String) {
        match self.named.len() < MOST_NAMED {
            true => self.named.push(reason()),
            false => self.more += 1,
        }
    }

    fn said(mut self) -> Vec<String> {
        if self.more > 0 {
            self.named.push(format!("{} more of the list", self.more));
        }
        self.named
    }
}
