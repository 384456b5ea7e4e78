//! Lists of spheres that people have: cuRobo's YAML and Foam's JSON.

use serde_json::{Map, Value};
use thiserror::Error;
use urdd_directory::limits::MAX_SPHERES_BYTES;
use urdd_format::link_shapes_spheres::SPHERES_MAX_IN_LEVEL;
use urdd_format::short::Short;
use urdd_spheres::model::Sphere;
use urdd_spheres::model::SphereList;

/// The farthest that a centre may be, and the largest radius, m.
const FARTHEST: f64 = 1e9;

/// Why a list of spheres cannot be read.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ListError {
    /// It is not YAML or JSON.
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
pub fn read_spheres(text: &str) -> Result<SphereList, ListError> {
    if text.len() as u64 > MAX_SPHERES_BYTES {
        return Err(ListError::TooLong);
    }
    let document: Value =
        serde_yaml::from_str(text).map_err(|error| ListError::Text(error.to_string()))?;
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
    match list.links.is_empty() {
        true => Err(ListError::NoSpheres),
        false => Ok(list),
    }
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
        list.links.push((name.clone(), spheres));
        if list.count() > SPHERES_MAX_IN_LEVEL {
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
