//! Equalities: joints that follow others as mimics, other equations of joints, and what closes chains.

use std::collections::HashMap;

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};
use urdd_directory::account::{Account, AccountError, Charged};
use urdd_format::loops::LoopKind;
use urdd_format::short::Short;

use super::body::{Lookup, Made, RawBody, WORLD};
use super::reading::{Attributes, Defaults, Element, MAIN, View};
use crate::features::{self, Tally};
use crate::model::{Closing, Coupled, End, JointKind, Mimic};
use crate::place::{Fallible, Place, Placing};

/// Joints that follow one another; a longer chain is left out.
const LONGEST: usize = 1000;
/// What each of these costs.
const STEP: usize = 50;

/// Gives joints their leaders.
pub fn equalities<'d>(
    root: &'d Element,
    defaults: &'d Defaults<'d>,
    all: &[RawBody<'_>],
    lookup: &Lookup<'_>,
    made: &mut Made,
    tally: &mut Tally,
    account: &Account,
) -> Fallible<()> {
    let mut closings = Charged::default();
    let placed = Placed::of(made, account).at(Place::default())?;
    let is_tie = |of: &&Element| matches!(of.tag.as_str(), "connect" | "weld" | "distance");
    for element in root.sections("equality").filter(is_tie) {
        let view = View::new(element, defaults, MAIN)?;
        if let Some(closing) = tie(view, all, lookup, (made, &placed), tally)? {
            closings.push(closing, account).at(element.place)?;
        }
    }
    made.closings = closings;
    for element in root.sections("equality") {
        let view = View::new(element, defaults, MAIN)?;
        match element.tag.as_str() {
            "joint" if is_active(view)? => couple(view, all, lookup, made, tally, account)?,
            "joint" => {
                let text = "the equality is not active, so its joint moves freely";
                tally.say(features::COUPLINGS, element.place, text);
            }
            "connect" | "weld" | "distance" => {}
            "tendon" => tally.count(features::TENDONS),
            _ => tally.count(features::SOFT),
        }
    }
    Ok(())
}

fn is_active(view: View<'_>) -> Fallible<bool> {
    let of_class = view.equality_default().filter(|_| view.element.get("active").is_none());
    Ok(of_class.unwrap_or(view.element).flag("active")?.unwrap_or(true))
}

