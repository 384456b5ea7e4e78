//! Kinematic loops as ball constraints: Drake's parser has no others that hold two bodies together.
//!
//! A ball is one of them, a hinge two on its axis, and a weld three that are not on a line.

use crate::loops::{APART, LeftOut, OTHER_KIND, closings};
use crate::{ExportError, Note, Subject};
use nalgebra::Point3;
use urdd_format::loops::LoopKind;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

const SAP: &str = "ball constraints hold loops in simulation, with the solver SAP: Drake refuses the file for `DiscreteContactApproximation.kTamsi`";
const WORLD: &str = "Drake's constraints find no `world` in the model";

/// The constraints that hold the loops of a robot.
pub(super) fn constraints(
    subject: &Subject,
    notes: &mut Vec<Note>,
) -> Result<Vec<Element>, ExportError> {
    let mut left_out = LeftOut::default();
    let mut made = Vec::new();
    for closing in closings(subject, &mut left_out)? {
        let points = match closing.of.kind {
            LoopKind::Spherical => &[[0.0, 0.0, 0.0]][..],
            LoopKind::Revolute => &[[0.0, 0.0, 0.0], [0.0, 0.0, APART]],
            LoopKind::Fixed => &[[0.0, 0.0, 0.0], [APART, 0.0, 0.0], [0.0, APART, 0.0]],
            _ => {
                left_out.of_loop(&closing.of.name, OTHER_KIND);
                continue;
            }
        };
        if closing.ends.iter().any(|end| subject.is_world(end.link)) {
            left_out.of_loop(&closing.of.name, WORLD);
            continue;
        }
        let [a, b] = closing.ends;
        for point in points {
            let at = |key: &'static str, end: crate::layout::Place| {
                let point = end.pose * Point3::from(*point);
                Element::new(key).with("value", numbers(point.coords.as_slice()))
            };
            let body = |key: &'static str, link: usize| {
                Element::new(key).with("name", subject.links[link].as_str())
            };
            made.push(
                Element::new("drake:ball_constraint")
                    .holding(body("drake:ball_constraint_body_A", a.link))
                    .holding(body("drake:ball_constraint_body_B", b.link))
                    .holding(at("drake:ball_constraint_p_AP", a))
                    .holding(at("drake:ball_constraint_p_BQ", b)),
            );
        }
    }
    notes.extend(left_out.notes());
    if !made.is_empty() {
        notes.push(Note::Robot(SAP));
    }
    Ok(made)
}
