//! Pairs that need no collision check: of two bodies, or, where a person keeps pairs of which the URDD checks some pieces,
//! of two of their shapes. MuJoCo, by which Newton simulates, has 32 bits for pairs of shapes, which do not suffice for
//! most robots; pairs of bodies it leaves out exactly.
//!
//! The two bodies of a joint are not checked unless the joint says so: a joint whose links the URDD checks does.

use std::collections::{BTreeMap, HashSet};

use super::super::pairs::ascending;
use super::super::subject::Subject;
use super::names::{Paths, path_of_shape};

/// What pairs ask for.
#[derive(Default)]
pub(super) struct Filters {
    /// For the path of a link or a shape, those that it is not checked with.
    pub targets: BTreeMap<String, Vec<String>>,
    /// The joints whose links are checked with each other, at least in part.
    pub checked: HashSet<usize>,
}

impl Filters {
    pub fn new(subject: &Subject, paths: &Paths) -> Self {
        let mut filters = Filters::default();
        let joints = &subject.tree.joint_links;
        let joint = |links: [usize; 2]| {
            joints.iter().position(|&(parent, child)| ascending(parent, child) == links)
        };
        for pair in &subject.pairs {
            let joint = joint(pair.links);
            let [a, b] = pair.links.map(|link| &paths.links[link]);
            if pair.disabled {
                if joint.is_none() {
                    filters.add(a.clone(), b.clone());
                }
                continue;
            }
            filters.checked.extend(joint);
            for [one, other] in pair.mixed.iter().flat_map(|mixed| &mixed.skipped) {
                filters.add(path_of_shape(a, *one), path_of_shape(b, *other));
            }
        }
        filters
    }

    fn add(&mut self, from: String, to: String) {
        self.targets.entry(from).or_default().push(to);
    }
}
