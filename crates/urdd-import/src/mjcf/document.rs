//! An MJCF as one tree of elements: each `<include>` replaced by what is in its file.

use std::collections::HashSet;
use std::mem::replace;
use std::path::{Path, PathBuf};

use super::super::fault::{ImportFault, Unreachable};
use super::super::place::{Place, TextFile};
use super::super::refusal::{Fallible, Placing, at};
use super::attach::{self, Models};
use super::element::Element;
use super::fault::MjcfFault;
use super::reading::required;
use urdd_source::FoundMesh;
use urdd_source::gate::Gate;
use urdd_xml::{MAX_LEVELS, Mended, Node, parse_leniently};

/// Models that are attached, each to the one before.
const DEEPEST: usize = 10;

/// What a description and all that it includes and attaches say.
pub struct Whole {
    /// The files, the description first.
    pub files: Vec<TextFile>,
    /// The model that each file is of: 0 is the description, others are attached.
    pub models: Vec<usize>,
    pub root: Fallible<Element>,
}

/// Reads a description.
pub fn read(file: TextFile, gate: &Gate) -> Whole {
    let (path, text) = (file.path.clone(), file.text.clone());
    let (included, within) = (HashSet::new(), Vec::new());
    let mut expansion = Expansion {
        files: vec![file],
        models: vec![0],
        folder: PathBuf::new(),
        included,
        within,
        gate,
    };
    let root = expansion.model(&path, &text);
    Whole { files: expansion.files, models: expansion.models, root }
}

struct Expansion<'r> {
    files: Vec<TextFile>,
    models: Vec<usize>,
    /// That of the model that is read.
    folder: PathBuf,
    /// The names of its files, as they are written.
    included: HashSet<String>,
    /// The models that are read, each attached to the one before.
    within: Vec<PathBuf>,
    gate: &'r Gate,
}

impl Expansion<'_> {
    /// Reads a model, of which the last file is the first.
    fn model(&mut self, path: &Path, text: &str) -> Fallible<Element> {
        let file = self.files.len() - 1;
        let folder = path.parent().unwrap_or(Path::new("/")).to_owned();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let outer =
            (replace(&mut self.folder, folder), replace(&mut self.included, HashSet::from([name])));
        self.within.push(path.to_owned());
        let mut root = self.root(text, file)?;
        self.attach(&mut root)?;
        self.within.pop();
        (self.folder, self.included) = outer;
        Ok(root)
    }

    fn root(&mut self, text: &str, file: usize) -> Fallible<Element> {
        let mended = Mended::default();
        let document = parse(text, file, &mended, self.gate)?;
        let node = document.root_element();
        let place = Place { file, offset: mended.original(node.range().start) };
        let mut root = Element::new(node.tag_name().name().to_owned(), attributes(node), place);
        self.children(node, (file, &mended), 1, &mut root.children)?;
        Ok(root)
    }

    /// Puts the bodies of other models in the place of each `<attach>`.
    fn attach(&mut self, root: &mut Element) -> Fallible<()> {
        if !root.all("worldbody").any(attach::is_in) {
            return Ok(());
        }
        let mut models = Models::new();
        for asset in root.sections("asset").filter(|asset| asset.tag == "model") {
            let model = self.attached(asset)?;
            let name = asset.text("name").or(model.text("model")).unwrap_or_default().to_owned();
            models.insert(name, model);
        }
        let mut parts = Vec::new();
        for section in root.children.iter_mut().filter(|of| of.tag == "worldbody") {
            attach::splice(section, 2, &models, &mut parts, self.gate.account())?;
        }
        root.children.extend(parts);
        Ok(())
    }

    /// A model that can be attached.
    fn attached(&mut self, asset: &Element) -> Fallible<Element> {
        let name = required(asset, "file")?;
        let (text, path) = self.open(name, asset.place)?;
        if self.within.len() > DEEPEST || self.within.contains(&path) {
            return Err(at(asset.place, MjcfFault::DeepModels(DEEPEST)));
        }
        let number = self.models.last().map_or(0, |model| model + 1);
        self.models.push(number);
        self.model(&path, &text)
    }

    /// Reads a file that an element names, as the last of the files.
    fn open(&mut self, name: &str, place: Place) -> Fallible<(String, PathBuf)> {
        let beside = self.files[place.file].path.parent().map(|folder| folder.join(name));
        let places = [Some(self.folder.join(name)), beside];
        let found = first(self.gate, places.into_iter().flatten(), name).at(place)?;
        let read = TextFile::included(self.gate, &found).at(place)?;
        let opened = (read.text.clone(), read.path.clone());
        self.files.push(read);
        Ok(opened)
    }

    fn children(
        &mut self,
        parent: Node<'_, '_>,
        (file, mended): (usize, &Mended),
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        for node in parent.children().filter(Node::is_element) {
            let place = Place { file, offset: mended.original(node.range().start) };
            let tag = node.tag_name().name();
            if depth > MAX_LEVELS {
                return Err(at(place, MjcfFault::TooDeep(MAX_LEVELS)));
            }
            if tag.eq_ignore_ascii_case("include") {
                self.include(node, place, depth, into)?;
                continue;
            }
            let mut element = Element::new(tag.to_owned(), attributes(node), place);
            self.children(node, (file, mended), depth + 1, &mut element.children)?;
            into.push(element);
        }
        Ok(())
    }

    fn include(
        &mut self,
        node: Node<'_, '_>,
        place: Place,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Fallible<()> {
        let name = node.attribute("file").filter(|_| !node.children().any(|of| of.is_element()));
        let name = name.ok_or_else(|| at(place, MjcfFault::Include))?;
        if !self.included.insert(name.to_owned()) {
            return Err(at(place, MjcfFault::IncludedTwice(name.to_owned())));
        }
        let (text, _) = self.open(name, place)?;
        self.models.push(self.models[place.file]);
        let file = self.files.len() - 1;
        let mended = Mended::default();
        let document = parse(&text, file, &mended, self.gate)?;
        self.children(document.root_element(), (file, &mended), depth + 1, into)
    }
}

/// The first of some places that has a file which may be read. `name` is how the description names it.
pub fn first(
    gate: &Gate,
    places: impl IntoIterator<Item = PathBuf>,
    name: &str,
) -> Result<FoundMesh, Unreachable> {
    let mut fault = None;
    for place in places {
        match gate.at(&place) {
            Ok(found) => return Ok(found),
            Err(why) if why.outside.is_some() => {
                fault.get_or_insert(why);
            }
            Err(_) => {}
        }
    }
    Err(Unreachable::of(name, fault.unwrap_or_default()))
}

fn attributes(node: Node<'_, '_>) -> Vec<(String, String)> {
    node.attributes().map(|of| (of.name().to_owned(), of.value().to_owned())).collect()
}

fn parse<'t>(
    text: &'t str,
    file: usize,
    mended: &'t Mended,
    gate: &Gate,
) -> Fallible<urdd_xml::Document<'t>> {
    let document = parse_leniently(text, "mujoco", mended).map_err(|error| {
        let place = Place { file, offset: error.offset(text) };
        at(place, ImportFault::NotXml(error.words(text)))
    })?;
    gate.account().charge(mended.size()).at(Place { file, offset: 0 })?;
    Ok(document)
}
