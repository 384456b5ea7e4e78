//! Joints.

use nalgebra::{Isometry3, Point3, Translation3, Unit, Vector3};

use super::super::features::{self, Tally};
use super::super::model::{Actuator, Joint, JointKind};
use super::super::refusal::{Fallible, at};
use super::actuator::greatest;
use super::compiler::Compiler;
use super::element::Element;
use super::fault::MjcfFault;
use super::reading::{Attributes, View, wrong};

/// A free joint.
pub fn free(element: &Element, name: String) -> Joint {
    Joint::new(name, JointKind::Floating, Isometry3::identity(), element.place)
}

/// A `<joint>` in a frame of its body. Its name is empty where it has none.
pub fn read(
    view: View<'_>,
    name: String,
    frame: &Isometry3<f64>,
    compiler: &Compiler,
    tally: &mut Tally,
) -> Fallible<Joint> {
    let words = ["free", "ball", "slide", "hinge"];
    let kind = view.word("type", &words, "`free`, `ball`, `slide` or `hinge`")?;
    let kind = [JointKind::Floating, JointKind::Ball, JointKind::Slide, JointKind::Hinge]
        [kind.unwrap_or(3)];
    let element = view.element;
    if kind == JointKind::Floating {
        return Ok(free(element, name));
    }
    let position = frame * Point3::from(view.numbers::<3>("pos")?.unwrap_or_default());
    let axis = Vector3::from(view.numbers::<3>("axis")?.unwrap_or([0.0, 0.0, 1.0]));
    let axis = match kind {
        JointKind::Ball => Vector3::z(),
        _ => {
            let wanted = "an axis that is not zero";
            let axis = Unit::try_new(axis, 1e-14);
            frame.rotation * axis.ok_or_else(|| wrong(element, "axis", wanted))?.into_inner()
        }
    };
    let turns = if kind == JointKind::Slide { 1.0 } else { compiler.angle };
    let range = match kind {
        JointKind::Ball => None,
        _ => limits(view, "range", "limited", compiler)?.map(|of| of.map(|end| end * turns)),
    };
    let force = limits(view, "actuatorfrcrange", "actuatorfrclimited", compiler)?;
    if kind == JointKind::Ball {
        let (is_limited, [least, _]) = said_limits(view, "range", "limited", compiler)?;
        if is_limited && least != 0.0 {
            return Err(at(element.place, MjcfFault::BallRange));
        }
        if is_limited {
            tally.count(features::BALL_RANGES);
        }
    }
    let [stiffness, damping] = [view.up_to::<3>("stiffness")?, view.up_to::<3>("damping")?];
    if stiffness.iter().flatten().any(|of| *of != 0.0) || view.text("springdamper").is_some() {
        tally.count(features::SPRINGS);
    }
    if damping[1..].iter().flatten().any(|of| *of != 0.0) {
        tally.unread("damping of joints that is not linear");
    }
    let reference = match kind {
        JointKind::Ball => 0.0,
        _ => view.number("ref")?.unwrap_or(0.0) * turns,
    };
    let force = force.filter(|_| kind != JointKind::Ball);
    Ok(Joint {
        axis,
        reference,
        range,
        effort: force.map(greatest),
        actuator: Actuator { force, ..Actuator::default() },
        damping: damping[0].unwrap_or(0.0),
        friction: view.number("frictionloss")?.unwrap_or(0.0),
        armature: view.number("armature")?.filter(|armature| *armature != 0.0),
        ..Joint::new(name, kind, Translation3::from(position).into(), element.place)
    })
}

/// A range, if it is a limit: `limited` says so, or it is not empty and the compiler takes all ranges for limits.
fn limits(
    view: View<'_>,
    range: &'static str,
    limited: &'static str,
    compiler: &Compiler,
) -> Fallible<Option<[f64; 2]>> {
    let (is_limited, ends) = said_limits(view, range, limited, compiler)?;
    if is_limited && ends[0] >= ends[1] {
        let element = view.element.tag.clone();
        return Err(at(view.element.place, MjcfFault::Range { element, attribute: range }));
    }
    Ok(is_limited.then_some(ends))
}

/// A range as it is said, and whether it is a limit.
fn said_limits(
    view: View<'_>,
    range: &'static str,
    limited: &'static str,
    compiler: &Compiler,
) -> Fallible<(bool, [f64; 2])> {
    let said = view.word(limited, &["false", "true", "auto"], "`false`, `true` or `auto`")?;
    let ends = view.numbers::<2>(range)?.unwrap_or_default();
    Ok((compiler.is_limit(view.element, (limited, said), ends)?, ends))
}
