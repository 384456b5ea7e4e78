//! Reasons for which `link_shapes_skips_module` may skip a pair that is not always in contact.

use std::collections::HashSet;

use super::poses::Poses;
use super::shape_set::ShapeSet;
use crate::context::Context;
use crate::views::shape_pair::CONTACT;
use urdd_document::shape_matrices::at;
use urdd_document::shapes::Shapes;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::registry::ModuleDocument;

/// The reasons other than `Always` for which `link_shapes_skips_module` may skip a pair.
pub struct OtherReasons<'a> {
    set: &'a ShapeSet,
    /// The pairs of links connected by a joint, if these are skipped.
    adjacent: HashSet<(usize, usize)>,
    /// The distances in the default configuration, if pairs in contact there are skipped.
    at_default: Option<Vec<Vec<f64>>>,
}

impl<'a> OtherReasons<'a> {
    pub fn new(
        context: &Context,
        document: &ModuleDocument,
        poses: &Poses,
        set: &'a ShapeSet,
    ) -> Self {
        let skipped = |reason: SkippedReason| match document {
            ModuleDocument::LinkShapesSkips(module) => module.skipped_reasons.contains(&reason),
            _ => false,
        };
        let chain = context.chain().filter(|_| skipped(SkippedReason::Adjacent));
        let joints = chain.iter().flat_map(|chain| &chain.joints_in_chain);
        let adjacent = joints.map(|joint| {
            let (a, b) = (joint.parent_link_idx.get(), joint.child_link_idx.get());
            (a.min(b), a.max(b))
        });
        let motion = poses.default_motion().ok().filter(|_| skipped(SkippedReason::Default));
        OtherReasons {
            set,
            adjacent: adjacent.collect(),
            at_default: motion.map(|motion| set.statistics(&motion).min),
        }
    }

    /// Whether a pair may be skipped for one of these reasons.
    pub fn may_skip(&self, shapes: &Shapes, (i, j): (usize, usize)) -> bool {
        let kind = self.set.kind;
        let links = shapes.link(kind, i).zip(shapes.link(kind, j));
        let adjacent = links.is_some_and(|(a, b)| self.adjacent.contains(&(a.min(b), a.max(b))));
        let places = self.set.place(i).zip(self.set.place(j));
        let distance =
            (self.at_default.as_ref().zip(places)).and_then(|(rows, (a, b))| at(rows, a, b));
        // A pair within the tolerance may be skipped.
        adjacent || distance.is_some_and(|distance| distance <= 2.0 * CONTACT)
    }
}
