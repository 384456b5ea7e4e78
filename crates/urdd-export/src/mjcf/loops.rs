//! Kinematic loops as equality constraints: `connect` and `weld` between sites, and polynomials of joints.
//!
//! Sites say where the ends are; a `connect` of two bodies takes the second end from the pose of the model, in which loops
//! may be open.

use nalgebra::{Isometry3, Translation3};

use super::body::{placed, site_named};
use crate::{ExportError, Note, Subject};
use urdd_format::loops::{Coupling, Loop, LoopKind};
use urdd_format::pose::Pose;
use urdd_kinematics::pose::to_isometry;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

/// How far apart the two points are that hold a hinge, m.
const APART: f64 = 0.1;
/// Stiffer than MuJoCo's default.
const STIFF: &str = "0.99 0.999 0.001";

const OTHER_KIND: &str = "a loop of a kind that MuJoCo's equality constraints cannot say is left out: a slide, a plane, or a universal joint";
const OTHER_LINK: &str = "a loop is left out: one of its links is not in the file";
const OTHER_SUM: &str = "a coupling is left out: MuJoCo's equality constraints are of one joint, or of one as a polynomial of another";

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
    let Some(module) = subject.robot.loops()? else { return Ok(made) };
    let links = subject.robot.link_names()?;
    for (place, one) in module.loops.iter().enumerate() {
        let ends = [(one.link_a_idx, &one.frame_a), (one.link_b_idx, &one.frame_b)];
        let ends = ends.map(|(link, frame)| {
            let name = links.get(link.get())?;
            let link = subject.links.iter().position(|of| of == name)?;
            Some(on_body(subject, link, frame))
        });
        let [Some(a), Some(b)] = ends else {
            notes.push(Note::Robot(OTHER_LINK));
            continue;
        };
        if !made.hold(subject, place, one, [a, b]) {
            notes.push(Note::Robot(OTHER_KIND));
        }
    }
    for coupling in &module.couplings {
        match equation(subject, coupling)? {
            Some(element) => made.equalities.push(element),
            None => notes.push(Note::Robot(OTHER_SUM)),
        }
    }
    notes.dedup();
    Ok(made)
}

/// The body that carries a link's frame, and the frame in it.
fn on_body(subject: &Subject, link: usize, frame: &Pose) -> (usize, Isometry3<f64>) {
    let mut at = (link, to_isometry(frame).unwrap_or_default());
    while subject.is_frame(at.0)
        && let Some(joint) = subject.tree.parent_joint[at.0]
    {
        let origin = subject.view.joints[joint].origin.motion();
        at = (subject.tree.joint_links[joint].0, origin * at.1);
    }
    at
}

impl Closings {
    /// Adds what holds a loop; false for a kind that nothing holds.
    fn hold(
        &mut self,
        subject: &Subject,
        place: usize,
        one: &Loop,
        ends: [(usize, Isometry3<f64>); 2],
    ) -> bool {
        let (word, points) = match one.kind {
            LoopKind::Fixed => ("weld", &[0.0][..]),
            LoopKind::Spherical => ("connect", &[0.0][..]),
            // Two points on the axis hold a hinge.
            LoopKind::Revolute => ("connect", &[0.0, APART][..]),
            _ => return false,
        };
        for (number, along) in points.iter().enumerate() {
            let mut element = Element::new(word);
            for ((key, end), (link, frame)) in
                [("site1", "a"), ("site2", "b")].into_iter().zip(ends)
            {
                // Our names of sites have two slashes and the number of the loop.
                let name = format!("loop/{place}/{end}{number}");
                let name = subject.names.taken.clone().free(name);
                let pose = frame * Translation3::new(0.0, 0.0, *along);
                self.sites[link].push(placed(site_named(&name), &pose));
                element = element.with(key, name);
            }
            self.equalities.push(element.with("solimp", STIFF));
        }
        true
    }
}

/// A coupling as an equality of one joint, or of two. `None` if it is of more, or of no joint as a polynomial of the other.
fn equation(subject: &Subject, coupling: &Coupling) -> Result<Option<Element>, ExportError> {
    let names = subject.robot.dof_names()?;
    let joint = |dof: usize| {
        let name = names.get(dof)?;
        subject.view.joints.iter().find(|joint| joint.name == *name && joint.num_dofs() == 1)
    };
    let only_linear = |[_, rest @ ..]: &[f64; 4]| rest.iter().all(|other| *other == 0.0);
    let (follower, leader) = match &coupling.terms[..] {
        [one] if only_linear(&one.coefficients) => (one, None),
        [one, other] if only_linear(&other.coefficients) => (other, Some(one)),
        [one, other] if only_linear(&one.coefficients) => (one, Some(other)),
        _ => return Ok(None),
    };
    let Some(joint1) = joint(follower.dof_idx.get()) else { return Ok(None) };
    let factor = -1.0 / follower.coefficients[0];
    let mut polynomial = [coupling.constant * factor, 0.0, 0.0, 0.0, 0.0];
    let mut element = Element::new("joint").with("joint1", joint1.name.as_str());
    if let Some(leader) = leader {
        let Some(joint2) = joint(leader.dof_idx.get()) else { return Ok(None) };
        element = element.with("joint2", joint2.name.as_str());
        for (to, coefficient) in polynomial[1..].iter_mut().zip(leader.coefficients) {
            *to = coefficient * factor;
        }
    }
    let is_finite = polynomial.iter().all(|number| number.is_finite());
    Ok(is_finite.then(|| element.with("polycoef", numbers(&polynomial))))
}
