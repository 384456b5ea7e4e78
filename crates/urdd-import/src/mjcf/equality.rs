//! Equalities: joints that follow others as mimics; the rest is lost by name.

use super::super::features::{self, Tally};
use super::super::model::Mimic;
use super::super::refusal::Fallible;
use super::body::{Made, RawBody, WORLD};
use super::defaults::{Defaults, MAIN};
use super::element::Element;
use super::joint::MjcfJointKind;
use super::lookup::Lookup;
use super::reading::{View, flag};
use urdd_format::short::Short;

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
) -> Fallible<()> {
    for element in root.sections("equality") {
        let view = View::new(element, defaults, MAIN)?;
        let of_class = view.equality_default();
        let is_active = match flag(element, "active")? {
            Some(active) => active,
            None => of_class.map_or(Ok(None), |of| flag(of, "active"))?.unwrap_or(true),
        };
        match element.tag.as_str() {
            "joint" if is_active => couple(view, all, lookup, made, tally)?,
            "joint" => {
                tally.count(features::COUPLINGS);
                tally
                    .remark(element.place, "the equality is not active, so its joint moves freely");
            }
            "connect" | "weld" | "distance" => {
                tie(view, is_active, all, lookup, made, tally)?;
            }
            "tendon" => tally.count(features::TENDONS),
            _ => tally.count(features::SOFT),
        }
    }
    Ok(())
}

/// Two bodies that are tied to each other, beside the tree.
fn tie(
    view: View<'_>,
    is_active: bool,
    all: &[RawBody<'_>],
    lookup: &Lookup<'_>,
    made: &Made,
    tally: &mut Tally,
) -> Fallible<()> {
    let element = view.element;
    let named = |key| element.text(key).map(|name| Short::of(name).to_string());
    let sites = [named("site1"), named("site2")];
    let names = [element.text("body1"), element.text("body2")];
    let mut who = [named("body1"), named("body2")].map(|name| name.unwrap_or("world".to_owned()));
    let (mut feature, mut what) = (features::CLOSED, "closes a chain, which a URDF cannot say");
    if let [Some(one), Some(other)] = sites {
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
        }
    }
    if !is_active {
        (feature, what) = (features::TIES, "is not active; it is left out");
    }
    tally.count(feature);
    let [one, other] = who;
    let at = match named("anchor").filter(|_| element.tag == "connect") {
        Some(anchor) => format!(" at {anchor} of `{one}`"),
        None => String::new(),
    };
    let name = named("name").map(|name| format!(" `{name}`")).unwrap_or_default();
    let text = format!("the {}{name} of `{one}` and `{other}`{at} {what}", element.tag);
    tally.remark(element.place, text.replace(char::is_control, " "));
    Ok(())
}

fn couple(
    view: View<'_>,
    all: &[RawBody<'_>],
    lookup: &Lookup<'_>,
    made: &mut Made,
    tally: &mut Tally,
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
        let is_plain = |at| matches!(raw(at).kind, MjcfJointKind::Hinge | MjcfJointKind::Slide);
        let reason = match leading {
            None => Some("its joint is held still, or follows one that is left out"),
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
        } else {
            tally.count(features::COUPLINGS);
            let reason = reason.unwrap_or_default();
            tally.remark(element.place, format!("an equality of joints is left out: {reason}"));
        }
    }
    Ok(())
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
