//! URDF+: `<loop>` and `<coupling>` elements of a URDF, and joints that are `independent`.
//!
//! Facts: M. Chignoli et al., URDF+ (2024), and the parser of generalized_rbda. A loop's axis is z of both frames; a coupling
//! says that the joints down to its successor move `ratio` times as far as those down to its predecessor.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use toml::Spanned;
use urdd_directory::account::{Account, AccountError};
use urdd_directory::export_toml::unplaced;
use urdd_directory::loops_toml::{CouplingTable, FrameTable, LoopTable, kind_of};
use urdd_format::loops::LoopKind;
use urdd_format::short::Short;
use urdd_kinematics::rotation::{from_rpy, from_z, to_rpy, unit_axis};
use urdd_xml::Node;
use urdd_xml::element::{attribute, children};

use super::said::Said;
use crate::note::{Note, NoteKind, SourcePlace};

/// What is wrong with an element, and where it begins.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoopFault {
    /// Byte offset.
    pub offset: usize,
    /// What is wrong.
    pub fault: String,
    /// What is assumed.
    pub assumed: String,
}

/// More would be made of an element than the account has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CostlyElement {
    /// Where it begins, byte offset.
    pub offset: usize,
    /// Why.
    pub error: AccountError,
}

/// Charged for a joint between two links of a coupling: what is made of the term, here and in all that reads it.
const TERM: usize = 400;
/// The same, for each byte of its name.
const LETTER: usize = 4;
/// Charged for a joint above a link of a coupling, which is looked up.
const STEP: usize = 10;

/// As [`urdf_plus`], with the places of its elements, and a note about each that is left out.
pub fn placed_urdf_plus(
    robot: Node<'_, '_>,
    places_of: impl FnOnce(Vec<usize>) -> Vec<SourcePlace>,
    notes: &mut Vec<Note>,
    account: &Account,
) -> Result<Option<Said>, CostlyElement> {
    let Some((mut said, faults)) = urdf_plus(robot, account)? else { return Ok(None) };
    let of_faults = faults.iter().map(|fault| fault.offset);
    let offsets: Vec<usize> = said.offsets().chain(of_faults).collect();
    let mut places = places_of(offsets.clone());
    let of_faults = places.split_off(places.len().saturating_sub(faults.len()));
    said.places = offsets.into_iter().zip(places).collect();
    notes.extend(
        faults
            .into_iter()
            .zip(of_faults)
            .map(|(fault, place)| Note::at(place, NoteKind::LeftOut, fault.fault, fault.assumed)),
    );
    Ok(Some(said))
}

