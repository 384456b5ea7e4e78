//! Groups, tools and the like, of another tree.

use crate::error::Note;
use crate::layout::Layout;
use crate::setup::{Members, Setup};
use crate::structure::Structure;

const CHAIN: &str = "its chain runs another way now; it is a group of joints, for which MoveIt solves no inverse kinematics";

/// What is said of the robot of a URDD, of another tree of it.
pub(crate) fn setup(
    setup: &Setup,
    source: &Structure,
    now: &Structure,
    layout: &Layout,
    notes: &mut Vec<Note>,
) -> Setup {
    let mut setup = setup.clone();
    let links = setup.tools.value.iter_mut().chain(&mut setup.imus.value);
    let links = links.chain(setup.end_effectors.iter_mut().map(|end| &mut end.value.parent_link));
    links.for_each(|link| *link = layout.frame(*link));
    for group in &mut setup.groups {
        let Members::Chain { base, tip } = group.value.members else {
            continue;
        };
        let moving = |of: &Structure, base: usize, tip: usize| {
            let mut joints = of.between(base, tip);
            joints.retain(|joint| of.view.joints[*joint].num_dofs() > 0);
            joints
        };
        let mut joints = moving(source, base, tip);
        let (base, tip) = (layout.body(base), layout.frame(tip));
        group.value.members = if moving(now, base, tip) == joints {
            Members::Chain { base, tip }
        } else {
            notes.push(Note::Group { group: group.value.name.clone(), what: CHAIN });
            joints.sort_unstable();
            Members::Joints(joints)
        };
    }
    setup
}
