//! One of the two robots, opened, and its degrees of freedom: as its modules state them, and as they follow from its joints.

use thiserror::Error;
use urdd_directory::account::Account;
use urdd_directory::discover::DiscoverError;
use urdd_directory::loops_toml::File;
use urdd_document::dof_layout::{DofLayout, bounds_without_limits, describe};
use urdd_document::pose::has_quaternions;
use urdd_document::robot::{Joint, Robot};
use urdd_document::urdd::Urdd;
use urdd_format::diff_report::DiffSide;
use urdd_format::dof::Quantity;
use urdd_format::escape;
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::report::{self, Kind};
use urdd_format::urdf::{JointType, UrdfModule};
use urdd_source::beside::Beside;
use urdd_source::{Settings as SourceSettings, SourceError};
use urdd_xml::other_parts::OtherParts;

use crate::fields::Fields;
use crate::shapes::Shapes;

/// How robots are compared.
#[derive(Debug, Default)]
pub struct Options {
    /// Where the meshes of URDFs are, and how xacro files are expanded.
    pub urdf: SourceSettings,
    /// Whether to leave out findings.
    pub without_findings: bool,
}

/// Why a robot cannot be compared.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DiffError {
    /// The path has no robot.
    #[error(transparent)]
    Discover(DiscoverError),
    /// The path has several URDDs.
    #[error(
        "{}: contains {count} URDDs; give one of them, such as {}",
        escape::line(path),
        escape::line(first)
    )]
    Several {
        /// The path as given.
        path: String,
        /// Number of URDDs.
        count: usize,
        /// Path of the first.
        first: String,
    },
    /// The URDD does not say what its robot is.
    #[error(
        "{}: {}; `urdd validate` says what is wrong with this URDD",
        escape::line(path),
        escape::line(reason)
    )]
    NoRobot {
        /// The path as given.
        path: String,
        /// Why.
        reason: String,
    },
    /// The URDF cannot be read or is not a valid robot.
    #[error("{0}")]
    Urdf(SourceError),
    /// Validation was cancelled.
    #[error("stopped before it was finished")]
    Cancelled,
}

/// A robot, with all that is compared.
pub struct Side {
    pub(super) path: String,
    pub(super) kind: Kind,
    /// As the URDF describes it.
    pub(super) robot: UrdfModule,
    /// The same with defaults.
    pub(super) view: Robot,
    /// What its URDF says where URDF defines nothing; `None` without a URDF.
    pub(super) other_parts: Option<OtherParts>,
    pub(super) shapes: Shapes,
    pub(super) dofs: Vec<DofState>,
    /// Unless it is a URDF.
    pub(super) urdd: Option<Urdd>,
    /// Its validation, if findings are compared.
    pub(super) validation: Option<report::Urdd>,
    pub(super) beside: Beside,
    /// What its source says of loops; `None` of a URDD, which has a module.
    pub(super) loops: Option<File>,
    pub(super) notes: Vec<String>,
    /// The account of all that is made of it, and of what stands beside it.
    pub(super) account: Account,
}

impl Side {
    pub(super) fn has_quaternions(&self) -> bool {
        has_quaternions(self.robot.version.as_deref())
    }

    /// The other parts of this robot and another, if both have a URDF.
    pub(super) fn others_beside<'a>(&'a self, other: &'a Side) -> [Option<&'a OtherParts>; 2] {
        match (&self.other_parts, &other.other_parts) {
            (Some(own), Some(others)) => [Some(own), Some(others)],
            _ => [None, None],
        }
    }

    pub(super) fn link_names(&self) -> Vec<&str> {
        self.robot.links.iter().map(|link| link.name.as_str()).collect()
    }

    pub(super) fn joint_names(&self) -> Vec<&str> {
        self.robot.joints.iter().map(|joint| joint.name.as_str()).collect()
    }

    pub(super) fn summary(&self) -> DiffSide {
        DiffSide {
            path: self.path.clone(),
            kind: self.kind,
            name: self.robot.name.clone(),
            links: Count::saturating(self.robot.links.len()),
            joints: Count::saturating(self.robot.joints.len()),
            dofs: Count::saturating(self.dofs.len()),
            verdict: self.validation.as_ref().map(|urdd| urdd.verdict),
        }
    }
}

#[derive(Debug, Clone)]
pub struct DofState {
    pub name: String,
    /// Its values in the modules.
    pub stated: Fields,
    /// Its values as they follow from the joint.
    pub derived: Fields,
}

impl DofState {
    /// The unit of its position: rad or m.
    pub fn unit(&self) -> &'static str {
        match self.stated.shown("quantity") {
            Some(quantity) if quantity == Quantity::Length.as_str() => "m",
            _ => "rad",
        }
    }
}

/// The DOFs of a robot, as they follow from its joints.
pub fn of_robot(robot: &Robot) -> Vec<DofState> {
    let layout = DofLayout::new(robot, false);
    let dofs = (0..layout.joint_of_dof.len()).filter_map(|dof| {
        let (joint, place) = layout.place(dof)?;
        let joint = robot.joints.get(joint)?;
        let derived = derived(joint, place)?;
        Some(DofState { name: name(joint, place)?, stated: derived.clone(), derived })
    });
    dofs.collect()
}