/// Two bodies that are tied to each other, beside the tree.
fn tie(
    view: View<'_>,
    all: &[RawBody<'_>],
    lookup: &Lookup<'_>,
    (made, placed): (&Made, &Placed<'_>),
    tally: &mut Tally,
) -> Fallible<Option<Closing>> {
    let (element, is_active) = (view.element, is_active(view)?);
    let named = |key| element.text(key).map(|name| Short::of(name).to_string());
    let sites = [named("site1"), named("site2")];
    let names = [element.text("body1"), element.text("body2")];
    let mut who = [named("body1"), named("body2")].map(|name| name.unwrap_or("world".to_owned()));
    let (mut feature, mut what) =
        (features::CLOSED, "closes a chain, in another way than is read here; it is left out");
    let mut closing = None;
    if let [Some(one), Some(other)] = sites {
        let named = [element.text("site1"), element.text("site2")].map(Option::unwrap_or_default);
        closing = placed.sites(view, named)?;
        who = [one, other];
    } else {
        let mut bodies = Vec::new();
        for name in names.into_iter().flatten() {
            let suffix = lookup.replicas(element, &[Some(name)])?.first();
            bodies.push(lookup.body(element, name, suffix.map_or("", String::as_str))?);
        }
        if bodies.iter().any(|body| all[*body].is_mocap) {
            (feature, what) =
                (features::TIES, "follows a body that a program moves (`mocap`); it is left out");
        } else if !bodies.iter().all(|body| *body == WORLD || made.index.contains_key(body)) {
            (feature, what) =
                (features::TIES, "is of a body that is not of the robot; it is left out");
        } else if let Some(first) = bodies.first() {
            let both = [*first, bodies.get(1).copied().unwrap_or(WORLD)];
            closing = placed.bodies(view, both, made)?;
        }
    }
    if !is_active {
        (feature, what) = (features::TIES, "is not active; it is left out");
    }
    if feature.name == features::CLOSED.name {
        if closing.is_some() {
            tally.count(feature);
            return Ok(closing);
        }
        feature = features::TIES;
    }
    let [one, other] = who;
    let at = match named("anchor").filter(|_| element.tag == "connect") {
        Some(anchor) => format!(" at {anchor} of `{one}`"),
        None => String::new(),
    };
    let name = named("name").map(|name| format!(" `{name}`")).unwrap_or_default();
    let text = format!("the {}{name} of `{one}` and `{other}`{at} {what}", element.tag);
    tally.say(feature, element.place, text.replace(char::is_control, " "));
    Ok(None)
}

fn couple(
    view: View<'_>,
    all: &[RawBody<'_>],
    lookup: &Lookup<'_>,
    made: &mut Made,
    tally: &mut Tally,
    account: &Account,
) -> Fallible<()> {
    let element = view.element;
    let names = [element.text("joint1"), element.text("joint2")];
    let [c0, c1, rest @ ..] = view.up_to::<5>("polycoef")?;
    let (c0, c1) = (c0.unwrap_or(0.0), c1.unwrap_or(1.0));
    let is_linear = rest.iter().all(|of| of.unwrap_or(0.0) == 0.0);
    for suffix in lookup.replicas(element, &names)? {
        let Some(first) = names[0] else { continue };
        let follower = lookup.joint(element, first, suffix)?;
        let leader = names[1].map(|name| lookup.joint(element, name, suffix)).transpose()?;
        let Some(&(body, place)) = made.joints.get(&follower) else { continue };
        let raw = |(body, place): (usize, usize)| &all[body].joints[place];
        let leading = leader.and_then(|leader| Some((leader, *made.joints.get(&leader)?)));
        let is_plain = |at| matches!(raw(at).kind, JointKind::Hinge | JointKind::Slide);
        let reason = match leading {
            None => Some("it is of a ball, or its joint follows one that is left out"),
            Some(_) if !is_linear => Some("it is not linear"),
            Some((leader, _)) if !is_plain(leader) || !is_plain(follower) => {
                Some("it is of another joint than a hinge or a slide")
            }
            Some(_) if made.bodies[body].joints[place].mimic.is_some() => {
                Some("its joint follows another already")
            }
            Some((_, at)) => {
                let (is_circle, steps) = leads_back(made, at, (body, place));
                lookup.charge(element, steps * STEP)?;
                is_circle.then_some("its joints follow each other in a circle")
            }
        };
        if let (None, Some((leader, (leading_body, leading_place)))) = (reason, leading) {
            // y - y0 = c0 + c1 (x - x0)
            let offset = raw(follower).reference + c0 - c1 * raw(leader).reference;
            let joint = made.bodies[leading_body].joints[leading_place].name.clone();
            made.bodies[body].joints[place].mimic = Some(Mimic { joint, multiplier: c1, offset });
            made.leaders.insert((body, place), (leading_body, leading_place));
            tally.count(features::MIMICS);
            continue;
        }
        let name = |(body, place): (usize, usize)| made.bodies[body].joints[place].name.clone();
        let (own, reference) = ((name((body, place)), vec![1.0]), raw(follower).reference);
        let equation = match leading.filter(|_| is_plain(follower)) {
            Some((leader, at)) if is_plain(leader) && leader != follower => {
                let powers = [c0, c1].into_iter().chain(rest.iter().map(|of| of.unwrap_or(0.0)));
                let powers: Vec<f64> = powers.collect();
                let (moved, coefficients) = about_zero(&powers, raw(leader).reference);
                let of_leader = coefficients.iter().map(|of| -of).collect();
                Some((-reference - moved, vec![own, (name(at), of_leader)]))
            }
            // y - y0 = c0
            None if names[1].is_none() && is_plain(follower) => Some((-reference - c0, vec![own])),
            _ => None,
        };
        if let Some((constant, terms)) = equation {
            let name = element.text("name").map(|name| format!("{name}{suffix}"));
            tally.count(features::POLYNOMIALS);
            made.couplings.push(Coupled { name, constant, terms }, account).at(element.place)?;
        } else {
            let reason = reason.unwrap_or_default();
            let text = format!("an equality of joints is left out: {reason}");
            tally.say(features::COUPLINGS, element.place, text);
        }
    }
    Ok(())
}

/// The polynomial of x - x0 as one of x: its constant, and the four other coefficients.
fn about_zero(powers: &[f64], x0: f64) -> (f64, [f64; 4]) {
    let mut coefficients = [0.0; 5];
    // Horner's rule: what is there times x - x0, and the next coefficient.
    for power in powers.iter().rev() {
        for at in (0..5).rev() {
            let lower = if at == 0 { 0.0 } else { coefficients[at - 1] };
            coefficients[at] = lower - x0 * coefficients[at];
        }
        coefficients[0] += power;
    }
    let [constant, rest @ ..] = coefficients;
    (constant, rest)
}

/// Whether a joint follows another, over however many; and over how many.
fn leads_back(made: &Made, from: (usize, usize), to: (usize, usize)) -> (bool, usize) {
    let chain = std::iter::successors(Some(from), |at| made.leaders.get(at).copied());
    let mut number = 0;
    for at in chain {
        number += 1;
        if at == to || number > LONGEST {
            return (true, number);
        }
    }
    (false, number)
}

/// The bodies of a robot in its first body's frame, in the pose of the model (`qpos0`), and its sites by name.
pub struct Placed<'m> {
    poses: Vec<Isometry3<f64>>,
    sites: HashMap<&'m str, usize>,
}

impl<'m> Placed<'m> {
    pub fn of(made: &'m Made, account: &Account) -> Result<Self, AccountError> {
        let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(made.bodies.len());
        for body in made.bodies.walk(account)? {
            let parent = body.parent.and_then(|parent| poses.get(parent));
            poses.push(parent.map_or_else(Isometry3::identity, |parent| parent * body.pose));
        }
        let sites = made.bodies.walk(account)?.enumerate().filter(|(_, body)| body.is_frame);
        let sites = sites.map(|(index, body)| (body.name.as_str(), index)).collect();
        Ok(Placed { poses, sites })
    }

    /// The loop of a `connect` or `weld` between two bodies, by raw index. `None` if one is not of the robot, or it is of
    /// another kind.
    pub fn bodies(
        &self,
        view: View<'_>,
        [one, other]: [usize; 2],
        made: &Made,
    ) -> Fallible<Option<Closing>> {
        let ends = made.index.get(&one).copied().zip(made.index.get(&other).copied());
        let Some((a, b)) = ends.filter(|(a, b)| a != b) else { return Ok(None) };
        let (at_a, at_b) = (self.poses[a], self.poses[b]);
        let anchor = view.numbers::<3>("anchor")?.unwrap_or_default();
        let (kind, frames) = match view.element.tag.as_str() {
            "connect" => {
                // A point of the first body, where the model has it.
                let point = Isometry3::from(Translation3::from(anchor));
                (LoopKind::Spherical, [point, at_b.inverse() * at_a * point])
            }
            "weld" => {
                let written = view.numbers::<7>("relpose")?.unwrap_or_default();
                let [x, y, z, w, i, j, k] = written;
                let turn = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 0.0);
                let relative = match turn {
                    Some(turn) => Isometry3::from_parts(Translation3::new(x, y, z), turn),
                    None => at_a.inverse() * at_b,
                };
                // Where it is held, in the second body.
                let point = Isometry3::from(Translation3::from(Point3::from(anchor)));
                (welded(view)?, [relative * point, point])
            }
            _ => return Ok(None),
        };
        let [frame_a, frame_b] = frames;
        let ends = [End { body: a, frame: frame_a }, End { body: b, frame: frame_b }];
        Ok(Some(closing(view, kind, ends)))
    }

    /// The loop of a `connect` or `weld` between two sites.
    pub fn sites(&self, view: View<'_>, names: [&str; 2]) -> Fallible<Option<Closing>> {
        let [a, b] = names.map(|name| self.sites.get(name).copied());
        let kind = match view.element.tag.as_str() {
            "connect" => LoopKind::Spherical,
            "weld" => welded(view)?,
            _ => return Ok(None),
        };
        let Some((a, b)) = a.zip(b).filter(|(a, b)| a != b) else { return Ok(None) };
        let ends = [a, b].map(|body| End { body, frame: Isometry3::identity() });
        Ok(Some(closing(view, kind, ends)))
    }
}

/// What a weld holds: without `torquescale` no rotation, as in MuJoCo.
fn welded(view: View<'_>) -> Fallible<LoopKind> {
    let scale = view.numbers::<1>("torquescale")?;
    Ok(match scale {
        Some([0.0]) => LoopKind::Spherical,
        _ => LoopKind::Fixed,
    })
}

fn closing(view: View<'_>, kind: LoopKind, ends: [End; 2]) -> Closing {
    let name = view.element.text("name").map(str::to_owned);
    Closing { name, kind, ends, place: view.element.place }
}
