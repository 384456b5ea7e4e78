//! URDF+: `<loop>` and `<coupling>` elements of a URDF, and joints that are `independent`.
//!
//! Facts: M. Chignoli et al., URDF+ (2024), and the parser of generalized_rbda. A loop's axis is z of both frames; a coupling
//! says that the joints down to its successor move `ratio` times as far as those down to its predecessor.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use toml::Spanned;
use urdd_directory::export_toml::unplaced;
use urdd_directory::loops_toml::{CouplingTable, File, FrameTable, LoopTable};
use urdd_format::loops::LoopKind;
use urdd_kinematics::rotation::{from_rpy, from_z, to_rpy, unit_axis};
use urdd_xml::element::{attribute, children};
use urdd_xml::{Document, Node};

use super::said::Said;

/// What is wrong with an element, and where it begins.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoopFault {
    /// Byte offset.
    pub offset: usize,
    /// What is wrong.
    pub fault: String,
}

/// The loops and couplings of a URDF; `None` if it has none.
///
/// # Errors
/// The first element that is not as URDF+ has it.
pub fn urdf_plus(document: &Document<'_>) -> Result<Option<Said>, LoopFault> {
    let robot = document.root_element();
    let elements = || children(robot);
    if !elements().any(|(name, _)| matches!(name, "loop" | "coupling")) {
        return Ok(None);
    }
    let mut file = File::default();
    let mut joints: HashMap<&str, (&str, &str)> = HashMap::new();
    let mut independent = Vec::new();
    let mut says_independent = false;
    for (_, joint) in elements().filter(|(name, _)| *name == "joint") {
        let link = |end: &str| only(joint, end).and_then(|end| attribute(end, "link"));
        let (Some(name), Some(parent), Some(child)) =
            (attribute(joint, "name"), link("parent"), link("child"))
        else {
            continue;
        };
        joints.insert(child.value(), (name.value(), parent.value()));
        let word = attribute(joint, "independent").map(|word| word.value());
        says_independent |= word.is_some();
        if word != Some("false") {
            independent.push(unplaced(name.value().to_owned()));
        }
    }
    file.independent = says_independent.then_some(independent);
    for (name, element) in elements() {
        let begin = element.range().start;
        match name {
            "loop" => file.loops.push(Spanned::new(element.range(), of_loop(element)?)),
            "coupling" => {
                let coupling = of_coupling(element, &joints)?;
                let none = || fault(begin, "no joint is between the two links of this coupling");
                let coupling = coupling.ok_or_else(none)?;
                file.couplings.push(Spanned::new(element.range(), coupling));
            }
            _ => {}
        }
    }
    Ok(Some(Said { file, ..Said::default() }))
}

fn fault(offset: usize, fault: impl Into<String>) -> LoopFault {
    LoopFault { offset, fault: fault.into() }
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
    let kind = LoopKind::ALL
        .iter()
        .copied()
        .find(|kind| kind.as_str().eq_ignore_ascii_case(word.trim()))
        .or_else(|| (word.trim() == "continuous").then_some(LoopKind::Revolute));
    let kind = kind.ok_or_else(|| {
        let known: Vec<&str> = LoopKind::ALL.iter().map(|kind| kind.as_str()).collect();
        let known = known.join(", ").to_lowercase();
        let known = format!("`{}` is no kind of loop; there are {known}", word.escape_debug());
        fault(element.range().start, known)
    })?;
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

/// `ratio` times the joints down to the predecessor, less those down to the successor. `None` without such joints.
fn of_coupling(
    element: Node<'_, '_>,
    joints: &HashMap<&str, (&str, &str)>,
) -> Result<Option<CouplingTable>, LoopFault> {
    let (a, b) = (child(element, "predecessor")?, child(element, "successor")?);
    let ratio = child(element, "ratio")?;
    let value = text(ratio, "value")?.trim().parse::<f64>().ok().filter(|ratio| ratio.is_finite());
    let value =
        value.ok_or_else(|| fault(ratio.range().start, "the ratio is not a finite number"))?;
    let path = |end: Node<'_, '_>| -> Result<Vec<String>, LoopFault> {
        let mut at = text(end, "link")?;
        let mut path = Vec::new();
        while let Some((joint, parent)) = joints.get(at.as_str())
            && path.len() <= joints.len()
        {
            path.push((*joint).to_owned());
            at = (*parent).to_owned();
        }
        Ok(path)
    };
    let (mut to_a, mut to_b) = (path(a)?, path(b)?);
    while to_a.last().is_some_and(|last| to_b.last() == Some(last)) {
        to_a.pop();
        to_b.pop();
    }
    let mut terms = BTreeMap::new();
    terms.extend(to_a.into_iter().map(|joint| (unplaced(joint), vec![value])));
    terms.extend(to_b.into_iter().map(|joint| (unplaced(joint), vec![-1.0])));
    let name = text(element, "name")?;
    Ok((!terms.is_empty()).then_some(CouplingTable { name, constant: 0.0, terms }))
}
