//! The input of all exports: a robot, and what a person chose for a format.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::HashMap;
use std::ops::Deref;

use nalgebra::Isometry3;
use thiserror::Error;

use crate::arrange::Arranged;
use crate::choices::CHOICES;
use crate::contacts::{Basis, Judged, num_samples};
use crate::names::JointNames;
use crate::source_shapes::{SourceShapes, fit, has_capsules, takes_hulls};
use crate::{
    Choices, ExportError, Format, Layout, LinkPair, Note, Setup, Shape, Shapes, Structure, arrange,
    names, source_shapes,
};
use urdd_directory::account::Account;
use urdd_directory::export_toml::{ActuatorKind, JointGains};
use urdd_directory::range::OutOfRange;
use urdd_format::registry::PROGRAM_VERSION;
use urdd_format::urdf::UrdfModule;
use urdd_robot::{LinkShape, Robot, RobotError, ShapeKind};
use urdd_xml::Xml;
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
    pub options: &'a Options,
    /// The account of the run.
    pub account: &'a Account,
    pub format: Format,
    /// The shapes that approximate links.
    pub shapes: Shapes,
    /// Those that only the export has, by link of the URDD.
    own_shapes: Option<Vec<Vec<Shape>>>,
    /// What the URDD does not say, if a person said it.
    pub given: Option<Cow<'a, Setup>>,
    /// Whether the root link moves freely.
    pub is_floating: bool,
    pub described: UrdfModule,
    pub urdf: UrdfModule,
    pub structure: Structure,
    /// Where its links are in those of `robot`.
    pub layout: Layout,
    /// What is otherwise since links were joined, or another is the root.
    pub arranged: Vec<Note>,
    pub names: JointNames,
    /// What the source says where URDF defines nothing.
    pub other_parts: OtherParts,
    pub links: Vec<String>,
    /// Empty for formats without pairs.
    pub pairs: Vec<LinkPair>,
    /// Of what the shapes are made.
    pub shape_notes: Vec<Note>,
    pub lost: Option<Note>,
}

