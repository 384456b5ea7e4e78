//! What exports are made from.

use super::error::{ExportError, Note};
use super::pairs::{LinkPair, pairs};
use super::{Format, Options, names};
use crate::document::robot::{Robot as View, of_urdf};
use crate::document::tree::Tree;
use crate::format::urdf::UrdfModule;
use crate::robot::{LinkShape, Robot, RobotError, ShapeKind};

/// A robot, as far as every format needs it.
pub(super) struct Subject<'a> {
    pub robot: &'a Robot,
    pub format: Format,
    pub options: &'a Options,
    pub urdf: UrdfModule,
    /// The same with the defaults of URDF filled in.
    pub view: View,
    pub tree: Tree,
    /// Names of links, in link order.
    pub links: Vec<String>,
    /// Empty where there are no skips.
    pub pairs: Vec<LinkPair>,
}

impl<'a> Subject<'a> {
    pub fn new(
        robot: &'a Robot,
        format: Format,
        options: &'a Options,
    ) -> Result<Self, ExportError> {
        let urdf = robot.description()?;
        names::check(format, "robot", &urdf.name)?;
        let view = of_urdf(&urdf);
        let tree = Tree::new(&view).ok_or(ExportError::NoTree)?;
        for (index, link) in urdf.links.iter().enumerate() {
            // MuJoCo's own body `world` may be the root.
            let is_world = format == Format::Mjcf && index == tree.root && link.name == "world";
            if !is_world {
                names::check(format, "link", &link.name)?;
            }
        }
        for joint in &urdf.joints {
            names::check(format, "joint", &joint.name)?;
        }
        let links: Vec<String> = urdf.links.iter().map(|link| link.name.clone()).collect();
        let pairs = match format {
            // A URDF has no place for them.
            Format::Urdf | Format::Foam => Vec::new(),
            _ => pairs(robot, &links, options.shapes, options.reasons.as_deref())?,
        };
        Ok(Subject {
            robot,
            format,
            options,
            urdf,
            view,
            tree,
            links,
            pairs,
        })
    }

    /// The shapes of a kind, of each link, in link order.
    pub fn shapes_by_link(&self, kind: ShapeKind) -> Result<Vec<Vec<LinkShape>>, ExportError> {
        let mut shapes: Vec<Vec<LinkShape>> = self.links.iter().map(|_| Vec::new()).collect();
        for shape in self.robot.shapes(kind)? {
            if let Some(of_link) = shapes.get_mut(shape.link) {
                of_link.push(shape);
            }
        }
        match shapes.iter().all(Vec::is_empty) {
            true => Err(ExportError::NoShapes(kind)),
            false => Ok(shapes),
        }
    }

    /// The pairs that need no check.
    pub fn disabled(&self) -> impl Iterator<Item = &LinkPair> {
        self.pairs.iter().filter(|pair| pair.disabled)
    }

    /// What is to be said about the pairs.
    pub fn notes(&self) -> Vec<Note> {
        match self.pairs.iter().filter(|pair| pair.whole).count() {
            0 => Vec::new(),
            count => vec![Note::Whole { count }],
        }
    }

    /// What the file was made from, a sentence an element.
    pub fn origin(&self) -> Result<Vec<String>, RobotError> {
        let mut lines = vec![format!(
            "{} of robot `{}`, made by urdd {} from the URDD `{}`.",
            self.format.name(),
            self.urdf.name,
            env!("CARGO_PKG_VERSION"),
            self.robot.folder_name(),
        )];
        if let Some(source) = self.robot.source()? {
            let (path, digest) = (source.path, source.sha256);
            lines.push(format!("Source: {path}, SHA-256 {digest}."));
        }
        Ok(lines)
    }
}
