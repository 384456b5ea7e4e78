//! MJCF: bodies, joints, our shapes as geoms, and pairs of links that need no check as `<exclude>`.
//!
//! A floating joint is three slides and a ball, whatever it sits on, so that its position is that of the child in the
//! joint's frame, as here; a free joint's would be in the world. The root link is fixed to the world. Mimics are
//! equality constraints, which MuJoCo holds in simulation: whoever sets positions sets those of mimic joints too.
//! MuJoCo's own filter of parents and children is switched off, so that the pairs are those of the URDD; it never
//! checks two bodies without a joint between them.

mod body;
mod inertia;
mod joint;

use super::Export;
use super::element::Element;
use super::error::{ExportError, Note};
use super::numbers::numbers;
use super::subject::Subject;
use body::{Bodies, Made};

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut bodies = Bodies::new(subject)?;
    let world = bodies.world()?;
    let Made {
        assets,
        files,
        bounded,
        balanced,
        mut notes,
    } = bodies.finish();
    let mut compiler = Element::new("compiler")
        .with("angle", "radian")
        .with("autolimits", "true");
    if balanced {
        compiler = compiler.with("balanceinertia", "true");
    }
    if bounded {
        compiler = compiler
            .with("boundmass", "1e-6")
            .with("boundinertia", "1e-9");
    }
    let mut root = Element::new("mujoco").with("model", subject.urdf.name.as_str());
    root.push(compiler);
    let flag = Element::new("flag").with("filterparent", "disable");
    root.push(Element::new("option").holding(flag));
    root.push(classes());
    if !assets.is_empty() {
        root.push(assets);
    }
    root.push(world);
    let equality = equality(subject, &mut notes);
    if !equality.is_empty() {
        root.push(equality);
    }
    let contact = contact(subject);
    if !contact.is_empty() {
        root.push(contact);
    }
    notes.extend(subject.notes());
    let mut comments = subject.origin()?;
    comments.push(format!("Geoms for collision: {}.", subject.options.shapes));
    Ok(Export {
        text: root.document(&comments),
        files,
        notes,
    })
}

/// Links have the mass of the URDF, so geoms have none.
fn classes() -> Element {
    let geom = |class: &'static str, geom: Element| {
        let geom = geom.with("density", "0");
        Element::new("default").with("class", class).holding(geom)
    };
    let collision = Element::new("geom").with("group", "3");
    let visual = Element::new("geom")
        .with("group", "2")
        .with("contype", "0")
        .with("conaffinity", "0");
    Element::new("default")
        .holding(geom("collision", collision))
        .holding(geom("visual", visual))
}

fn contact(subject: &Subject) -> Element {
    let mut contact = Element::new("contact");
    for pair in subject.disabled() {
        let [a, b] = pair.links.map(|link| subject.links[link].as_str());
        contact.push(Element::new("exclude").with("body1", a).with("body2", b));
    }
    contact
}

/// The mimics: `position = offset + multiplier * position of the driver`.
fn equality(subject: &Subject, notes: &mut Vec<Note>) -> Element {
    let mut equality = Element::new("equality");
    for joint in &subject.view.joints {
        let Some(mimic) = joint.active_mimic() else {
            continue;
        };
        let driver = subject.view.joint(&mimic.joint);
        let driver = driver.map(|driver| &subject.view.joints[driver]);
        let Some(driver) = driver else {
            continue;
        };
        let mut element = Element::new("joint").with("joint1", joint.name.as_str());
        let factor = match driver.num_dofs() {
            1 => {
                element = element.with("joint2", driver.name.as_str());
                mimic.multiplier
            }
            // A fixed joint stands at 0.
            0 => 0.0,
            _ => {
                notes.push(Note::Joint {
                    joint: joint.name.clone(),
                    what: "it follows a joint of several DOFs, which MuJoCo cannot say; it moves freely",
                });
                continue;
            }
        };
        let coefficients = numbers(&[mimic.offset, factor, 0.0, 0.0, 0.0]);
        equality.push(element.with("polycoef", coefficients));
    }
    equality
}
