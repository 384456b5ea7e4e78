//! Imports a list of spheres that people have, cuRobo's YAML or Foam's JSON: `link_shapes_spheres_module` with a person's
//! spheres in place of fitted ones.

use std::collections::{HashMap, HashSet};

use serde_json::{Map, Value};
use thiserror::Error;

use super::{Moving, checked_pairs};
use crate::ExportError;
use crate::error::unknown;
use urdd_directory::account::{Account, Overdrawn};
use urdd_directory::cancellation::Cancelled;
use urdd_directory::limits::MAX_SPHERES_BYTES;
use urdd_directory::yaml::words::{self, WordsFault};
use urdd_format::link_shapes_spheres::{LinkShapesSpheresModule, SPHERES_MAX_IN_LEVEL};
use urdd_format::registry::ModuleKind;
use urdd_format::short::Short;
use urdd_robot::{Files, Robot, RobotError, ShapeKind};
use urdd_spheres::model::{Sphere, SphereList};
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
    /// The links that the list does not name, and that have the spheres of the level before.
    pub kept: Vec<usize>,
    /// The links with shapes that have no sphere: a check by this level does not see them.
    pub bare: Vec<usize>,
}

/// What becomes of links with shapes that a list does not name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unnamed {
    /// They keep the spheres that they have in the URDD's last level.
    #[default]
    Keep,
    /// They have no spheres.
    Clear,
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
    /// The spheres of some links take too much work.
    #[error("the spheres of {}: {error}", links.join(" and "))]
    Costly {
        /// The links, as they are shown.
        links: Vec<String>,
        /// Why.
        error: Overdrawn,
    },
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
/// origin `Given`. `unnamed` says what becomes of links that it does not name. Spheres of links that the robot does not have, or that have no shape, are left out.
///
/// # Errors
/// If a sphere is out of range, or no link of the list has a shape; if the account does not have what the list takes; if
/// shapes, skips or kinematics of the URDD are missing or unusable.
pub fn import_spheres(
    robot: &Robot,
    list: &SphereList,
    unnamed: Unnamed,
    account: &Account,
) -> Result<ImportedSpheres, SpheresError> {
    let names = robot.link_names()?;
    let pairs = checked_pairs(robot, names, ShapeKind::Pieces, None)?;
    let mut left_out = LeftOut::default();
    for reason in &list.left_out {
        left_out.add(|| reason.clone());
    }
    let places: HashMap<&str, usize> =
        names.iter().enumerate().rev().map(|(place, name)| (name.as_str(), place)).collect();
    let mut taken = 0;
    for (name, spheres) in &list.links {
        check(name, spheres)?;
        match places.get(name.as_str()).copied() {
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
    let mut spheres = list.by_link(names);
    let named: HashSet<&str> = list.links.iter().map(|(name, _)| name.as_str()).collect();
    let before = match unnamed {
        Unnamed::Keep => robot.spheres_module()?.and_then(|mut module| module.levels.pop()),
        Unnamed::Clear => None,
    };
    let open = pairs.links.iter().copied().filter(|link| !named.contains(names[*link].as_str()));
    let mut kept = Vec::new();
    if let Some(level) = before {
        for link in open {
            let of = level.spheres[link].iter();
            spheres[link] =
                of.map(|one| Sphere { centre: one.offset_xyz, radius: one.radius }).collect();
            if !spheres[link].is_empty() {
                kept.push(link);
            }
        }
    }
    let bare = pairs.links.iter().copied().filter(|link| spheres[*link].is_empty()).collect();
    let given = [spheres];
    let subject =
        Subject { robot: &Moving(robot), pairs: &pairs, num_links: names.len(), given: &given };
    let made = module(&subject, account, &|_, _| ()).map_err(|error| match error {
        NoSpheres::Cancelled(cancelled) => SpheresError::Cancelled(cancelled),
        NoSpheres::Costly(links, error) => {
            let name = |link: &usize| format!("`{}`", Short::of(&names[*link]).escape_debug());
            SpheresError::Costly { links: links.iter().map(name).collect(), error }
        }
        NoSpheres::Robot(error) => error.into(),
        NoSpheres::Piece(link, error) => {
            let module = ModuleKind::ConvexDecompositionMeshes;
            RobotError::Unusable { module, reason: format!("a piece of link {link}: {error}") }
                .into()
        }
    })?;
    let files = robot.with_spheres(&made)?;
    Ok(ImportedSpheres { module: made, files, taken, left_out, kept, bare })
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
        if self.named.len() < MOST_NAMED { self.named.push(reason()) } else { self.more += 1 }
    }

    fn said(mut self) -> Vec<String> {
        if self.more > 0 {
            self.named.push(format!("{} more of the list", self.more));
        }
        self.named
    }
}

/// The farthest that a centre may be, and the largest radius, m.
const FARTHEST: f64 = 1e9;

/// Why a list of spheres cannot be read.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ListError {
    /// It is not YAML or JSON, is nested too deep, or too much is made of it.
    #[error("it cannot be read: {0}")]
    Text(String),
    /// It is no list of spheres.
    #[error(
        "it has no spheres: cuRobo's files have `collision_spheres` with lists by link, Foam's have `spheres` by link"
    )]
    NoSpheres,
    /// The spheres are in another file.
    #[error("its `collision_spheres` are in another file, `{0}`; give that file")]
    Elsewhere(Short),
    /// A sphere cannot be.
    #[error("sphere {number} of link `{link}`: {fault}")]
    Sphere {
        /// The link.
        link: Short,
        /// Its number in the link, from 0.
        number: usize,
        /// What is wrong.
        fault: SphereFault,
    },
    /// The text is too long.
    #[error("it is longer than {} MiB", MAX_SPHERES_BYTES >> 20)]
    TooLong,
    /// There are too many.
    #[error("it has more than {SPHERES_MAX_IN_LEVEL} spheres")]
    TooMany,
}

