use crate::rules::prelude::*;
use urdd_document::shapes::{Volume, approximations};

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesApproximations;
    for list in approximations(context.document(kind)?)? {
        for (link, piece, volume) in list.entries() {
            if let Some((field, expected, actual)) = fault(&volume) {
                let pointer = format!("{}/{field}", list.pointer(link, piece));
                let message =
                    format!("this cannot enclose a shape of {}", context.link_label(link));
                let finding = finding_in(Kind::LinkShapesApproximations, pointer, message);
                findings.report(finding.values(expected, actual));
            }
        }
    }
    Some(())
}

/// What is impossible about a size: field, expected, actual.
fn fault(volume: &Volume) -> Option<(String, &'static str, String)> {
    match volume {
        Volume::Sphere { radius, .. } => {
            let fault = || ("radius".to_owned(), "more than 0", radius.to_string());
            (*radius <= 0.0).then(fault)
        }
        Volume::Box { half_extents, .. } => {
            let mut axes = half_extents.iter().enumerate();
            if let Some((axis, half)) = axes.find(|(_, half)| **half < 0.0) {
                return Some((format!("half_extents/{axis}"), "0 or more", half.to_string()));
            }
            let expected = "at least one of three more than 0";
            let fault = || ("half_extents".to_owned(), expected, "[0, 0, 0]".to_owned());
            (*half_extents == [0.0; 3]).then(fault)
        }
    }
}
