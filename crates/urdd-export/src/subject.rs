//! The input of all exports.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::HashMap;
use std::ops::Deref;

use nalgebra::Isometry3;

use super::arrange::{self, Arranged};
use super::contacts::link_pairs;
use super::error::{ExportError, Note};
use super::format::Format;
use super::layout::Layout;
use super::names;
use super::options::Options;
use super::pairs::{LinkPair, pairs};
use super::parts::JointNames;
use super::setup::{JointGains, Setup};
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
    /// The shapes that approximate links.
    pub shapes: ShapeKind,
    /// What the URDD does not say, if a person said it.
    pub given: Option<Cow<'a, Setup>>,
    /// Whether the root link moves freely.
    pub is_floating: bool,
    pub urdf: UrdfModule,
    pub structure: Structure,
    /// Where its links are in those of `robot`.
    pub layout: Layout,
    /// What is otherwise since links were joined, or another is the root.
    pub arranged: Vec<Note>,
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
    pub fn new(robot: &'a Robot, options: &'a Options) -> Result<Self, ExportError> {
        let (format, shapes, given) = options.common();
        let (made, given) = arranged(robot, options, given)?;
        names::check(format, &made.structure.view, &made.structure.tree)?;
        let Arranged { urdf, structure, layout, notes: arranged } = made;
        let links: Vec<String> = urdf.links.iter().map(|link| link.name.clone()).collect();
        let mut is_floating = given.as_ref().is_some_and(|setup| setup.floating.value);
        let pairs = match options {
            Options::Srdf(of) => link_pairs(robot, &layout, of)?,
            Options::Drake(of) => link_pairs(robot, &layout, &of.model.pairs)?,
            Options::Moveit(of) => link_pairs(robot, &layout, &of.model.pairs)?,
            Options::Sdf(of) => {
                is_floating |= of.floating_base;
                link_pairs(robot, &layout, &of.model.pairs)?
            }
            // MJCF handles pairs of pieces exactly.
            Options::Mjcf(of) => {
                is_floating |= of.floating_base;
                pairs::<ExportError>(robot, &layout, shapes, of.reasons.as_deref(), false)?
            }
            Options::Usd(of) => {
                is_floating |= of.floating_base;
                link_pairs(robot, &layout, &of.pairs)?
            }
            // URDF cannot express pairs; the sphere formats compute their own.
            Options::Urdf(_) | Options::Curobo(_) | Options::Foam(_) | Options::Spherized(_) => {
                Vec::new()
            }
        };
        let names = JointNames::new(format, &structure);
        let text = robot.source_text()?.unwrap_or_default();
        Ok(Subject {
            robot,
            format,
            shapes,
            given,
            is_floating,
            urdf,
            structure,
            layout,
            arranged,
            names,
            other_parts: other_parts(&text),
            links,
            pairs,
            lost: None,
        })
    }

    /// The shapes of all links.
    pub fn shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        let mut shapes = self.robot.shapes(kind)?;
        shapes.iter_mut().for_each(|shape| self.layout.place(shape));
        Ok(shapes)
    }

    /// The poses of links in the root link's frame.
    pub fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, RobotError> {
        Ok(self.layout.poses(self.robot.link_poses(configuration)?))
    }

    /// Whether a link is but a frame on its parent.
    pub fn is_frame(&self, link: usize) -> bool {
        self.layout.is_frame.get(link).is_some_and(|is_frame| *is_frame)
    }

    /// Whether a joint carries a frame.
    pub fn is_of_frame(&self, joint: usize) -> bool {
        self.is_frame(self.tree.joint_links[joint].1)
    }

    /// The shapes of each link, in link order.
    pub fn shapes_by_link(&self) -> Result<Vec<Vec<LinkShape>>, ExportError> {
        let mut shapes: Vec<Vec<LinkShape>> = self.links.iter().map(|_| Vec::new()).collect();
        for shape in self.shapes(self.shapes)? {
            if let Some(of_link) = shapes.get_mut(shape.link) {
                of_link.push(shape);
            }
        }
        Ok(shapes)
    }

    /// What a person set for the actuator of a joint.
    pub fn gains(&self, joint: usize) -> JointGains {
        self.given
            .as_ref()
            .and_then(|setup| setup.gains.joints.get(&joint))
            .copied()
            .unwrap_or_default()
    }

    /// The coefficient of friction of all shapes, if a person set one.
    pub fn friction(&self) -> Option<f64> {
        self.given.as_ref().and_then(|setup| setup.friction)
    }

    /// Whether the root link of an MJCF or a USD moves freely. One called `world` cannot: it is MuJoCo's own body.
    pub fn has_free_base(&self) -> bool {
        self.is_floating && !self.is_world(self.tree.root)
    }

    /// What the format needs and the URDD does not say: a person's, or guesses, with a note.
    pub fn setup(&self, notes: &mut Vec<Note>) -> Result<Cow<'_, Setup>, ExportError> {
        if let Some(setup) = &self.given {
            return Ok(Cow::Borrowed(setup));
        }
        notes.push(Note::Guessed);
        let guess = Setup::guess(self.robot)?;
        if self.layout.is_empty() {
            return Ok(Cow::Owned(guess));
        }
        let source = Structure::new(self.robot)?;
        Ok(Cow::Owned(arrange::setup(&guess, &source, &self.structure, &self.layout, notes)))
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
            Reverse(counted.map_or(0, |contacts| {
                if pair.disabled { contacts.checked } else { contacts.skipped }
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
        let notes = notes.iter().chain(&self.arranged).chain(&self.lost);
        lines.extend(notes.map(|note| format!("Note: {note}.")));
        Ok(lines)
    }
}

/// The robot as it is exported, and what a person said of the one of the URDD, of this one.
fn arranged<'a>(
    robot: &Robot,
    options: &Options,
    given: Option<&'a Setup>,
) -> Result<(Arranged, Option<Cow<'a, Setup>>), ExportError> {
    let source = Structure::new(robot)?;
    if let Some(setup) = given {
        source.check(&setup.of)?;
    }
    let mut made = Arranged::new(robot.description()?, options.links())?;
    if made.layout.is_empty() {
        return Ok((made, given.map(Cow::Borrowed)));
    }
    let (format, shapes, _) = options.common();
    let places: Vec<(usize, usize)> = match format {
        Format::Srdf => robot.skips(shapes)?.places().to_vec(),
        _ => robot.shapes(shapes)?.iter().map(|shape| (shape.link, shape.piece)).collect(),
    };
    made.layout.number(places);
    let Arranged { structure, layout, notes, .. } = &mut made;
    let setup = given.map(|setup| arrange::setup(setup, &source, structure, layout, notes));
    Ok((made, setup.map(Cow::Owned)))
}
