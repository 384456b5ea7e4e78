//! URDF for Drake: convex OBJ meshes, joints that Drake's parser accepts, and pairs of links that need no check as
//! collision filter groups.

mod joints;
mod transmissions;

use std::collections::BTreeMap;

use super::element::Element;
use super::error::{ExportError, Note};
use super::output::Export;
use super::subject::Subject;
use super::urdf_elements::{Geometry, IN_JOINT, IN_LINK, IN_ROBOT, links, push_unknown, robot};

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let urdf = &subject.urdf;
    let mut robot = robot(subject).with("xmlns:drake", "http://drake.mit.edu");
    let mut notes = Vec::new();
    let (links, files) = links(subject, Geometry::Drake, &mut notes)?;
    let joints = joints::joints(subject, &mut notes)?;
    let mut lost = 0;
    for (mut element, link) in links.into_iter().zip(&urdf.links) {
        lost += push_unknown(&mut element, &link.unknown_elements, IN_LINK);
        robot.push(element);
    }
    for link in joints.links {
        robot.push(Element::new("link").with("name", link));
    }
    for (mut element, joint) in joints.elements {
        lost += push_unknown(&mut element, &joint.unknown_elements, IN_JOINT);
        robot.push(element);
    }
    let elements = transmissions::taken(&urdf.unknown_elements, &joints.driven, &mut notes);
    lost += push_unknown(&mut robot, &elements, IN_ROBOT);
    if lost > 0 {
        notes.push(Note::Elements(lost));
    }
    for group in groups(subject) {
        robot.push(group);
    }
    notes.extend(subject.notes());
    let what = format!(
        "Collision geometry, and pairs that are filtered: {}.",
        subject.options.shapes
    );
    Ok(Export {
        text: robot.document(&subject.comments(what, &notes)?),
        files,
        notes,
    })
}

/// One collision filter group for each link in a pair. It ignores the groups of its partners with a higher index.
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
