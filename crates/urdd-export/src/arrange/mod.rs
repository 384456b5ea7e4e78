//! Another tree of the same robot: with another root, and with one body for links that are fixed to each other. It is made
//! before a format sees the robot, as a URDF and where everything of the URDD is in it.
//!
//! Links and joints keep names, order and values. A frame of the source that no body has is a link without mass and shapes
//! on a fixed joint, which formats with frames write as one.

mod merge;
mod root;

use crate::error::unknown;
use crate::{Choices, ExportError, Layout, Members, Note, Setup, Structure};
use urdd_format::urdf::UrdfModule;

/// A robot as it is exported.
pub(super) struct Arranged {
    pub urdf: UrdfModule,
    pub structure: Structure,
    pub layout: Layout,
    pub notes: Vec<Note>,
}

impl Arranged {
    pub fn new(urdf: UrdfModule, choices: &Choices) -> Result<Self, ExportError> {
        let structure = Structure::of(&urdf)?;
        let (layout, notes) = (Layout::default(), Vec::new());
        let mut made = Arranged { urdf, structure, layout, notes };
        if let Some(name) = &choices.root {
            let links = || made.structure.view.links.iter().map(|link| link.name.as_str());
            let root = links().position(|link| link == name);
            let root = root.ok_or_else(|| unknown("link", name, links()))?;
            if root != made.structure.tree.root {
                let notes = &mut made.notes;
                made.layout = root::turn(&mut made.urdf, &made.structure, root, notes)?;
                made.structure = Structure::of(&made.urdf)?;
            }
        }
        if choices.merge_fixed {
            merge::merge(&mut made.urdf, &made.structure, &mut made.layout, &mut made.notes)?;
            made.structure = Structure::of(&made.urdf)?;
        }
        Ok(made)
    }
}

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
