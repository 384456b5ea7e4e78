//! Reads the files of an SDF into a scene, and keeps what a URDF carries as text for Gazebo: plugins, sensors, and settings of
//! links.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::Isometry3;
use urdd_directory::account::Charged;
use urdd_kinematics::rotation::to_rpy;
use urdd_source::FoundMesh;
use urdd_source::gate::Gate;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;
use urdd_xml::{Mended, parse_leniently};

use super::assets::Assets;
use super::scene::{Frames, Posed, Scene};
use super::tag::Tag;
use crate::fault::{ImportFault, SdfFault};
use crate::features::{self, Tally};
use crate::model::{ENTRY, GazeboElement, LETTER};
use crate::place::{Fallible, Place, Placing, TextFile, at};
use crate::tree::Names;

/// The first minor version of SDF that is read, and the last.
const VERSIONS: [u32; 2] = [2, 12];

pub struct SdfReader<'r> {
    pub gate: &'r Gate,
    pub files: Vec<TextFile>,
    pub scene: Scene,
    pub tally: Tally,
    pub assets: Assets,
    pub kept: Charged<GazeboElement>,
    /// What is kept when it is known where frames are.
    pub posed: Vec<Posed>,
    pub friction: Friction,
    /// The names of links and joints, with the models that they are in.
    links: Names,
    joints: Names,
    /// The files that are being read, the outermost first.
    open: Vec<PathBuf>,
}

impl<'r> SdfReader<'r> {
    pub fn new(gate: &'r Gate) -> Self {
        SdfReader {
            gate,
            files: Vec::new(),
            scene: Scene::default(),
            tally: Tally::default(),
            assets: Assets::default(),
            kept: Charged::default(),
            posed: Vec::new(),
            friction: Friction::default(),
            links: Names::new(gate.account()),
            joints: Names::new(gate.account()),
            open: Vec::new(),
        }
    }

    pub fn folder(&self, file: usize) -> PathBuf {
        let path = self.files.get(file).map(|file| file.path.as_path());
        path.and_then(Path::parent).unwrap_or(Path::new("/")).to_owned()
    }

    /// Reads an included file, and goes on with its outermost element.
    ///
    /// # Errors
    /// If it cannot be read, includes itself, or what is done with it fails.
    pub fn include<T>(
        &mut self,
        found: &FoundMesh,
        place: Place,
        then: impl FnOnce(&mut Self, Tag) -> Fallible<T>,
    ) -> Fallible<T> {
        if self.open.contains(&found.file) {
            let file = found.file.display().to_string();
            return Err(at(place, SdfFault::IncludeCircle(file)));
        }
        match TextFile::included(self.gate, found) {
            Ok(file) => self.open(file, then),
            Err(why) => Err(at(place, why)),
        }
    }

    /// The name of something in a scope, with the models that it is in; it is charged. Of two that would be the same, as
    /// `n/b` and `b` of a model `n`, the second gets a number.
    pub fn whole_name(&mut self, tag: Tag, scope: usize, name: &str) -> Fallible<String> {
        let prefix = &self.scene.scopes[scope].prefix;
        self.charge(ENTRY + LETTER * (prefix.len() + name.len()), tag.place())?;
        // Files before 1.8 have names with the models that they are in.
        let whole = format!("{prefix}{}", name.replace("::", "/"));
        let names = match tag.name() {
            "link" => &mut self.links,
            "joint" => &mut self.joints,
            _ => return Ok(whole),
        };
        names.free(&whole).at(tag.place())
    }

    pub fn charge(&self, bytes: usize, place: Place) -> Fallible<()> {
        self.gate.account().charge(bytes).at(place)
    }

    /// Goes on with the outermost element of a file.
    ///
    /// # Errors
    /// If it is not an SDF, or what is done with it fails.
    pub fn open<T>(
        &mut self,
        file: TextFile,
        then: impl FnOnce(&mut Self, Tag) -> Fallible<T>,
    ) -> Fallible<T> {
        let known = self.files.iter().position(|known| known.path == file.path);
        let index = known.unwrap_or(self.files.len());
        let (text, path) = (Arc::<str>::from(&*file.text), file.path.clone());
        if known.is_none() {
            self.files.push(file);
        }
        let mended = Mended::default();
        let document = match parse_leniently(&text, "sdf", &mended) {
            Ok(document) => document,
            Err(error) => {
                let place = Place { file: index, offset: error.offset(&text) };
                return Err(at(place, ImportFault::NotXml(error.sentence(&text))));
            }
        };
        self.charge(mended.size(), Place { file: index, offset: 0 })?;
        let node = document.root_element();
        let root = Tag { node, file: index, mended: &mended, version: 0 };
        let root = Tag { version: version(root)?, ..root };
        self.open.push(path);
        let done = then(self, root);
        self.open.pop();
        done
    }
}