/// The loops and couplings of a URDF, whose `<robot>` is given, and each element that is not as URDF+ has it; `None` if it has no such elements.
///
/// # Errors
/// If couplings have more joints together than the account allows.
pub fn urdf_plus(
    robot: Node<'_, '_>,
    account: &Account,
) -> Result<Option<(Said, Vec<LoopFault>)>, CostlyElement> {
    let elements = || children(robot);
    if !elements().any(|(name, _)| matches!(name, "loop" | "coupling")) {
        return Ok(None);
    }
    let mut said = Said::default();
    let mut faults = Vec::new();
    let mut joints: HashMap<&str, (Arc<str>, &str)> = HashMap::new();
    let mut independent = Vec::new();
    let mut says_independent = false;
    for (_, joint) in elements().filter(|(name, _)| *name == "joint") {
        let link = |end: &str| only(joint, end).and_then(|end| attribute(end, "link"));
        let (Some(name), Some(parent), Some(child)) =
            (attribute(joint, "name"), link("parent"), link("child"))
        else {
            continue;
        };
        joints.insert(child.value(), (name.value().into(), parent.value()));
        let word = attribute(joint, "independent");
        match word.map(|word| word.value().trim().to_ascii_lowercase()).as_deref() {
            Some("true") => {
                says_independent = true;
                said.first.push(name.value().to_owned());
            }
            Some("false") => {
                says_independent = true;
                continue;
            }
            Some(_) => {
                let at = word.map_or(0, |word| word.range().start);
                let (word, name) = (word.map_or("", |word| word.value()), name.value());
                let (word, name) = (Short::of(word), Short::of(name));
                faults.push(LoopFault {
                    assumed: format!("the joint `{name}` is as if it were not there"),
                    ..fault(at, format!("`independent=\"{word}\"` is neither true nor false"))
                });
            }
            None => {}
        }
        independent.push(unplaced(name.value().to_owned()));
    }
    said.file.independent = says_independent.then_some(independent);
    let links = elements().filter(|(name, _)| *name == "link");
    let links = links.filter_map(|(_, link)| Some(attribute(link, "name")?.value()));
    let tree = Tree { links: links.collect(), joints };
    for (name, element) in elements() {
        let place = element.range();
        let read = match name {
            "loop" => of_loop(element).map(|one| said.file.loops.push(Spanned::new(place, one))),
            "coupling" => match of_coupling(element, &tree, account) {
                Ok(one) => {
                    said.file.couplings.push(Spanned::new(place, one));
                    Ok(())
                }
                Err(Refused::Fault(fault)) => Err(fault),
                Err(Refused::Costly(error)) => {
                    return Err(CostlyElement { offset: place.start, error });
                }
            },
            _ => continue,
        };
        if let Err(fault) = read {
            let called = attribute(element, "name").map_or("without a name", |name| name.value());
            faults.push(LoopFault {
                fault: format!("this is no loop or coupling of URDF+: {}", fault.fault),
                assumed: format!("the {name} `{}` is left out", Short::of(called)),
                ..fault
            });
        }
    }
    Ok(Some((said, faults)))
}

struct Tree<'a> {
    links: HashSet<&'a str>,
    /// For each child, its joint and parent.
    joints: HashMap<&'a str, (Arc<str>, &'a str)>,
}

enum Refused {
    Fault(LoopFault),
    Costly(AccountError),
}

impl From<LoopFault> for Refused {
    fn from(fault: LoopFault) -> Self {
        Refused::Fault(fault)
    }
}

impl From<AccountError> for Refused {
    fn from(error: AccountError) -> Self {
        Refused::Costly(error)
    }
}

fn fault(offset: usize, fault: impl Into<String>) -> LoopFault {
    LoopFault { offset, fault: fault.into(), assumed: String::new() }
}

fn only<'a>(parent: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    children(parent).find(|(of, _)| *of == name).map(|(_, element)| element)
}

fn text(element: Node<'_, '_>, name: &str) -> Result<String, LoopFault> {
    attribute(element, name)
        .map(|attribute| attribute.value().to_owned())
        .ok_or_else(|| fault(element.range().start, format!("this element needs `{name}`")))
}

fn child<'a>(element: Node<'a, 'a>, name: &str) -> Result<Node<'a, 'a>, LoopFault> {
    only(element, name)
        .ok_or_else(|| fault(element.range().start, format!("a `{name}` is missing here")))
}

fn numbers(element: Node<'_, '_>, name: &str) -> Result<Option<[f64; 3]>, LoopFault> {
    let Some(attribute) = attribute(element, name) else { return Ok(None) };
    let numbers: Vec<f64> =
        attribute.value().split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let is_finite = numbers.iter().all(|number: &f64| number.is_finite());
    match <[f64; 3]>::try_from(numbers) {
        Ok(three) if is_finite => Ok(Some(three)),
        _ => Err(fault(attribute.range().start, format!("`{name}` is not three finite numbers"))),
    }
}

