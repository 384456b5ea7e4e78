//! The links of rigid groups.

use urdd_document::robot::{Link, Robot};
use urdd_document::tree::RigidGroup;

/// The links of a rigid group, with their indices.
pub(super) fn links_of<'a>(
    robot: &'a Robot,
    group: &'a RigidGroup,
) -> impl Iterator<Item = (usize, &'a Link)> + Clone {
    let links = group.links.iter();
    links.filter_map(|index| Some((*index, robot.links.get(*index)?)))
}
