//! What a model says that is not for the robot, or is not read: all of it is counted.

use super::super::features::{self, Tally};
use super::attach::KEYS;
use super::defaults::CLASSES;
use super::element::Element;
use urdd_format::short::Short;

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
            "tendon" => count(section, features::TENDONS, tally),
            "sensor" => count(section, features::MEASURED, tally),
            "deformable" => count(section, features::SOFT, tally),
            KEYS => section.children.iter().for_each(|_| tally.unread("keys of attached models")),
            "custom" => count(section, features::OWN_DATA, tally),
            tag => tally.unread(format!("<{tag}>")),
        }
    }
}

fn count(section: &Element, feature: features::Feature, tally: &mut Tally) {
    for _ in &section.children {
        tally.count(feature);
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
