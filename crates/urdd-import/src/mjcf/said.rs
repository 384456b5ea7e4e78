//! What a model says that is not for the robot, or is not read, all of which is counted; and what MuJoCo refuses a file for,
//! and an import reads.

use std::collections::HashSet;

use urdd_format::short::Short;

use super::assets::{Assets, Folder};
use super::body::{Made, RawBody, WORLD};
use super::document::KEYS;
use super::geom::GeomKind;
use super::inertia::principal;
use super::reading::{CLASSES, Element};
use crate::features::{self, Tally};
use crate::model::Inertial;
use crate::place::Place;

/// Attributes that are read, by whatever element, or counted with it.
const READ: &str = "act active actuatorfrclimited actuatorfrcrange anchor angle armature assetdir autolimits \
    axis axisangle balanceinertia biasprm biastype body body1 body2 boundinertia boundmass \
    builtin childclass class conaffinity content_type contype coordinate count cranksite ctrl \
    ctrllimited ctrlrange damping dampratio density diaginertia discardvisual dyntype euler \
    eulerseq face file fitaabb fitscale forcelimited forcerange friction frictionloss fromto \
    fullinertia gainprm gaintype gear geom1 geom2 gridlayout gridsize hfield inertia \
    inertiafromgeom inertiagrouprange inheritrange joint joint1 joint2 jointinparent kp kv limited mass \
    material mesh meshdir mocap model name offset params polycoef pos prefix qpos quat qvel \
    range ref refpos refquat rgba role scale sep settotalmass shellinertia site size \
    springdamper stiffness strippath texture texturedir timeconst type vertex xyaxes zaxis";

/// Attributes that concern only the simulator or the viewer.
const SETTINGS: &str = "actdim actearly actlimited actrange actuatorgravcomp adhesion align alignfree colorspace \
    condim conflict delay dynprm emission fileback filedown filefront fileleft fileright fileup \
    fluidcoef fluidshape gap group height hflip interp lengthrange margin \
    mark markrgb maxhullvert metallic mpos mquat nchannel normal nsample octree_maxdepth \
    priority random reflectance rgb1 rgb2 roughness saveinertial shininess simple sleep \
    smoothnormal solimp solimpfriction solimplimit solmix solref solreffriction solreflimit \
    specular springref surfacevel texcoord texrepeat texuniform time usethread vflip width";

/// Attributes of cameras: their lenses.
const LENS: &str = "focal focalpixel fovy ipd mode output principal principalpixel projection resolution \
    sensorsize target";

/// Counts what is not read of a model.
pub fn say(root: &Element, tally: &mut Tally) {
    for section in &root.children {
        match section.tag.as_str() {
            "option" | "size" | "visual" | "statistic" => tally.count(features::SETTINGS),
            "compiler" => {
                attributes(section, tally);
                if section.get("fusestatic") == Some("true") {
                    let text = "`fusestatic` is not followed: bodies without joints stay links";
                    tally.remark(section.place, text);
                }
            }
            "default" | "worldbody" | "asset" | CLASSES => inside(section, tally),
            "contact" | "actuator" | "equality" | "keyframe" => each(section, tally),
            "tendon" => tally.add(features::TENDONS, section.children.len()),
            "sensor" => tally.add(features::MEASURED, section.children.len()),
            "deformable" => tally.add(features::SOFT, section.children.len()),
            KEYS => section.children.iter().for_each(|_| tally.unread("keys of attached models")),
            "custom" => tally.add(features::OWN_DATA, section.children.len()),
            tag => tally.unread(format!("<{tag}>")),
        }
    }
}

/// The elements of a section of which all children are of one kind.
fn each(section: &Element, tally: &mut Tally) {
    for element in &section.children {
        match element.tag.as_str() {
            "pair" | "exclude" | "key" | "joint" | "general" | "motor" | "position"
            | "velocity" | "intvelocity" => attributes(element, tally),
            // Counted whole.
            _ => {}
        }
    }
}

fn inside(section: &Element, tally: &mut Tally) {
    for element in &section.children {
        match element.tag.as_str() {
            "body" | "frame" | "replicate" | "default" => {
                attributes(element, tally);
                inside(element, tally);
            }
            "inertial" | "joint" | "freejoint" | "geom" | "site" | "camera" | "mesh"
            | "material" | "texture" | "general" | "motor" | "position" | "velocity"
            | "intvelocity" => {
                attributes(element, tally);
            }
            "light" => tally.count(features::SETTINGS),
            "skin" => tally.count(features::SOFT),
            // Counted where they are met, or of something that is.
            "composite" | "flexcomp" | "hfield" | "model" | "pair" | "equality" | "tendon"
            | "orientation" | "pid" | "damper" | "cylinder" | "muscle" | "adhesion" | "dcmotor" => {
            }
            tag => tally.unread(format!("<{tag}>")),
        }
        for plugin in element.all("plugin").filter(|_| element.tag != "body") {
            tally.unread(format!("<{}> of <{}>", plugin.tag, Short::of(&element.tag)));
        }
    }
}

fn attributes(element: &Element, tally: &mut Tally) {
    for name in element.attribute_names() {
        match name {
            "user" => tally.count(features::OWN_DATA),
            "gravcomp" => {
                let factor = element.text(name).and_then(|text| text.trim().parse::<f64>().ok());
                if factor != Some(0.0) {
                    tally.count(features::GRAVCOMP);
                }
            }
            "fusestatic" => {}
            name if has(LENS, name) => tally.unread("lenses and targets of cameras"),
            name if has(SETTINGS, name) => tally.count(features::SETTINGS),
            name if has(READ, name) => {}
            name => tally.unread(format!("{} of <{}>", Short::of(name), element.tag)),
        }
    }
}

fn has(words: &str, name: &str) -> bool {
    words.split(' ').any(|word| word == name)
}

/// MuJoCo's mjMINVAL: masses and moments that are not above it are none.
const LEAST: f64 = 1e-15;

pub fn say_refused(
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
