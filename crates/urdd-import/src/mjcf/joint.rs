//! Joints.

use nalgebra::{Isometry3, Point3, Unit, Vector3};

use super::super::features::{self, Tally};
use super::super::place::Place;
use super::super::refusal::{Fallible, at};
use super::compiler::Compiler;
use super::element::Element;
use super::fault::MjcfFault;
use super::reading::{View, wrong};

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MjcfJointKind {
    Free,
    Ball,
    Slide,
    Hinge,
}

/// A joint.
#[derive(Debug, Clone)]
pub struct RawJoint {
    pub name: Option<String>,
    pub kind: MjcfJointKind,
    /// Where it is, in the frame of its body.
    pub position: Point3<f64>,
    pub axis: Vector3<f64>,
    pub reference: f64,
    pub range: Option<[f64; 2]>,
    /// The least and greatest force of its actuators.
    pub force: Option<[f64; 2]>,
    pub damping: f64,
    pub friction: f64,
    pub armature: f64,
    pub place: Place,
}

impl RawJoint {
    /// How many numbers of a configuration it has.
    pub fn positions(&self) -> usize {
        match self.kind {
            MjcfJointKind::Free => 7,
            MjcfJointKind::Ball => 4,
            MjcfJointKind::Slide | MjcfJointKind::Hinge => 1,
        }
    }

    /// The numbers that it has in the model's own configuration. A free joint's are its body's.
    pub fn start(&self) -> Vec<f64> {
        match self.kind {
            MjcfJointKind::Free => Vec::new(),
            MjcfJointKind::Ball => vec![1.0, 0.0, 0.0, 0.0],
            MjcfJointKind::Slide | MjcfJointKind::Hinge => vec![self.reference],
        }
    }

    /// A free joint.
    pub fn free(element: &Element, name: Option<String>) -> Self {
        RawJoint {
            name,
            kind: MjcfJointKind::Free,
            position: Point3::origin(),
            axis: Vector3::z(),
            reference: 0.0,
            range: None,
            force: None,
            damping: 0.0,
            friction: 0.0,
            armature: 0.0,
            place: element.place,
        }
    }

    /// A `<joint>` in a frame of its body.
    pub fn read(
        view: View<'_>,
        name: Option<String>,
        frame: &Isometry3<f64>,
        compiler: &Compiler,
        tally: &mut Tally,
    ) -> Fallible<Self> {
        let words = ["free", "ball", "slide", "hinge"];
        let kind = view.word("type", &words, "`free`, `ball`, `slide` or `hinge`")?;
        let kind =
            [MjcfJointKind::Free, MjcfJointKind::Ball, MjcfJointKind::Slide, MjcfJointKind::Hinge]
                [kind.unwrap_or(3)];
        let element = view.element;
        if kind == MjcfJointKind::Free {
            return Ok(RawJoint::free(element, name));
        }
        let position = frame * Point3::from(view.numbers::<3>("pos")?.unwrap_or_default());
        let axis = Vector3::from(view.numbers::<3>("axis")?.unwrap_or([0.0, 0.0, 1.0]));
        let axis = match kind {
            MjcfJointKind::Ball => Vector3::z(),
            _ => {
                let wanted = "an axis that is not zero";
                let axis = Unit::try_new(axis, 1e-14);
                frame.rotation * axis.ok_or_else(|| wrong(element, "axis", wanted))?.into_inner()
            }
        };
        let turns = if kind == MjcfJointKind::Slide { 1.0 } else { compiler.angle };
        let range = match kind {
            MjcfJointKind::Ball => None,
            _ => limits(view, "range", "limited", compiler)?.map(|of| of.map(|end| end * turns)),
        };
        let force = limits(view, "actuatorfrcrange", "actuatorfrclimited", compiler)?;
        if kind == MjcfJointKind::Ball {
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
            MjcfJointKind::Ball => 0.0,
            _ => view.number("ref")?.unwrap_or(0.0) * turns,
        };
        Ok(RawJoint {
            name,
            kind,
            position,
            axis,
            reference,
            range,
            force: force.filter(|_| kind != MjcfJointKind::Ball),
            damping: damping[0].unwrap_or(0.0),
            friction: view.number("frictionloss")?.unwrap_or(0.0),
            armature: view.number("armature")?.unwrap_or(0.0),
            place: element.place,
        })
    }
}

/// A range, if it is a limit: `limited` says so, or it is not empty and the compiler takes all ranges for limits.
pub fn limits(
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
    let is_limited = is_limited(said, ends, compiler).ok_or_else(|| {
        let element = view.element.tag.clone();
        at(view.element.place, MjcfFault::NoLimited { element, attribute: limited })
    })?;
    Ok((is_limited, ends))
}

/// Whether a range is a limit, by what is said of it: 0 for false, 1 for true. None: it would have to be said.
pub fn is_limited(said: Option<usize>, ends: [f64; 2], compiler: &Compiler) -> Option<bool> {
    match said {
        Some(0) => Some(false),
        Some(1) => Some(true),
        _ if ends == [0.0; 2] => Some(false),
        _ => compiler.has_auto_limits.then_some(ends[0] < ends[1]),
    }
}
