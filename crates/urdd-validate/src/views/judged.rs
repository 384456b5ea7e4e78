//! Decides which parts a rule judges: readable ones that passed the rules that it needs. Other parts are recorded as not
//! verified.

use super::enclosure::{self, Enclosure};
use crate::context::Context;
use urdd_document::shapes::Shapes;
use urdd_findings::code::Code;
use urdd_findings::finding::Findings;
use urdd_findings::part::{Part, Why};
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

/// Whether to judge a part against other parts.
pub fn judged(context: &Context, findings: &mut Findings, part: Part, by: &[Part]) -> bool {
    for needed in std::iter::once(&part).chain(by) {
        let (kind, link, piece) = needed.place();
        let solids = context.solids();
        if solids.holds(kind, link, piece) && solids.sound(kind, link, piece).is_none() {
            findings.not_verified(part, Why::Unreadable);
            return false;
        }
        // Nothing is compared with a plain mesh that differs from the robot's geometry.
        let is_wrong = || context.placed().wrong.iter().any(|wrong| wrong.link == link);
        if matches!(needed, Part::Plain(_)) && is_wrong() {
            findings.not_verified(part, Why::Failed(Code::MSH015));
            return false;
        }
    }
    findings.judges(part, by)
}

/// Every box and sphere whose hull or piece is judged.
pub fn enclosures<'a>(context: &'a Context, findings: &mut Findings) -> Vec<Enclosure<'a>> {
    for kind in [ModuleKind::ConvexHullMeshes, ModuleKind::ConvexDecompositionMeshes] {
        for mesh in context.solids().derived(kind) {
            if let (None, Some(part)) = (mesh.sound(), Part::of(kind, mesh.link, mesh.piece)) {
                findings.not_verified(part, Why::Unreadable);
            }
        }
    }
    let mut all = enclosure::enclosures(context, context.solids());
    all.retain(|one| judged(context, findings, one.part(), &[]));
    all
}

/// The shapes of a kind whose distances are judged.
pub struct JudgedShapes(Vec<bool>);

impl JudgedShapes {
    pub fn new(
        context: &Context,
        findings: &mut Findings,
        shapes: &Shapes,
        kind: ShapeKind,
    ) -> Self {
        let mut is_judged = |shape| {
            shapes.place(kind, shape).is_none_or(|(link, piece)| {
                judged(context, findings, Part::of_shape(kind, link, piece), &[])
            })
        };
        JudgedShapes((0..shapes.count(kind)).map(&mut is_judged).collect())
    }

    /// Whether both shapes of a pair are judged.
    pub fn pair(&self, i: usize, j: usize) -> bool {
        let judged = |shape: usize| self.0.get(shape).copied().unwrap_or(true);
        judged(i) && judged(j)
    }
}