/// The minor version that an outermost element names.
fn version(root: Tag) -> Fallible<u32> {
    if root.name() == "robot" {
        let words = root.attribute("name").unwrap_or_default().to_owned();
        return Err(at(root.place(), SdfFault::IncludesUrdf(words)));
    }
    if !matches!(root.name(), "sdf" | "gazebo") {
        return Err(at(root.place(), SdfFault::Root(root.name().to_owned())));
    }
    let version = root.attribute("version").unwrap_or_default().trim();
    let minor = version.strip_prefix("1.").and_then(|rest| {
        // `1.4.0` was seen.
        rest.split('.').next()?.parse().ok()
    });
    let [first, last] = VERSIONS;
    match minor.filter(|minor| (first..=last).contains(minor)) {
        Some(minor) => Ok(minor),
        None => Err(at(root.place(), SdfFault::Version(version.to_owned()))),
    }
}

/// What was met so far.
#[derive(Debug, Default)]
pub struct Friction {
    first: Option<Option<f64>>,
    is_mixed: bool,
    /// How many shapes say one.
    given: usize,
}

/// Where the coefficient is.
const PATHS: [&[&str]; 2] =
    [&["surface", "friction", "ode", "mu"], &["surface", "friction", "bullet", "friction"]];

impl Friction {
    /// Looks at a collision shape.
    pub fn meet(&mut self, collision: Tag, tally: &mut Tally) {
        let found = PATHS.iter().find_map(|path| collision.descendant(path));
        let found = found.and_then(|tag| tag.text().parse::<f64>().ok());
        let found = found.filter(|value| value.is_finite() && *value >= 0.0);
        self.is_mixed |= *self.first.get_or_insert(found) != found;
        if let Some(surface) = collision.child("surface") {
            let others = surface.node.descendants().filter(|node| {
                node.is_element() && !node.children().any(|child| child.is_element())
            });
            if others.count() > usize::from(found.is_some()) {
                tally.count(features::CONTACTS);
            }
        }
        self.given += usize::from(found.is_some());
    }

    /// The coefficient that all have. Counts those that differ.
    pub fn common(&self, tally: &mut Tally) -> Option<f64> {
        let feature = if self.is_mixed { features::FRICTIONS } else { features::FRICTION };
        tally.add(feature, self.given);
        self.first.flatten().filter(|_| !self.is_mixed)
    }
}

/// What an element of a link or joint is kept for: its name in the URDF, and its node.
pub type Owner<'n> = (&'n str, usize);

/// Keeps an element of the model, or of a link or joint.
pub fn keep(reader: &mut SdfReader, tag: Tag, owner: Option<Owner>) -> Fallible<()> {
    let mut element = Element::of(tag.node);
    if element.has_prefix() {
        reader.tally.unread(format!("`<{}>` with prefixes in it", tag.name()));
        return Ok(());
    }
    reader.tally.count(features::KEPT);
    let (pose, relative_to) = match owner {
        Some(_) => tag.pose()?,
        None => (Isometry3::identity(), None),
    };
    match (owner, relative_to) {
        (Some((name, node)), Some(relative_to)) => {
            let owner = name.to_owned();
            let (pose, place) = ((pose, relative_to), tag.place());
            reader.charge(element.fragment().len() + LETTER * name.len(), place)?;
            reader.posed.push(Posed { element, owner, node, pose, place });
            Ok(())
        }
        _ => {
            // Where it is empty, other versions and programs take it for a name.
            if let Some(pose) = element.child_mut("pose") {
                pose.set("frame", None);
                pose.set("relative_to", None);
            }
            push(reader, element, owner.map(|(name, _)| name), tag.place())
        }
    }
}

pub fn keep_plugins(reader: &mut SdfReader, tag: Tag) -> Fallible<()> {
    let mut plugins = tag.children().filter(|child| child.name() == "plugin");
    plugins.try_for_each(|plugin| keep(reader, plugin, None))
}

/// Puts elements into the frames of their links and joints, which a URDF has.
pub fn keep_posed(reader: &mut SdfReader, scene: &Scene, frames: &Frames) -> Fallible<()> {
    for Posed { mut element, owner, node, pose: (pose, name), place } in
        std::mem::take(&mut reader.posed)
    {
        match scene.find(scene.nodes[node].scope, &name) {
            Some(base) => {
                let pose = frames.relative(base, node) * pose;
                let rpy = to_rpy(pose.rotation.to_rotation_matrix().matrix());
                let place = [pose.translation.vector.as_slice(), &rpy].concat();
                element.remove("pose");
                element.say("pose", &numbers(&place));
            }
            None => {
                let text =
                    format!("the pose of this `<{}>` names no frame: `{name}`", element.name());
                reader.tally.remark(place, text);
            }
        }
        push(reader, element, Some(&owner), place)?;
    }
    Ok(())
}

/// Keeps that the robot is static. libsdformat takes the word of the last `<gazebo>` for it, and a missing one for no.
pub fn keep_static(reader: &mut SdfReader, place: Place) -> Fallible<()> {
    reader.tally.count(features::KEPT);
    push(reader, Element::text("static", "true"), None, place)
}

fn push(
    reader: &mut SdfReader,
    element: Element,
    owner: Option<&str>,
    place: Place,
) -> Fallible<()> {
    let gazebo = Element::new("gazebo").with_some("reference", owner).holding(element);
    let kept = GazeboElement(gazebo.fragment());
    reader.kept.push(kept, reader.gate.account()).at(place)
}