impl<'a> Subject<'a> {
    /// Pairs take long to judge.
    pub fn new(
        robot: &'a Robot,
        options: &'a Options,
        with_pairs: bool,
        account: &'a Account,
    ) -> Result<Self, ExportError> {
        let (format, chosen) = (options.format, &options.chosen);
        let (shapes, given) = (chosen.shapes, chosen.setup.as_ref());
        let has_pairs = with_pairs && !format.has_spheres() && !format.is_plain_urdf();
        let described = robot.description()?;
        let own = Structure::of(&described)?;
        if let Some(setup) = given {
            own.check(&setup.of)?;
        }
        let made = Arranged::new(described.clone(), chosen)?;
        names::check(format, &made.structure.view, &made.structure.tree)?;
        let Arranged { urdf, structure, mut layout, notes: mut arranged } = made;
        let given = given.map(|setup| match layout.is_empty() {
            true => Cow::Borrowed(setup),
            false => Cow::Owned(arrange::setup(setup, &own, &structure, &layout, &mut arranged)),
        });
        let links: Vec<String> = urdf.links.iter().map(|link| link.name.clone()).collect();
        let (mut own_shapes, mut shape_notes) = match shapes {
            Shapes::Source if format.has_spheres() => return Err(ExportError::SpheresOf(shapes)),
            Shapes::Source => {
                let SourceShapes { by_link, notes } = SourceShapes::new(robot, &described, format)?;
                (Some(by_link), notes)
            }
            Shapes::Kind(_) => (None, source_shapes::notes(robot, &described, shapes, format)?),
        };
        if let Some(costs) = chosen.fit {
            let mut by_link = match (own_shapes.take(), shapes) {
                (None, Shapes::Kind(kind)) => by_link(&described, robot.shapes(kind)?),
                (own, _) => own.unwrap_or_default(),
            };
            let (fitted, note) = fit(&mut by_link, costs, has_capsules(format));
            shape_notes.push(note);
            if fitted > 0 || shapes == Shapes::Source {
                own_shapes = Some(by_link);
            }
        }
        // URDF cannot express pairs; the sphere formats compute their own.
        let basis = match (&own_shapes, shapes) {
            _ if !has_pairs => None,
            (Some(written), _) => {
                // It takes long.
                account.charge(0)?;
                let samples = num_samples(robot)?;
                let judged = Judged::new(robot, &own, written, takes_hulls(format), samples)?;
                Some(Basis::Written(Box::new(judged)))
            }
            (None, Shapes::Kind(kind)) => Some(Basis::Kind(kind, robot.skips(kind)?)),
            _ => None,
        };
        if !layout.is_empty() {
            let mut places = match (&basis, &own_shapes, shapes) {
                (Some(basis), ..) => basis.skips().places().to_vec(),
                (None, None, Shapes::Kind(kind)) => {
                    robot.shapes(kind)?.iter().map(|shape| (shape.link, shape.piece)).collect()
                }
                _ => Vec::new(),
            };
            let by_link = own_shapes.iter().flatten().enumerate();
            places.extend(
                by_link.flat_map(|(link, shapes)| {
                    shapes.iter().map(move |shape| (link, shape.number))
                }),
            );
            layout.number(places);
        }
        let of_pieces = format == Format::Mjcf;
        let pairs = match &basis {
            Some(basis) => basis.link_pairs(robot, &layout, &links, chosen, of_pieces, account)?,
            None => Vec::new(),
        };
        let is_floating =
            chosen.floating_base || given.as_ref().is_some_and(|setup| setup.floating.value);
        let names = JointNames::new(format, &structure);
        let text = robot.source_text()?.unwrap_or_default();
        Ok(Subject {
            robot,
            options,
            account,
            format,
            shapes,
            own_shapes,
            given,
            is_floating,
            described,
            urdf,
            structure,
            layout,
            arranged,
            names,
            other_parts: other_parts(&Xml::new(&text)),
            links,
            pairs,
            shape_notes,
            lost: None,
        })
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
    pub fn shapes_by_link(&self) -> Result<Vec<Vec<Shape>>, ExportError> {
        match (&self.own_shapes, self.shapes) {
            (None, Shapes::Kind(kind)) => self.shapes_of(kind),
            (own, _) => Ok(self.layout.gather_shapes(own.clone().unwrap_or_default())),
        }
    }

    /// The URDD's shapes of a kind, by link.
    pub fn shapes_of(&self, kind: ShapeKind) -> Result<Vec<Vec<Shape>>, ExportError> {
        Ok(self.layout.gather_shapes(by_link(&self.described, self.robot.shapes(kind)?)))
    }

    /// What a person set for the actuator of a joint.
    pub fn gains(&self, joint: usize) -> JointGains {
        self.given
            .as_ref()
            .and_then(|setup| setup.gains.joints.get(&joint))
            .cloned()
            .unwrap_or_default()
    }

    /// What the actuator of a joint is told: where positions are asked for, what a person set.
    pub fn actuator_kind(&self, joint: usize, asked: ActuatorKind) -> ActuatorKind {
        match asked {
            ActuatorKind::Position => self.gains(joint).kind.unwrap_or(asked),
            ActuatorKind::Velocity | ActuatorKind::Motor => asked,
        }
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
        let source = Structure::of(&self.described)?;
        Ok(Cow::Owned(arrange::setup(&guess, &source, &self.structure, &self.layout, notes)))
    }

    /// For each joint of one DOF that follows no other, the index of its DOF.
    pub fn dofs(&self) -> Result<Vec<Option<usize>>, ExportError> {
        let dofs = self.robot.dof_names()?.iter().map(String::as_str).zip(0..);
        let dofs: HashMap<&str, usize> = dofs.collect();
        let joints = self.view.joints.iter();
        Ok(joints.map(|joint| dofs.get(joint.name.as_str()).copied()).collect())
    }

    /// The values of the DOFs of a configuration, by name.
    pub fn values(&self, configuration: &[f64]) -> Result<HashMap<&str, f64>, RobotError> {
        let dofs = self.robot.dof_names()?.iter().map(String::as_str);
        Ok(dofs.zip(configuration.iter().copied()).collect())
    }

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
        let notes = notes.iter().chain(&self.shape_notes).chain(&self.arranged).chain(&self.lost);
        lines.extend(notes.map(|note| format!("Note: {note}.")));
        Ok(lines)
    }
}

