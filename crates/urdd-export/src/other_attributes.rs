//! Attributes that URDF does not define, on the elements of the source that a URDF has too.

use super::subject::Subject;
use urdd_xml::other_parts::{OtherPart, Owner};
use urdd_xml::writer::Element;

/// Whether a URDF has a part: an attribute, but for those of shapes and materials, which are the file's own.
pub(super) fn is_kept(part: &OtherPart) -> bool {
    let own = ["visual", "collision", "material"];
    part.is_attribute
        && !part.name.contains(':')
        && !own.iter().any(|own| part.path.starts_with(own))
}

/// Adds the attributes of the robot, a link or a joint to its element.
pub(super) fn add(subject: &Subject, owner: &Owner, element: &mut Element) {
    let parts = subject.other_parts.get(owner).into_iter().flatten();
    for part in parts.filter(|part| is_kept(part)) {
        let mut path = part.path.split('/').filter(|tag| !tag.is_empty());
        if let Some(at) = path.try_fold(&mut *element, |at, tag| at.child_mut(tag)) {
            at.set(&part.name, Some(&part.value));
        }
    }
}
