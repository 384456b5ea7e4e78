//! URDF for Drake: convex OBJ meshes, and pairs of links that need no check as collision filter groups.

use std::collections::BTreeMap;

use super::Export;
use super::element::Element;
use super::error::ExportError;
use super::subject::Subject;
use super::urdf::{Dialect, robot};

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let (mut robot, files, notes) = robot(subject, Dialect::Drake)?;
    for group in groups(subject) {
        robot.push(group);
    }
    let mut comments = subject.origin()?;
    let shapes = subject.options.shapes;
    comments.push(format!(
        "Collision geometry, and pairs that are filtered: {shapes}."
    ));
    Ok(Export {
        text: robot.document(&comments),
        files,
        notes,
    })
}

/// A group of each link that is in a pair, which ignores those of its partners with a higher index.
fn groups(subject: &Subject) -> Vec<Element> {
    let mut partners: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for pair in subject.disabled() {
        let [a, b] = pair.links;
        partners.entry(a).or_default().push(b);
        partners.entry(b).or_default();
    }
    let name = |link: usize| format!("link_{link}");
    let group = |(link, ignored): (usize, Vec<usize>)| {
        let member = Element::new("drake:member").with("link", subject.links[link].as_str());
        let mut group = Element::new("drake:collision_filter_group").with("name", name(link));
        group.push(member);
        for other in ignored {
            let ignored = Element::new("drake:ignored_collision_filter_group");
            group.push(ignored.with("name", name(other)));
        }
        group
    };
    partners.into_iter().map(group).collect()
}
