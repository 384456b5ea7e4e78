//! Another tree of the same robot: with another root, and with one body for links that are fixed to each other. It is made
//! before a format sees the robot, as a URDF and where everything of the URDD is in it.
//!
//! Links and joints keep names, order and values. A frame of the source that no body has is a link without mass and shapes
//! on a fixed joint, which formats with frames write as one.

mod groups;
mod lump;
mod merge;
mod root;

use super::error::{ExportError, Note, unknown};
use super::layout::Layout;
use super::options::LinkOptions;
use super::structure::Structure;
pub(super) use groups::setup;
use urdd_format::urdf::UrdfModule;

/// A robot as it is exported.
pub(super) struct Arranged {
    pub urdf: UrdfModule,
    pub structure: Structure,
    pub layout: Layout,
    pub notes: Vec<Note>,
}

impl Arranged {
    pub fn new(urdf: UrdfModule, options: Option<&LinkOptions>) -> Result<Self, ExportError> {
        let structure = Structure::of(&urdf)?;
        let (layout, notes) = (Layout::default(), Vec::new());
        let mut made = Arranged { urdf, structure, layout, notes };
        let Some(options) = options else {
            return Ok(made);
        };
        if let Some(name) = &options.root {
            let links = || made.structure.view.links.iter().map(|link| link.name.as_str());
            let root = links().position(|link| link == name);
            let root = root.ok_or_else(|| unknown("link", name, links()))?;
            if root != made.structure.tree.root {
                let notes = &mut made.notes;
                made.layout = root::turn(&mut made.urdf, &made.structure, root, notes)?;
                made.structure = Structure::of(&made.urdf)?;
            }
        }
        if options.merge_fixed {
            merge::merge(&mut made.urdf, &made.structure, &mut made.layout, &mut made.notes)?;
            made.structure = Structure::of(&made.urdf)?;
        }
        Ok(made)
    }
}
