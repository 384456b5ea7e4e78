use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::shapes::{Volume, approximations};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// A box has a negative half extent or no extent at all, or a sphere's radius is not positive.
    ///
    /// No box or sphere of such a size holds a link. Geometry libraries turn a negative size inside
    /// out, or answer every question about it with no. (A flat link may have a box that is flat in one
    /// or two directions.)
    ///
    /// Write `half_extents` as half of each side's length, and the radius as a length: both positive.
    SHP003 "impossible-shape-size", Error, clause "8.2", since "0.1.0",
    phase References, needs [Module(Kind::LinkShapesApproximations)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesApproximations;
    let Some(lists) = context.document(kind).and_then(approximations) else {
        return;
    };
    let Some(module) = context.module(kind) else {
        return;
    };
    for list in &lists {
        for (link, entry) in list.links.iter().enumerate() {
            for (piece, volume) in entry.iter().enumerate() {
                let Some((field, expected, actual)) = fault(volume) else {
                    continue;
                };
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("{}/{field}", list.pointer(link, piece)),
                        format!("this cannot hold a shape of {}", context.link_label(link)),
                    )
                    .expected(expected)
                    .actual(actual),
                );
            }
        }
    }
}

/// What is impossible about a size: field, expected, actual.
fn fault(volume: &Volume) -> Option<(String, &'static str, String)> {
    match volume {
        Volume::Sphere { radius, .. } if *radius <= 0.0 => {
            Some(("radius".to_owned(), "more than 0", radius.to_string()))
        }
        Volume::Sphere { .. } => None,
        Volume::Box { half_extents, .. } => {
            if let Some(axis) = half_extents.iter().position(|half| *half < 0.0) {
                let value = half_extents.get(axis).map(f64::to_string);
                let field = format!("half_extents/{axis}");
                return Some((field, "0 or more", value.unwrap_or_default()));
            }
            half_extents.iter().all(|half| *half == 0.0).then(|| {
                let field = "half_extents".to_owned();
                (
                    field,
                    "at least one of three more than 0",
                    "[0, 0, 0]".to_owned(),
                )
            })
        }
    }
}