/// What is wrong with a sphere.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SphereFault {
    /// A key is missing, or no number.
    #[error("`{0}` is missing, or not what it should be")]
    Key(&'static str),
    /// The radius is not positive.
    #[error("the radius {0} is not positive")]
    Radius(f64),
    /// A number is too large.
    #[error("{0} is out of range: at most 1e9 m")]
    Range(f64),
}

/// Reads a list: YAML, of which JSON is a part.
///
/// # Errors
/// If it is no list of spheres.
pub fn read_spheres(text: &str, account: &Account) -> Result<SphereList, ListError> {
    if text.len() as u64 > MAX_SPHERES_BYTES {
        return Err(ListError::TooLong);
    }
    // JSON has no aliases, and YAML's readers keep each word of a line: it may be a key.
    let document: Value = match serde_json::from_str(text) {
        Ok(document) => document,
        Err(_) => of_yaml(text, account)?,
    };
    let kinematics =
        document.pointer("/robot_cfg/kinematics").or_else(|| document.get("kinematics"));
    let of_curobo = [kinematics, Some(&document)].into_iter().flatten();
    let of_curobo = of_curobo.filter_map(|of| of.get("collision_spheres")).next();
    let mut list = SphereList::default();
    match of_curobo {
        Some(Value::Object(links)) => read(links, &mut list, &CUROBO)?,
        Some(Value::String(file)) => return Err(ListError::Elsewhere(Short::of(file))),
        Some(_) => return Err(ListError::NoSpheres),
        None => {
            let links = document.get("links").unwrap_or(&document).as_object();
            read(links.ok_or(ListError::NoSpheres)?, &mut list, &FOAM)?;
        }
    }
    let buffer = kinematics.and_then(|of| of.get("collision_sphere_buffer"));
    if buffer.is_some_and(|buffer| buffer.as_f64() != Some(0.0)) {
        list.left_out.push("`collision_sphere_buffer`: radii are as the list has them".to_owned());
    }
    if list.links.is_empty() { Err(ListError::NoSpheres) } else { Ok(list) }
}

fn of_yaml(text: &str, account: &Account) -> Result<Value, ListError> {
    words::check(text, account).map_err(|WordsFault { line, column, reason }| {
        ListError::Text(format!("{reason} at line {line} column {column}"))
    })?;
    serde_yaml::from_str(text).map_err(|error| ListError::Text(error.to_string()))
}

/// How a form of lists says its spheres.
struct Form {
    /// The key of a link's list; `None` where the link is its list.
    list: Option<&'static str>,
    centre: &'static str,
    /// Whether a radius that is not positive takes a sphere out of use.
    has_unused: bool,
}

const CUROBO: Form = Form { list: None, centre: "center", has_unused: true };
const FOAM: Form = Form { list: Some("spheres"), centre: "origin", has_unused: false };

fn read(links: &Map<String, Value>, list: &mut SphereList, form: &Form) -> Result<(), ListError> {
    let mut count = 0;
    for (name, value) in links {
        let own = match form.list {
            Some(key) => value.get(key),
            None => Some(value),
        };
        let Some(own) = own.and_then(Value::as_array) else { continue };
        let mut spheres = Vec::new();
        for (number, one) in own.iter().enumerate() {
            let fault = |fault| ListError::Sphere { link: Short::of(name), number, fault };
            let radius = one.get("radius").and_then(Value::as_f64);
            let radius = radius.ok_or_else(|| fault(SphereFault::Key("radius")))?;
            let centre = one.get(form.centre).and_then(point);
            let centre = centre.ok_or_else(|| fault(SphereFault::Key(form.centre)))?;
            if form.has_unused && radius <= 0.0 {
                list.left_out.push(format!(
                    "sphere {number} of link `{}`: its radius {radius} takes it out of use",
                    Short::of(name)
                ));
                continue;
            }
            spheres.push(checked(centre, radius).map_err(fault)?);
        }
        count += spheres.len();
        list.links.push((name.clone(), spheres));
        if count > SPHERES_MAX_IN_LEVEL {
            return Err(ListError::TooMany);
        }
    }
    Ok(())
}

fn point(value: &Value) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// Checks the spheres of a link, wherever they are from.
pub(super) fn check(link: &str, spheres: &[Sphere]) -> Result<(), ListError> {
    for (number, sphere) in spheres.iter().enumerate() {
        let link = Short::of(link);
        checked(sphere.centre, sphere.radius).map_err(|fault| ListError::Sphere {
            link,
            number,
            fault,
        })?;
    }
    Ok(())
}

/// A sphere that can be.
fn checked(centre: [f64; 3], radius: f64) -> Result<Sphere, SphereFault> {
    if radius.is_nan() || radius <= 0.0 {
        return Err(SphereFault::Radius(radius));
    }
    let mut numbers = centre.into_iter().chain([radius]);
    match numbers.find(|x| x.is_nan() || x.abs() > FARTHEST) {
        Some(far) => Err(SphereFault::Range(far)),
        None => Ok(Sphere { centre, radius }),
    }
}
