//! The input of all exports.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::HashMap;
use std::ops::Deref;

use super::contacts::link_pairs;
use super::error::{ExportError, Note};
use super::format::Format;
use super::names;
use super::options::Options;
use super::pairs::{LinkPair, pairs};
use super::parts::JointNames;
use super::setup::Setup;
use super::structure::Structure;
use urdd_format::registry::PROGRAM_VERSION;
use urdd_format::urdf::UrdfModule;
use urdd_robot::{LinkShape, Robot, RobotError, ShapeKind};
use urdd_xml::other_parts::{OtherParts, other_parts};

impl Deref for Subject<'_> {
    type Target = Structure;

    fn deref(&self) -> &Structure {
        &self.structure
    }
}

/// The data of a robot that every format needs.
pub(super) struct Subject<'a> {
    pub robot: &'a Robot,
    pub format: Format,
    pub options: &'a Options,
    pub urdf: UrdfModule,
    pub structure: Structure,
    pub names: JointNames,
    /// What the source says where URDF defines nothing.
    pub other_parts: OtherParts,
    /// Names of links, in link order.
    pub links: Vec<String>,
    /// Empty for formats without pairs.
    pub pairs: Vec<LinkPair>,
    /// What the format cannot carry of this robot.
    pub lost: Option<Note>,
}

impl<'a> Subject<'a> {
    pub fn new(
        robot: &'a Robot,
        format: Format,
        options: &'a Options,
    ) -> Result<Self, ExportError> {
        let urdf = robot.description()?;
        let structure = Structure::of(&urdf)?;
        names::check(format, &structure.view, &structure.tree)?;
        options.package.as_deref().map_or(Ok(()), names::check_package)?;
        if let Some(setup) = &options.setup {
            structure.check(&setup.of)?;
        }
        let links: Vec<String> = urdf.links.iter().map(|link| link.name.clone()).collect();
        let pairs = match format {
            // URDF cannot express pairs; the sphere formats compute their own.
            Format::Urdf | Format::Curobo | Format::Foam | Format::Spherized => Vec::new(),
            // MJCF handles pairs of pieces exactly.
            Format::Mjcf => pairs(robot, options)?,
            _ => link_pairs(robot, options)?,
        };
        let names = JointNames::new(format, &structure);
        let text = robot.source_text()?.unwrap_or_default();
        Ok(Subject {
            robot,
            format,
            options,
            urdf,
            structure,
            names,
            other_parts: other_parts(&text),
            links,
            pairs,
            lost: None,
        })
    }

    /// The shapes of a kind for each link, in link order.
    pub fn shapes_by_link(&self, kind: ShapeKind) -> Result<Vec<Vec<LinkShape>>, ExportError> {
        let mut shapes: Vec<Vec<LinkShape>> = self.links.iter().map(|_| Vec::new()).collect();
        for shape in self.robot.shapes(kind)? {
            if let Some(of_link) = shapes.get_mut(shape.link) {
                of_link.push(shape);
            }
        }
        // The sphere formats need shapes.
        let is_needed = matches!(self.format, Format::Curobo | Format::Foam | Format::Spherized);
        match is_needed && shapes.iter().all(Vec::is_empty) {
            true => Err(ExportError::NoShapes(kind)),
            false => Ok(shapes),
        }
    }

    /// Whether the root link of an MJCF moves freely. One called `world` is MuJoCo's own body, which cannot.
    pub fn has_free_base(&self) -> bool {
        self.options.floating() && !self.is_world(self.tree.root)
    }

    /// What the format needs and the URDD does not say: a person's, or guesses, with a note.
    pub fn setup(&self, notes: &mut Vec<Note>) -> Result<Cow<'_, Setup>, ExportError> {
        Ok(match &self.options.setup {
            Some(setup) => Cow::Borrowed(setup),
            None => {
                notes.push(Note::Guessed);
                Cow::Owned(Setup::guess(self.robot)?)
            }
        })
    }

    /// For each joint of one DOF that follows no other, the index of its DOF.
    pub fn dofs(&self) -> Result<Vec<Option<usize>>, ExportError> {
        let dofs = self.robot.dof_names()?.iter().map(String::as_str).zip(0..);
        let dofs: HashMap<&str, usize> = dofs.collect();
        let joints = self.view.joints.iter();
        Ok(joints.map(|joint| dofs.get(joint.name.as_str()).copied()).collect())
    }

    /// The pairs that need no collision check.
    pub fn disabled(&self) -> impl Iterator<Item = &LinkPair> {
        self.pairs.iter().filter(|pair| pair.disabled)
    }

    /// The notes of a link-level format on its pairs, those with the greatest loss first.
    pub fn notes(&self) -> Vec<Note> {
        let contacts = |pair: &&LinkPair| {
            let counted = pair.mixed.as_ref().and_then(|mixed| mixed.contacts);
            Reverse(counted.map_or(0, |contacts| match pair.disabled {
                true => contacts.checked,
                false => contacts.skipped,
            }))
        };
        let mut pairs: Vec<&LinkPair> = self.pairs.iter().collect();
        pairs.sort_by_key(contacts);
        pairs.into_iter().filter_map(Note::of_pair).collect()
    }

    /// The source of the file, one sentence per element.
    pub fn origin(&self) -> Result<Vec<String>, RobotError> {
        let mut lines = vec![format!(
            "{} of robot `{}`, made by urdd {} from the URDD `{}`.",
            self.format.name(),
            self.urdf.name,
            PROGRAM_VERSION,
            self.robot.folder_name(),
        )];
        if let Some(source) = self.robot.source()? {
            let (path, digest) = (source.path, source.sha256);
            lines.push(format!("Source: {path}, SHA-256 {digest}."));
        }
        Ok(lines)
    }

    /// Comments for the head of a file: its source, its content, and its notes.
    pub fn comments(&self, what: String, notes: &[Note]) -> Result<Vec<String>, RobotError> {
        let mut lines = self.origin()?;
        lines.push(what);
        let notes = notes.iter().chain(&self.lost);
        lines.extend(notes.map(|note| format!("Note: {note}.")));
        Ok(lines)
    }
}
