//! What MuJoCo refuses a file for, and an import reads: it is said.

use std::collections::HashSet;

use super::super::features::Tally;
use super::super::model::Inertial;
use super::super::place::Place;
use super::assets::{Assets, Folder};
use super::body::{Made, RawBody, WORLD};
use super::element::Element;
use super::geom::GeomKind;
use super::principal::principal;
use urdd_format::short::Short;

/// MuJoCo's mjMINVAL: masses and moments that are not above it are none.
const LEAST: f64 = 1e-15;

/// Says what MuJoCo refuses.
pub fn say(
    root: &Element,
    all: &[RawBody<'_>],
    made: &Made,
    assets: &Assets<'_>,
    tally: &mut Tally,
) {
    let mut said = |place: Place, what: String| {
        let what = what.replace(char::is_control, " ");
        tally.remark(place, format!("MuJoCo refuses the file: {what}"));
    };
    let mut names = HashSet::new();
    for section in &root.children {
        twice(section, &section.tag, &mut names, &mut said);
    }
    for asset in root.sections("asset") {
        let folder = if asset.tag == "mesh" { Folder::Meshes } else { Folder::Textures };
        let is_file = matches!(asset.tag.as_str(), "mesh" | "texture" | "hfield" | "skin");
        let file = asset.text("file").filter(|_| is_file);
        if let Some(Err(why)) = file.map(|file| assets.find(file, folder, asset.place)) {
            said(asset.place, why.fault.to_string());
        }
    }
    for body in all.iter().filter(|body| body.inertials > 1) {
        said(body.place, "a body has two `<inertial>`; keep one".to_owned());
    }
    let has_mass = masses(all, made);
    let mut moves = vec![false; all.len()];
    for (index, body) in all.iter().enumerate().skip(WORLD + 1) {
        moves[index] = !body.joints.is_empty() || body.parent.is_some_and(|parent| moves[parent]);
        let planes = body.geoms.iter().filter(|geom| geom.kind == GeomKind::Plane);
        for plane in planes.filter(|_| moves[index]) {
            said(plane.place, "a plane is in a body that moves".to_owned());
        }
        if !body.joints.is_empty() && made.index.contains_key(&index) && !has_mass[index] {
            let name = Short::of(body.name.as_deref().unwrap_or_default());
            let text = format!(
                "the body `{name}` moves without mass or without inertia; give it an `<inertial>`"
            );
            said(body.place, text.replace(" ``", ""));
        }
    }
}

/// Whether each body of the robot has mass and inertia, or one that is fixed to it.
fn masses(all: &[RawBody<'_>], made: &Made) -> Vec<bool> {
    let is_enough = |of: &Inertial| of.mass > LEAST && principal(&of.inertia).0[2] > LEAST;
    let own = |index: &usize| {
        let body = made.index.get(index).map(|made_index| &made.bodies[*made_index]);
        body.and_then(|body| body.inertial.as_ref()).is_some_and(is_enough)
    };
    let mut has_mass: Vec<bool> = (0..all.len()).map(|index| own(&index)).collect();
    for (index, body) in all.iter().enumerate().rev().filter(|(_, body)| body.joints.is_empty()) {
        if let Some(parent) = body.parent {
            has_mass[parent] |= has_mass[index];
        }
    }
    has_mass
}

/// Names that stand twice for things of one kind. Bodies, joints and meshes with one are refused here, too.
fn twice<'e>(
    element: &'e Element,
    section: &'e str,
    names: &mut HashSet<(&'e str, &'e str)>,
    said: &mut impl FnMut(Place, String),
) {
    for child in &element.children {
        let kind = match (section, child.tag.as_str()) {
            ("worldbody", tag @ ("geom" | "site" | "camera" | "light")) => tag,
            ("asset", tag @ ("material" | "texture" | "hfield")) => tag,
            ("actuator" | "tendon" | "sensor" | "equality" | "keyframe", _) => section,
            _ => "",
        };
        let name = child.text("name").filter(|_| !kind.is_empty());
        if let Some(name) = name.filter(|name| !names.insert((kind, name))) {
            let name = Short::of(name);
            said(child.place, format!("two of `<{}>` are named `{name}`", child.tag));
        }
        if section == "worldbody" {
            twice(child, section, names, said);
        }
    }
}
