//! Describes the target of a pointer into a module by the names of links, joints and DOFs.

use super::context::Context;
use urdd_document::shapes::Shapes;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shape_kind::ShapeKind;

/// Maximum length of a name in messages, characters.
const LONGEST: usize = 60;

pub(super) struct Names<'a> {
    context: &'a Context,
    shapes: Option<Shapes>,
}

impl<'a> Names<'a> {
    pub(super) fn new(context: &'a Context) -> Self {
        let shapes = context.shapes();
        Names { context, shapes }
    }

    /// The target of a pointer into a module's document; `None` if it has no name.
    pub(super) fn subject(&self, kind: ModuleKind, pointer: &str) -> Option<String> {
        let mut parts = pointer.split('/').skip(1);
        let key = parts.next()?;
        let rest: Vec<&str> = parts.collect();
        let index = |place: usize| rest.get(place)?.parse::<usize>().ok();
        match kind {
            ModuleKind::Urdf | ModuleKind::Chain => match key {
                "links" | "links_in_chain" => self.link(index(0)?),
                "joints" | "joints_in_chain" => self.joint(index(0)?),
                _ => None,
            },
            ModuleKind::Dof if key.starts_with("joint_idx") => self.joint(index(0)?),
            ModuleKind::Dof | ModuleKind::Bounds => self.dof(index(0)?),
            ModuleKind::Connections if key == "root_paths" => self.link(index(0)?),
            ModuleKind::Connections => match index(1) {
                Some(other) => self.links(index(0)?, other),
                None => self.link(index(0)?),
            },
            ModuleKind::OriginalMeshes => match self.context.document(kind)? {
                ModuleDocument::OriginalMeshes(module) if key == "references" => {
                    self.link(module.references.get(index(0)?)?.link_idx.get())
                }
                ModuleDocument::OriginalMeshes(_) => None,
                _ => self.link(index(0)?),
            },
            ModuleKind::PlainMeshes | ModuleKind::ConvexHullMeshes => self.link(index(0)?),
            ModuleKind::ConvexDecompositionMeshes => self.piece(index(0)?, index(1)),
            ModuleKind::LinkShapesApproximations | ModuleKind::LinkShapesMaxDistanceFromOrigin => {
                match key.starts_with("decomposition") {
                    true => self.piece(index(0)?, index(1)),
                    false => self.link(index(0)?),
                }
            }
            ModuleKind::KinematicsSamples => match (key, rest.get(1), index(2)) {
                ("samples", Some(&"link_poses"), Some(link)) => self.link(link),
                _ => None,
            },
            ModuleKind::LinkShapesDistanceStatistics
            | ModuleKind::LinkShapesSimpleSkips
            | ModuleKind::LinkShapesSkips
            | ModuleKind::LinkShapesLieAlgErrorModels => self.shapes(pointer),
            _ => None,
        }
    }

    /// An element of a matrix over shapes: its two shapes.
    fn shapes(&self, pointer: &str) -> Option<String> {
        let shapes = self.shapes.as_ref()?;
        let parts = || pointer.split('/').skip(1);
        let kind = ShapeKind::ALL
            .into_iter()
            .find(|kind| parts().any(|part| part.starts_with(kind.key())))?;
        let mut indices = parts().filter_map(|part| part.parse::<usize>().ok());
        let shape = |index: usize| match kind.is_of_links() {
            true => self.link_name(*shapes.full.get(index)?),
            false => {
                let (link, piece) = *shapes.pieces.get(index)?;
                Some(format!("{} piece {piece}", self.link_name(link)?))
            }
        };
        let first = shape(indices.next()?)?;
        match indices.next() {
            Some(second) => Some(format!("{first}, {}", shape(second)?)),
            None => Some(first),
        }
    }

    fn link(&self, link: usize) -> Option<String> {
        Some(format!("link {}", self.link_name(link)?))
    }

    fn links(&self, a: usize, b: usize) -> Option<String> {
        Some(format!("{}, {}", self.link_name(a)?, self.link_name(b)?))
    }

    fn piece(&self, link: usize, piece: Option<usize>) -> Option<String> {
        let link = self.link(link)?;
        Some(match piece {
            Some(piece) => format!("{link} piece {piece}"),
            None => link,
        })
    }

    fn joint(&self, joint: usize) -> Option<String> {
        let joint = self.context.robot()?.joints.get(joint)?;
        Some(format!("joint {}", quoted(&joint.name)))
    }

    fn dof(&self, dof: usize) -> Option<String> {
        let joint = self.context.dofs()?.dof_idx_to_joint_idx_mapping.get(dof)?.get();
        Some(format!("DOF {dof} of {}", self.joint(joint)?))
    }

    fn link_name(&self, link: usize) -> Option<String> {
        let link = self.context.robot()?.links.get(link)?;
        Some(quoted(&link.name))
    }
}

fn quoted(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("`{}…`", &name[..end]),
        None => format!("`{name}`"),
    }
}
