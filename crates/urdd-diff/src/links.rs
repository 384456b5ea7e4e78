//! Differences of links: mass properties, geometry, other elements.

use crate::fields::{Fields, compare};
use crate::parts::matched;
use crate::side::Side;
use crate::{geometry, other_elements};
use urdd_format::diff_report::LinkDifference;
use urdd_format::meshes::GeometryKind;
use urdd_format::urdf::Link;
use urdd_xml::other_parts::Owner;

pub(super) fn differences(before: &Side, after: &Side, tolerance: f64) -> Vec<LinkDifference> {
    let (a, b) = (before.link_names(), after.link_names());
    let by_name = geometry::compared_by_name(before, after);
    let mut found = Vec::new();
    for part in matched(&a, &b) {
        let (mut changes, mut geometry) = (Vec::new(), Vec::new());
        if let Some((i, j)) = part.both() {
            let others = before.others_beside(after);
            let [x, y] =
                [(before, i, others[0]), (after, j, others[1])].map(|(side, link, others)| {
                    let link = &side.robot.links[link];
                    let mut fields = fields(link, side.has_quaternions());
                    other_elements::add(&link.unknown_elements, &side.account, &mut fields);
                    let owner = Owner::Link(link.name.clone());
                    other_elements::add_parts(others, &owner, &mut fields);
                    fields
                });
            changes = compare("", &x, &y, tolerance);
            for kind in [GeometryKind::Visual, GeometryKind::Collision] {
                let (x, y) = ((before, i), (after, j));
                geometry.extend(geometry::difference(x, y, kind, &by_name, tolerance));
            }
            if changes.is_empty() && geometry.is_empty() {
                continue;
            }
        }
        let (name, presence) = (part.name.to_owned(), part.presence());
        found.push(LinkDifference { name, presence, changes, geometry });
    }
    found
}

/// All values of a link but those of its geometry.
fn fields(link: &Link, quaternions: bool) -> Fields {
    let mut fields = Fields::default();
    if let Some(inertial) = &link.inertial {
        let mass = inertial.mass.as_ref().map(|mass| mass.value);
        fields.number("inertial.mass", "kg", mass);
        let origin = inertial.origin.as_ref();
        if mass.is_some() || inertial.inertia.is_some() || origin.is_some() {
            fields.origin("inertial.origin.", origin, quaternions);
        }
        if let Some(of) = &inertial.inertia {
            for (name, value) in [
                ("ixx", of.ixx),
                ("ixy", of.ixy),
                ("ixz", of.ixz),
                ("iyy", of.iyy),
                ("iyz", of.iyz),
                ("izz", of.izz),
            ] {
                fields.number(format!("inertial.{name}"), "kg m²", value);
            }
        }
    }
    fields
}
