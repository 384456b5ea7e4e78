//! How many links, joints, DOFs and so on a URDD has: what the annotations of an extension are judged by (SPEC 11.4).

use std::collections::BTreeSet;

use crate::context::Context;
use urdd_format::annotations::Thing;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// The number of each thing; `None` where the URDD does not say.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Counts {
    links: Option<usize>,
    joints: Option<usize>,
    dofs: Option<usize>,
    /// The largest number of visual elements of a link.
    visuals: Option<usize>,
    /// The largest number of collision elements of a link.
    collisions: Option<usize>,
    /// The convex pieces, if the URDD has them.
    pub pieces: Option<Pieces>,
    full_shapes: Option<usize>,
    parts: Option<usize>,
    pairs: Option<usize>,
}

/// The convex pieces. What a hostile document asks for often is computed once.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Pieces {
    /// The number of pieces of each link.
    pub of_link: Vec<usize>,
    /// The same numbers, each once.
    pub numbers: BTreeSet<usize>,
    total: usize,
}

impl Pieces {
    fn new(of_link: Vec<usize>) -> Pieces {
        Pieces { numbers: of_link.iter().copied().collect(), total: of_link.iter().sum(), of_link }
    }
}

impl Counts {
    pub fn of(context: &Context) -> Counts {
        let robot = context.robot();
        let most = |counts: &mut dyn Iterator<Item = usize>| counts.max().unwrap_or(0);
        let meshes = |kind| {
            let meshes = context.meshes(kind)?;
            Some((0..meshes.num_links()).map(|link| meshes.count(link)).collect::<Vec<_>>())
        };
        let hulls = meshes(ModuleKind::ConvexHullMeshes);
        Counts {
            links: robot.map(|robot| robot.links.len()),
            joints: robot.map(|robot| robot.joints.len()),
            dofs: context.dofs().map(|dofs| dofs.num_dofs.get()),
            visuals: robot.map(|robot| most(&mut robot.links.iter().map(|link| link.visual.len()))),
            collisions: robot
                .map(|robot| most(&mut robot.links.iter().map(|link| link.collision.len()))),
            pieces: meshes(ModuleKind::ConvexDecompositionMeshes).map(Pieces::new),
            full_shapes: hulls.map(|hulls| hulls.iter().filter(|count| **count > 0).count()),
            parts: match context.document(ModuleKind::Composition) {
                Some(ModuleDocument::Composition(module)) => Some(module.parts.len()),
                _ => None,
            },
            pairs: match context.document(ModuleKind::SelfCollisionModel) {
                Some(ModuleDocument::SelfCollisionModel(module)) => Some(module.pairs.len()),
                _ => None,
            },
        }
    }

    /// What an index of a thing must be below; `None` where nothing limits it.
    pub fn below(&self, thing: Thing) -> Option<u64> {
        let count = match thing {
            Thing::Piece => self.pieces.as_ref()?.numbers.last().copied().unwrap_or(0),
            Thing::Visual => self.visuals?,
            Thing::Collision => self.collisions?,
            Thing::Sample => return Some(1 << 32),
            Thing::Other => return None,
            thing => self.count(thing)?,
        };
        Some(count as u64)
    }

    /// The length of a list with an element for each of a thing; `None` where nothing decides it, or (pieces) the link.
    pub fn count(&self, thing: Thing) -> Option<usize> {
        match thing {
            Thing::Link => self.links,
            Thing::Joint => self.joints,
            Thing::Dof => self.dofs,
            Thing::FullShape => self.full_shapes,
            Thing::DecompositionShape => Some(self.pieces.as_ref()?.total),
            Thing::Part => self.parts,
            Thing::Pair => self.pairs,
            Thing::Piece | Thing::Visual | Thing::Collision | Thing::Sample | Thing::Other => None,
        }
    }
}