fn of_loop(element: Node<'_, '_>) -> Result<LoopTable, LoopFault> {
    let word = text(element, "type")?;
    let kind = match word.trim().eq_ignore_ascii_case("continuous") {
        true => LoopKind::Revolute,
        false => kind_of(&word).map_err(|known| fault(element.range().start, known))?,
    };
    // Where none is said, it is that of a joint (SPEC 5.7).
    let mut xyz = [1.0, 0.0, 0.0];
    let said = only(element, "axis");
    if let Some(axis) = said {
        xyz = numbers(axis, "xyz")?.unwrap_or(xyz);
    }
    let at = said.unwrap_or(element).range().start;
    let axis = unit_axis(xyz).ok_or_else(|| fault(at, "this axis has no direction"))?.into_inner();
    let (a, b) = (child(element, "predecessor")?, child(element, "successor")?);
    let turn = from_z(&axis);
    Ok(LoopTable {
        name: text(element, "name")?,
        kind,
        link_a: Spanned::new(a.range(), text(a, "link")?),
        frame_a: frame(a, &turn)?,
        link_b: Spanned::new(b.range(), text(b, "link")?),
        frame_b: frame(b, &turn)?,
    })
}

fn frame(end: Node<'_, '_>, turn: &UnitQuaternion<f64>) -> Result<FrameTable, LoopFault> {
    let origin = only(end, "origin");
    let of = |name: &str| match origin {
        Some(origin) => Ok(numbers(origin, name)?.unwrap_or_default()),
        None => Ok([0.0; 3]),
    };
    let (xyz, rpy) = (of("xyz")?, of("rpy")?);
    let pose = Isometry3::from_parts(Translation3::from(xyz), from_rpy(rpy) * turn);
    Ok(table(&pose))
}

/// A frame as a table of `NAME.loops.toml`.
pub fn table(pose: &Isometry3<f64>) -> FrameTable {
    let matrix = pose.rotation.to_rotation_matrix();
    FrameTable { xyz: pose.translation.vector.into(), rpy: to_rpy(matrix.matrix()) }
}

/// `ratio` times the joints down to the predecessor, less those down to the successor.
fn of_coupling(
    element: Node<'_, '_>,
    tree: &Tree<'_>,
    account: &Account,
) -> Result<CouplingTable, Refused> {
    let (a, b) = (child(element, "predecessor")?, child(element, "successor")?);
    let ratio = child(element, "ratio")?;
    let value = text(ratio, "value")?.trim().parse::<f64>().ok().filter(|ratio| ratio.is_finite());
    let value =
        value.ok_or_else(|| fault(ratio.range().start, "the ratio is not a finite number"))?;
    let path = |end: Node<'_, '_>| -> Result<Vec<&Arc<str>>, Refused> {
        let named = text(end, "link")?;
        let mut at = named.as_str();
        if !tree.links.contains(at) {
            let unknown = format!("there is no link `{}`", Short::of(at));
            return Err(fault(end.range().start, unknown).into());
        }
        let mut path = Vec::new();
        while let Some((joint, parent)) = tree.joints.get(at)
            && path.len() <= tree.joints.len()
        {
            account.charge(STEP + at.len())?;
            path.push(joint);
            at = parent;
        }
        Ok(path)
    };
    let (mut to_a, mut to_b) = (path(a)?, path(b)?);
    let is_same = |a: &Arc<str>, b: &Arc<str>| Arc::ptr_eq(a, b) || a == b;
    while let (Some(last), Some(other)) = (to_a.last(), to_b.last())
        && is_same(last, other)
    {
        to_a.pop();
        to_b.pop();
    }
    let mut terms = BTreeMap::new();
    for (joints, coefficient) in [(to_a, value), (to_b, -1.0)] {
        let coefficients: Arc<[f64]> = [coefficient].into();
        for joint in joints {
            account.charge(TERM + LETTER * joint.len())?;
            terms.insert(unplaced(Arc::clone(joint)), Arc::clone(&coefficients));
        }
    }
    let name = text(element, "name")?;
    if terms.is_empty() {
        let none = "no joint is between the two links of this coupling";
        return Err(fault(element.range().start, none).into());
    }
    Ok(CouplingTable { name, constant: 0.0, terms })
}
