//! Kinematic loops as equality constraints: `connect` and `weld` between sites, and polynomials of joints.
//!
//! Sites say where the ends are; a `connect` of two bodies takes the second end from the pose of the model, in which loops
//! may be open.

use nalgebra::Translation3;

use super::body::{placed, site_named};
use crate::loops::{Closing, LeftOut, OTHER_KIND, closings as loops_of, is_linear, names};
use crate::{ExportError, Note, Subject, Taken};
use urdd_format::loops::{Coupling, LoopKind};
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

/// Nearly as stiff as MuJoCo's time step of 2 ms lets it be, whatever the mass of a rod: three times that, critically damped.
const SOLREF: &str = "0.006 1";
/// The largest impedance that MuJoCo takes.
const SOLIMP: &str = "0.9999 0.9999 0.001";

/// Rods of some grams that swing fast are stable only with the derivatives of their Coriolis forces, which `implicitfast`
/// leaves out.
pub(super) const INTEGRATOR: &str = "implicit";

const OTHER_SUM: &str =
    "equality constraints are of one joint, or of one as a polynomial of another";

/// What loops need in a file.
#[derive(Default)]
pub(super) struct Closings {
    /// For each link, its sites.
    pub sites: Vec<Vec<Element>>,
    /// The constraints.
    pub equalities: Vec<Element>,
}

/// The constraints of the robot's loops and couplings, with their sites.
pub(super) fn closings(subject: &Subject, notes: &mut Vec<Note>) -> Result<Closings, ExportError> {
    let mut made = Closings { sites: vec![Vec::new(); subject.links.len()], ..Closings::default() };
    let mut left_out = LeftOut::default();
    let Some(module) = subject.robot.loops()? else { return Ok(made) };
    let names = names(subject.format, module);
    let mut taken = Taken::new(names.iter());
    for closing in loops_of(subject, &mut left_out)? {
        if !made.hold(subject, &closing, &mut taken) {
            left_out.of_loop(&closing.of.name, OTHER_KIND);
        }
    }
    for (coupling, name) in module.couplings.iter().zip(&names[module.loops.len()..]) {
        match equation(subject, coupling, name)? {
            Some(element) => made.equalities.push(element),
            None => left_out.coupling(&coupling.name, OTHER_SUM),
        }
    }
    notes.extend(left_out.notes());
    Ok(made)
}

impl Closings {
    /// Adds what holds a loop; false for a kind that nothing holds.
    fn hold(&mut self, subject: &Subject, closing: &Closing, taken: &mut Taken) -> bool {
        let Some(points) = closing.points() else { return false };
        let word = if closing.of.kind == LoopKind::Fixed { "weld" } else { "connect" };
        for (number, along) in points.iter().enumerate() {
            let own = match number {
                0 => closing.name.clone(),
                _ => taken.free(format!("{}/{number}", closing.name)),
            };
            let mut element = Element::new(word).with("name", own);
            for ((key, end), on) in [("site1", "a"), ("site2", "b")].into_iter().zip(closing.ends) {
                // Our names of sites have two slashes and the number of the loop.
                let name = format!("loop/{}/{end}{number}", closing.number);
                let name = subject.names.taken.clone().free(name);
                let pose = on.pose * Translation3::new(0.0, 0.0, *along);
                self.sites[on.link].push(placed(site_named(&name), &pose));
                element = element.with(key, name);
            }
            self.equalities.push(stiff(element));
        }
        true
    }
}

/// A coupling as an equality of one joint, or of two. `None` if it is of more, or of no joint as a polynomial of the other.
fn equation(
    subject: &Subject,
    coupling: &Coupling,
    name: &str,
) -> Result<Option<Element>, ExportError> {
    let names = subject.robot.dof_names()?;
    let joint = |dof: usize| {
        let name = names.get(dof)?;
        subject.view.joints.iter().find(|joint| joint.name == *name && joint.num_dofs() == 1)
    };
    let (follower, leader) = match &coupling.terms[..] {
        [one] if is_linear(&one.coefficients) => (one, None),
        [one, other] if is_linear(&other.coefficients) => (other, Some(one)),
        [one, other] if is_linear(&one.coefficients) => (one, Some(other)),
        _ => return Ok(None),
    };
    let Some(joint1) = joint(follower.dof_idx.get()) else { return Ok(None) };
    let factor = -1.0 / follower.coefficients[0];
    let mut polynomial = [coupling.constant * factor, 0.0, 0.0, 0.0, 0.0];
    let mut element = Element::new("joint").with("name", name).with("joint1", joint1.name.as_str());
    if let Some(leader) = leader {
        let Some(joint2) = joint(leader.dof_idx.get()) else { return Ok(None) };
        element = element.with("joint2", joint2.name.as_str());
        for (to, coefficient) in polynomial[1..].iter_mut().zip(leader.coefficients) {
            *to = coefficient * factor;
        }
    }
    let is_finite = polynomial.iter().all(|number| number.is_finite());
    Ok(is_finite.then(|| stiff(element.with("polycoef", numbers(&polynomial)))))
}

fn stiff(element: Element) -> Element {
    element.with("solref", SOLREF).with("solimp", SOLIMP)
}
