//! Which parts a rule judges: those that are sound by the rules that it needs, and that can be read.
//! What is left out is noted as not verified.

use super::enclosure::{self, Enclosure};
use crate::code::Code;
use crate::context::Context;
use crate::finding::Findings;
use crate::part::{Part, Why};
use urdd_document::shapes::Shapes;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

/// Whether to judge a part, by itself or by others.
pub fn judged(context: &Context, findings: &mut Findings, part: Part, by: &[Part]) -> bool {
    for needed in std::iter::once(&part).chain(by) {
        let (kind, link, piece) = needed.place();
        let solids = context.solids();
        if solids.holds(kind, link, piece) && solids.sound(kind, link, piece).is_none() {
            findings.not_verified(part, Why::Unreadable);
            return false;
        }
        if matches!(needed, Part::Plain(_)) && context.is_misplaced(link) {
            findings.not_verified(part, Why::Failed(Code::MSH015));
            return false;
        }
    }
    findings.judges(part, by)
}

/// Every box and sphere of which the hull or piece is judged.
pub fn enclosures<'a>(context: &'a Context, findings: &mut Findings) -> Vec<Enclosure<'a>> {
    for kind in [
        ModuleKind::ConvexHullMeshes,
        ModuleKind::ConvexDecompositionMeshes,
    ] {
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

/// For each shape of a kind, whether to judge its distances.
pub fn shapes(
    context: &Context,
    findings: &mut Findings,
    shapes: &Shapes,
    kind: ShapeKind,
) -> Vec<bool> {
    let part = |shape| shapes.place(kind, shape);
    (0..shapes.count(kind))
        .map(|shape| {
            part(shape).is_none_or(|(link, piece)| {
                judged(context, findings, Part::of_shape(kind, link, piece), &[])
            })
        })
        .collect()
}