/// Shapes by link of the URDD. They have the names of the link's collision elements, in their order.
pub(super) fn by_link(described: &UrdfModule, shapes: Vec<LinkShape>) -> Vec<Vec<Shape>> {
    let links = &described.links;
    let mut by_link: Vec<Vec<Shape>> = links.iter().map(|_| Vec::new()).collect();
    for shape in shapes {
        let link = shape.link;
        if let (Some(of_link), Some(urdf)) = (by_link.get_mut(link), links.get(link)) {
            let element = urdf.collision.get(of_link.len());
            let name = element.and_then(|element| element.name.clone());
            of_link.push(Shape { name, ..shape.into() });
        }
    }
    by_link
}

/// The options of a format. [`Choices::options`] makes it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The format.
    pub format: Format,
    /// What was chosen. What the format has no place for is not read.
    pub chosen: Choices,
    /// The folder of the mesh files, relative to the text: without a trailing `/`, and empty for the same folder.
    pub mesh_folder: String,
    /// The name of the package, which MoveIt's configuration always has.
    pub package: Option<String>,
    /// The name of the file.
    pub file: Option<String>,
}

/// An option that does not fit the format.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{option} is for {} only", self.formats())]
pub struct Misfit {
    /// The option, as in [`Choices`].
    pub option: &'static str,
    /// The formats that it is for.
    pub of: &'static [Format],
}

impl Misfit {
    /// The words of the formats that the option is for.
    pub fn formats(&self) -> String {
        let words: Vec<&str> = self.of.iter().map(|format| format.word()).collect();
        match words.split_last() {
            Some((last, others)) if !others.is_empty() => {
                format!("{} and {last}", others.join(", "))
            }
            _ => words.concat(),
        }
    }
}

impl Choices {
    /// The name of the package of a configuration of MoveIt that is not written to a folder.
    pub const PACKAGE: &str = "robot_moveit_config";

    /// The options of a format. Meshes and packages are named after what is written.
    ///
    /// # Errors
    /// If something was chosen that the format does not have.
    pub fn options(&self, format: Format) -> Result<Options, Misfit> {
        let misfit = |of: &&crate::Choice| (of.is_chosen)(self) && !of.of.contains(&format);
        if let Some(choice) = CHOICES.iter().find(misfit) {
            return Err(Misfit { option: choice.name, of: choice.of });
        }
        let mut chosen = self.clone();
        chosen.bandwidth =
            chosen.bandwidth.filter(|_| matches!(format, Format::Mjcf | Format::Usd));
        let has_setup = !matches!(format, Format::Srdf | Format::Foam | Format::Spherized)
            && !format.is_plain_urdf();
        chosen.setup = chosen.setup.filter(|_| has_setup);
        let text = |of: &std::ffi::OsStr| of.to_string_lossy().into_owned();
        let output = self.output.as_ref();
        let file = output.and_then(|output| output.file_name()).map(text);
        let named = output.map(|file| text(file.file_stem().unwrap_or_default()) + "_meshes");
        let mut mesh_folder = self.mesh_folder.clone().or(named);
        let mut package = self.package.clone();
        if format == Format::Moveit {
            // Whether ROS takes it, the export says.
            let folder = output.map(|_| file.clone().unwrap_or_default().to_lowercase());
            package = package.or(folder.map(|folder| folder.replace(['-', ' ', '.'], "_")));
            let inside = package.as_ref().map(|package| format!("package://{package}/meshes"));
            mesh_folder = self.mesh_folder.clone().or(inside).or(mesh_folder);
            package = package.or_else(|| Some(Self::PACKAGE.to_owned()));
        }
        let mesh_folder = mesh_folder.unwrap_or_else(|| "meshes".to_owned());
        Ok(Options { format, chosen, mesh_folder, package, file })
    }
}

impl Options {
    /// Checks that each option is in its range.
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        CHOICES.iter().try_for_each(|choice| (choice.check)(&self.chosen))
    }
}