/// The DOFs of a URDD, as `dof_module` and `bounds_module` state them.
pub fn of_urdd(urdd: &Urdd, robot: &Robot, notes: &mut Vec<String>) -> Vec<DofState> {
    let Some(dofs) = urdd.dofs() else {
        let why = "dof_module is missing or unusable; the DOFs are those of the joints";
        notes.push(why.to_owned());
        return of_robot(robot);
    };
    let bounds = urdd.bounds();
    if bounds.is_none() {
        let why = "bounds_module is missing or unusable; bounds are those of the joints";
        notes.push(why.to_owned());
    }
    let mut places = vec![0; robot.joints.len()];
    let mut found = Vec::with_capacity(dofs.dof_idx_to_joint_idx_mapping.len());
    for (index, joint_idx) in dofs.dof_idx_to_joint_idx_mapping.iter().enumerate() {
        let joint = robot.joints.get(joint_idx.get());
        let place = places.get_mut(joint_idx.get()).map_or(0, |place| {
            *place += 1;
            *place - 1
        });
        let derived = joint.and_then(|joint| derived(joint, place));
        let stated_dof = dofs.dofs.get(index);
        let name = match stated_dof {
            Some(dof) => Some(dof.name.clone()),
            None => joint.and_then(|joint| name(joint, place)),
        };
        let derived = derived.unwrap_or_default();
        let stated = match bounds {
            None => derived.clone(),
            Some(bounds) => {
                let pair = bounds.bounds.get(index);
                let one = |side: usize, list: &[f64]| {
                    // Both lists state it; one that departs from the joint is shown.
                    let stated = [pair.map(|pair| pair[side]), list.get(index).copied()];
                    let expected = derived.shown(["lower", "upper"][side]);
                    let expected = expected.and_then(|text| text.parse().ok());
                    let mut stated = stated.into_iter().flatten();
                    let first = stated.clone().next();
                    stated.find(|value| Some(*value) != expected).or(first)
                };
                let (lower, upper) =
                    (one(0, &bounds.dof_lower_bounds), one(1, &bounds.dof_upper_bounds));
                let quantity = match stated_dof {
                    Some(dof) => Some(dof.quantity),
                    None => joint.and_then(|joint| Some(describe(joint.joint_type, place)?.1)),
                };
                let limited = bounds.dof_limited.get(index).copied();
                let limited = limited.or(derived.shown("limited").map(|word| word == "true"));
                let speed = |list: &[Option<f64>]| list.get(index).copied().flatten();
                let (velocity, effort) = if urdd.is_legacy(ModuleKind::Bounds) {
                    let limit = joint.and_then(|joint| joint.limit);
                    (limit.and_then(|limit| limit.velocity), limit.and_then(|limit| limit.effort))
                } else {
                    (speed(&bounds.dof_velocity_limits), speed(&bounds.dof_effort_limits))
                };
                values(quantity, [lower, upper], limited, velocity, effort)
            }
        };
        let name = name.unwrap_or_else(|| format!("DOF {index}"));
        found.push(DofState { name, stated, derived });
    }
    found
}

fn name(joint: &Joint, place: usize) -> Option<String> {
    let (suffix, _) = describe(joint.joint_type, place)?;
    Some(format!("{}{suffix}", joint.name))
}

/// The values that SPEC 6.5 derives from a joint.
fn derived(joint: &Joint, place: usize) -> Option<Fields> {
    let (_, quantity) = describe(joint.joint_type, place)?;
    let limits = joint.position_limits();
    let bounds = match limits {
        Some((lower, upper)) => [lower, upper],
        None => bounds_without_limits(joint.joint_type, place)?,
    };
    let of_one_dof = matches!(
        joint.joint_type,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic
    );
    let limit = joint.limit.filter(|_| of_one_dof);
    Some(values(
        Some(quantity),
        bounds.map(Some),
        Some(limits.is_some()),
        limit.and_then(|limit| limit.velocity),
        limit.and_then(|limit| limit.effort),
    ))
}

fn values(
    quantity: Option<Quantity>,
    [lower, upper]: [Option<f64>; 2],
    limited: Option<bool>,
    velocity: Option<f64>,
    effort: Option<f64>,
) -> Fields {
    let [position, speed, force] = match quantity {
        Some(Quantity::Length) => ["m", "m/s", "N"],
        _ => ["rad", "rad/s", "N m"],
    };
    let mut fields = Fields::default();
    fields.text("quantity", quantity.map(Quantity::as_str));
    fields.number("lower", position, lower);
    fields.number("upper", position, upper);
    fields.text("limited", limited.map(|it| if it { "true" } else { "false" }));
    fields.number("velocity limit", speed, velocity);
    fields.number("effort limit", force, effort);
    fields
}
