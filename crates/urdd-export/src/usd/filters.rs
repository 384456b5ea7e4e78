//! Pairs that need no collision check: of two bodies, or of two of their shapes where the URDD checks others.
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
            match (&pair.mixed, joint) {
                (None, Some(joint)) if !pair.disabled => {
                    filters.checked.insert(joint);
                }
                (None, None) if pair.disabled => filters.add(a.clone(), b.clone()),
                (None, _) => {}
                (Some(mixed), joint) => {
                    filters.checked.extend(joint);
                    for [one, other] in &mixed.skipped {
                        filters.add(path_of_shape(a, *one), path_of_shape(b, *other));
                    }
                }
            }
        }
        filters
    }

    fn add(&mut self, from: String, to: String) {
        self.targets.entry(from).or_default().push(to);
    }
}
