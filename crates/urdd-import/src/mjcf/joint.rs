//! Joints and actuators, as a model and its default classes say them.

use nalgebra::{Isometry3, Point3, Translation3, Unit, Vector3};

use super::compiler::Compiler;
use super::reading::{Attributes, Element, View, list, wrong};
use crate::fault::MjcfFault;
use crate::features::{self, Tally};
use crate::model::{self, Joint, JointKind};
use crate::place::{Fallible, at};

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
        actuator: model::Actuator { force, ..model::Actuator::default() },
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

/// The elements of actuators.
pub const TAGS: [&str; 13] = [
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "orientation",
    "pid",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
    "plugin",
];

/// What an actuator's force is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Law {
    /// A gain times the control.
    #[default]
    Gain,
    /// That, less a spring and a damper.
    Servo,
    /// Anything else: muscles, motors with a circuit, plugins.
    Other,
}

#[derive(Debug, Clone, Default)]
pub struct Actuator {
    pub law: Law,
    /// Whether its control goes through a filter or an integrator.
    pub has_state: bool,
    pub gear: f64,
    pub gain: f64,
    pub stiffness: f64,
    /// Below 0: a ratio of damping, negated.
    pub damping: f64,
    /// A force that is always there.
    pub constant: f64,
    /// By how much the range of the joint is the range of its control; 0: it is not.
    inherited: f64,
    /// What it adds to its joint.
    pub joint_damping: f64,
    pub armature: f64,
    force: Range,
    control: Range,
}

/// Two numbers, and whether they are limits.
#[derive(Debug, Clone, Default)]
struct Range {
    ends: [f64; 2],
    limited: Option<usize>,
}

impl Actuator {
    /// What an element says, after the classes around it, the outermost first. What makes the force is taken from a class
    /// only if the last actuator in it is of the same kind, or `<general>`.
    pub fn of(element: &Element, classes: &[Vec<&Element>]) -> Fallible<Self> {
        let mut actuator = Actuator { gear: 1.0, gain: 1.0, ..Actuator::default() };
        for class in classes {
            let kind = class.last().map_or("general", |last| last.tag.as_str());
            let is_kin = kind == "general" || element.tag == "general" || kind == element.tag;
            for of_class in class {
                actuator.limits(of_class)?;
                if is_kin {
                    actuator.law(of_class)?;
                }
            }
        }
        actuator.limits(element)?;
        actuator.law(element)?;
        Ok(actuator)
    }

    fn limits(&mut self, element: &Element) -> Fallible<()> {
        self.gear = first(element, "gear", 6)?.unwrap_or(self.gear);
        self.joint_damping = first(element, "damping", 3)?.unwrap_or(self.joint_damping);
        self.armature = element.number("armature")?.unwrap_or(self.armature);
        self.force.read(element, "forcerange", "forcelimited")?;
        self.control.read(element, "ctrlrange", "ctrllimited")
    }

    fn law(&mut self, element: &Element) -> Fallible<()> {
        let stiffness = element.number("kp")?;
        let damping = match (element.number("kv")?, element.number("dampratio")?) {
            (_, Some(ratio)) => Some(-ratio),
            (damping, None) => damping,
        };
        match element.tag.as_str() {
            "general" => self.general(element)?,
            "motor" => {
                (self.law, self.has_state, self.gain) = (Law::Gain, false, 1.0);
            }
            "position" | "intvelocity" => {
                self.law = Law::Servo;
                self.gain = stiffness.unwrap_or(self.gain);
                self.stiffness = self.gain;
                self.damping = damping.unwrap_or(self.damping);
                self.inherited = element.number("inheritrange")?.unwrap_or(self.inherited);
                let constant = element.number("timeconst")?;
                self.has_state = element.tag == "intvelocity"
                    || constant.map_or(self.has_state, |constant| constant != 0.0);
            }
            "velocity" => {
                (self.law, self.has_state, self.stiffness) = (Law::Servo, false, 0.0);
                self.gain = element.number("kv")?.unwrap_or(self.gain);
                self.damping = self.gain;
            }
            _ => self.law = Law::Other,
        }
        Ok(())
    }

