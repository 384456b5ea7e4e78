//! SRDF of a robot: the pairs of links that MoveIt does not check. Groups and other elements are read here; the package of
//! MoveIt writes them.

pub(super) mod groups;
pub(super) mod import;

use crate::{Export, ExportError, LinkPair, Subject};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_robot::RobotError;
use urdd_xml::writer::Element;

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut robot = Element::new("robot").with("name", subject.urdf.name.as_str());
    push_pairs(subject, &mut robot);
    let notes = subject.notes();
    let text = robot.document(&subject.comments(basis(subject)?, &notes)?);
    Ok(Export::of(text, Vec::new(), notes))
}

/// Adds the pairs that need no check.
pub(super) fn push_pairs(subject: &Subject, robot: &mut Element) {
    robot.extend(subject.disabled().map(|pair| disabled(subject, pair)));
}

fn disabled(subject: &Subject, pair: &LinkPair) -> Element {
    let links = pair.links.map(|link| subject.links[link].as_str());
    urdd_srdf::write::disabled(links, reason(subject, pair))
}

/// The reason as MoveIt's Setup Assistant writes it: `Adjacent` for two links that a joint connects, even if they are
/// always in contact.
fn reason(subject: &Subject, pair: &LinkPair) -> &'static str {
    let [a, b] = pair.links;
    let parent = &subject.tree.parent_link;
    let adjacent = parent[a] == Some(b) || parent[b] == Some(a);
    match (&pair.edit, pair.reason) {
        (Some(_), _) => "User",
        (_, Some(SkipReason::Always)) if adjacent => "Adjacent",
        (_, Some(SkipReason::Always | SkipReason::SameLink)) => "Always",
        (_, Some(SkipReason::Adjacent)) => "Adjacent",
        (_, Some(SkipReason::Default)) => "Default",
        (_, Some(SkipReason::Never)) => "Never",
        // A pair of which only some shapes are skipped has no reason of its own.
        (_, Some(SkipReason::None) | None) => "User",
    }
}

/// The basis of the reasons: the shapes and the number of samples.
pub(super) fn basis(subject: &Subject) -> Result<String, RobotError> {
    let shapes = subject.shapes;
    Ok(match subject.robot.num_samples()? {
        Some(samples) => {
            format!("Reasons by {shapes}; Always and Never by {samples} sampled configurations.")
        }
        None => format!("Reasons by {shapes}."),
    })
}