    fn general(&mut self, element: &Element) -> Fallible<()> {
        let gains = ["fixed", "affine", "muscle", "dcmotor", "so3", "pid", "user"];
        let biases = ["none", "affine", "muscle", "dcmotor", "so3", "user"];
        let states =
            ["none", "integrator", "filter", "filterexact", "muscle", "dcmotor", "pid", "user"];
        let gain = element.word("gaintype", &gains, "a type of gain")?;
        let bias = element.word("biastype", &biases, "a type of bias")?;
        if let Some(state) = element.word("dyntype", &states, "a type of dynamics")? {
            self.has_state = state != 0;
        }
        self.law = match (gain, bias) {
            (Some(1..), _) | (_, Some(2..)) => Law::Other,
            (_, None) => self.law,
            (_, Some(0)) => Law::Gain,
            (_, Some(_)) => Law::Servo,
        };
        self.gain = first(element, "gainprm", 10)?.unwrap_or(self.gain);
        if element.get("biasprm").is_some() {
            let bias = list(element, "biasprm", 10)?;
            let of = |place: usize, now: f64| bias.get(place).map_or(now, |bias| -bias);
            self.constant = of(0, self.constant);
            self.stiffness = of(1, self.stiffness);
            self.damping = of(2, self.damping);
        }
        Ok(())
    }

    /// The least and greatest force at its joint; none without a limit.
    pub fn force(&self, element: &Element, compiler: &Compiler) -> Fallible<Option<[f64; 2]>> {
        let force = self.force.limits(element, "forcelimited", compiler)?;
        let control = self.control.limits(element, "ctrllimited", compiler)?;
        let control = control.filter(|_| self.law == Law::Gain && !self.has_state);
        let control = control.map(|control| times(control, self.gain));
        Ok(within(force, control).map(|force| times(force, self.gear)))
    }

    /// Whether its damping is a ratio: MuJoCo takes it for one in a servo of position.
    pub fn is_ratio(&self) -> bool {
        self.damping < 0.0 && self.gain.to_bits() == self.stiffness.to_bits()
    }

    pub fn is_of_speed(&self) -> bool {
        self.law == Law::Servo && self.stiffness == 0.0 && self.damping > 0.0 && !self.has_state
    }

    /// The least and greatest position of its joint that a servo can be told, or speed. `joint` is the joint's range.
    pub fn told(
        &self,
        element: &Element,
        compiler: &Compiler,
        joint: Option<[f64; 2]>,
    ) -> Fallible<Option<[f64; 2]>> {
        let own = self.control.limits(element, "ctrllimited", compiler)?;
        let inherited = joint.filter(|_| self.inherited > 0.0).map(|[least, most]| {
            let (middle, half) = ((least + most) / 2.0, (most - least) / 2.0 * self.inherited);
            [middle - half, middle + half]
        });
        let against = if self.is_of_speed() { self.damping } else { self.stiffness };
        let per = self.gain / (against * self.gear);
        let is_told = self.law == Law::Servo && !self.has_state && per.is_finite() && per != 0.0;
        Ok(inherited.or(own).filter(|_| is_told).map(|told| times(told, per)))
    }
}

/// A range times a factor, the least first.
fn times(ends: [f64; 2], factor: f64) -> [f64; 2] {
    let [a, b] = ends.map(|end| end * factor);
    [a.min(b), a.max(b)]
}

/// The greatest force of a range, either way.
pub fn greatest([least, most]: [f64; 2]) -> f64 {
    least.abs().max(most.abs())
}

/// A range of forces within a limit; the one that there is, where the other is none.
pub fn within(limit: Option<[f64; 2]>, force: Option<[f64; 2]>) -> Option<[f64; 2]> {
    match (limit, force) {
        (Some([least, most]), Some(force)) => Some(force.map(|of| of.max(least).min(most))),
        (limit, force) => limit.or(force),
    }
}

impl Range {
    fn read(
        &mut self,
        element: &Element,
        range: &'static str,
        limited: &'static str,
    ) -> Fallible<()> {
        self.ends = element.numbers::<2>(range)?.unwrap_or(self.ends);
        let words = ["false", "true", "auto"];
        let said = element.word(limited, &words, "`false`, `true` or `auto`")?;
        self.limited = said.or(self.limited);
        Ok(())
    }

    fn limits(
        &self,
        element: &Element,
        limited: &'static str,
        compiler: &Compiler,
    ) -> Fallible<Option<[f64; 2]>> {
        let is_limited = compiler.is_limit(element, (limited, self.limited), self.ends)?;
        Ok(is_limited.then_some(self.ends))
    }
}

/// The first of up to `most` numbers.
fn first(element: &Element, name: &str, most: usize) -> Fallible<Option<f64>> {
    match element.get(name) {
        Some(_) => Ok(list(element, name, most)?.first().copied()),
        None => Ok(None),
    }
}
