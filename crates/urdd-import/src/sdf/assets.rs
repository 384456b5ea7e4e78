//! The meshes and images of a robot, with the files that meshes name, under paths below its URDF; and parts of meshes, as
//! `<submesh>` names them: a node of COLLADA, an object or group of OBJ.

use std::cell::OnceCell;
use std::collections::{BTreeMap, HashSet};
use std::ops::Range;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use nalgebra::Vector3;
use urdd_directory::account::Charged;
use urdd_directory::path::file_name;
use urdd_source::gate::Gate;
use urdd_source::{FoundMesh, Inspected};
use urdd_xml::element::{Edit, apply};
use urdd_xml::{Kind, Node, parse};

use crate::fault::{ImportFault, Unreachable};
use crate::model::Asset;

#[derive(Debug, Default)]
pub struct Assets {
    pub files: Charged<Asset>,
    /// Where each file is in the list, by the file that it was.
    known: BTreeMap<PathBuf, usize>,
    /// Where each mesh is in the list, or a part of it.
    meshes: BTreeMap<(PathBuf, Option<String>), usize>,
    /// The mesh files that were read, or why they are none.
    read: BTreeMap<PathBuf, Result<Whole, String>>,
    /// The middle of each part of a mesh.
    middles: BTreeMap<usize, Vector3<f64>>,
    /// What each path is taken by, in lower case.
    taken: BTreeMap<String, PathBuf>,
    /// The number of groups of files that have a folder of their own.
    groups: usize,
}

/// What looking for a file costs for each byte of its name and folder.
pub const LOOKED_AT: usize = 100;

/// A mesh file, the files that it names, and its parts, if it has names for them.
#[derive(Debug)]
struct Whole {
    bytes: Arc<[u8]>,
    sides: Vec<(PathBuf, Arc<[u8]>)>,
    parts: OnceCell<Option<Parts>>,
}

impl Assets {
    /// Adds the mesh that a URI names, or a part of it, with the files that it names. Gives its place in the list.
    ///
    /// # Errors
    /// If it is not found, may not be read, is no mesh, or costs too much.
    pub fn mesh(
        &mut self,
        gate: &Gate,
        uri: &str,
        folder: &Path,
        part: Option<&str>,
    ) -> Result<usize, ImportFault> {
        let found = find(gate, uri, folder)?;
        let file = found.file.clone();
        let key = (file.clone(), part.map(str::to_owned));
        if let Some(known) = self.meshes.get(&key) {
            return Ok(*known);
        }
        let read = self.read.entry(file.clone()).or_insert_with(|| whole(gate.mesh(&found), &file));
        let no_mesh =
            |reason: &String| Unreachable::NotMesh { file: uri.to_owned(), reason: reason.clone() };
        let whole = read.as_ref().map_err(no_mesh)?;
        let (mut source, mut bytes, mut middle) = (file, Arc::clone(&whole.bytes), None);
        if let Some(name) = part {
            let parts = whole.parts.get_or_init(|| Parts::of(&whole.bytes)).as_ref();
            gate.account().charge(parts.map_or(0, Parts::cost))?;
            let missing = || Unreachable::NoPart { file: uri.to_owned(), part: name.to_owned() };
            let found = parts.and_then(|parts| parts.part(name)).ok_or_else(missing)?;
            source = of_part(&source, name, |path| self.known.contains_key(path));
            middle = middle_of(&found, &source).map_err(|reason| no_mesh(&reason))?;
            bytes = found.into();
        }
        let sides = whole.sides.iter().cloned();
        let group = [(source, bytes)].into_iter().chain(sides).collect();
        let index = self.add(gate, group)?;
        self.middles.extend(middle.map(|middle| (index, middle)));
        self.meshes.insert(key, index);
        Ok(index)
    }

    /// Adds the image that a URI names.
    ///
    /// # Errors
    /// If it is not found, may not be read, is no image, or costs too much.
    pub fn image(&mut self, gate: &Gate, uri: &str, folder: &Path) -> Result<usize, ImportFault> {
        let found = find(gate, uri, folder)?;
        if let Some(known) = self.known.get(&found.file) {
            return Ok(*known);
        }
        let image = gate.image(&found, b"");
        match image.map_err(|why| ImportFault::of_image(uri, why))? {
            Some(bytes) => self.add(gate, vec![(found.file, bytes.into())]),
            None => Err(Unreachable::NotImage { file: uri.to_owned() }.into()),
        }
    }

    pub fn middle(&self, index: usize) -> Vector3<f64> {
        self.middles.get(&index).copied().unwrap_or_default()
    }

    /// Adds a file that was made, once.
    pub fn made(&mut self, gate: &Gate, path: &str, bytes: Vec<u8>) -> Result<usize, ImportFault> {
        let source = PathBuf::from(path);
        match self.known.get(&source) {
            Some(known) => Ok(*known),
            None => self.push(gate, source, path.to_owned(), bytes.into()),
        }
    }

    /// Adds a file with those that it names. Gives the place of the first in the list.
    fn add(&mut self, gate: &Gate, group: Vec<(PathBuf, Arc<[u8]>)>) -> Result<usize, ImportFault> {
        let top = common(group.iter().map(|(path, _)| path.as_path()));
        let base = self.base(&top, group.iter().map(|(path, _)| path.as_path()));
        let mut first = None;
        for (number, (path, bytes)) in group.into_iter().enumerate() {
            let written = written(&base, &top, &path, number == 0);
            let is_there = self.taken.contains_key(&written.to_lowercase());
            let known = self.known.get(&path).copied().filter(|_| is_there);
            let index = known.map_or_else(|| self.push(gate, path, written, bytes), Ok)?;
            first.get_or_insert(index);
        }
        Ok(first.unwrap_or_default())
    }

    /// The folder for files below another, in which no path is taken by another file.
    fn base<'p>(&mut self, top: &Path, group: impl Iterator<Item = &'p Path> + Clone) -> String {
        let is_free = |base: &str| {
            group.clone().enumerate().all(|(number, path)| {
                let written = written(base, top, path, number == 0);
                let taken = self.taken.get(&written.to_lowercase());
                taken.is_none_or(|taken| taken == path)
            })
        };
        let mut base = "meshes".to_owned();
        while !is_free(&base) {
            self.groups += 1;
            base = format!("meshes/{}", self.groups + 1);
        }
        base
    }

    fn push(
        &mut self,
        gate: &Gate,
        source: PathBuf,
        path: String,
        bytes: Arc<[u8]>,
    ) -> Result<usize, ImportFault> {
        let index = self.files.len();
        self.taken.insert(path.to_lowercase(), source.clone());
        self.known.insert(source, index);
        self.files.push(Asset { path, bytes }, gate.account())?;
        Ok(index)
    }
}

fn find(gate: &Gate, uri: &str, folder: &Path) -> Result<FoundMesh, ImportFault> {
    gate.account().charge(LOOKED_AT * (uri.len() + folder.as_os_str().len()))?;
    Ok(gate.find_from(uri, folder).map_err(|why| Unreachable::of(uri, why))?)
}

fn whole(inspected: Inspected, file: &Path) -> Result<Whole, String> {
    let Inspected { bytes, side_files, scene, .. } = inspected;
    scene?;
    let shared = |bytes: Arc<Vec<u8>>| -> Arc<[u8]> { Arc::unwrap_or_clone(bytes).into() };
    let sides = side_files.into_iter().filter(|(path, _)| path != file);
    let sides = sides.map(|(path, side)| (path, shared(side.bytes))).collect();
    Ok(Whole { bytes: shared(bytes.unwrap_or_default()), sides, parts: OnceCell::new() })
}

/// The middle of a mesh in a format that keeps its vertices in one file.
fn middle_of(bytes: &[u8], file: &Path) -> Result<Option<Vector3<f64>>, String> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let scene = urdd_geometry::read::read(bytes, &name, &mut |_| None);
    let bounds = scene.map_err(|error| error.to_string())?.merged().bounds();
    Ok(bounds.map(|bounds| (Vector3::from(bounds.min) + Vector3::from(bounds.max)) / 2.0))
}

/// The path of a part of a file, which is beside it.
fn of_part(file: &Path, part: &str, is_taken: impl Fn(&Path) -> bool) -> PathBuf {
    let plain = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '_') { c } else { '_' };
    let [stem, extension] = [file.file_stem(), file.extension()]
        .map(|name| name.unwrap_or_default().to_string_lossy().into_owned());
    let part: String = part.chars().map(plain).collect();
    let path = |end: &str| file.with_file_name(format!("{stem}.{part}{end}.{extension}"));
    let mut free = path("");
    for number in 2.. {
        if !is_taken(&free) {
            break;
        }
        free = path(&format!("_{number}"));
    }
    free
}

/// The folder that all files are in.
fn common<'p>(paths: impl Iterator<Item = &'p Path>) -> PathBuf {
    let mut common: Option<Vec<Component>> = None;
    for path in paths {
        let folder: Vec<Component> = path.parent().unwrap_or(Path::new("/")).components().collect();
        common = Some(match common {
            None => folder,
            Some(common) => {
                let same = common.iter().zip(&folder).take_while(|(left, right)| left == right);
                common[..same.count()].to_vec()
            }
        });
    }
    common.unwrap_or_default().iter().collect()
}

/// The path of a file below the URDF, with forward slashes. The first of a group is named by the URDF alone, so that its
/// name can be one for every file system. The first names the others, which keep their names.
fn written(base: &str, top: &Path, path: &Path, is_first: bool) -> String {
    let below = path.strip_prefix(top).unwrap_or(path).components();
    let parts = below.filter_map(|part| match part {
        Component::Normal(name) => Some(name.to_string_lossy().into_owned()),
        _ => None,
    });
    let mut parts: Vec<String> = [base.to_owned()].into_iter().chain(parts).collect();
    if let Some(name) = parts.last_mut().filter(|_| is_first) {
        let (stem, ending) = name.split_at(name.rfind('.').unwrap_or(name.len()));
        *name = file_name(stem, ending);
    }
    parts.join("/")
}

/// A mesh of which parts are wanted.
#[derive(Debug)]
pub struct Parts {
    text: String,
    /// Of COLLADA; none of OBJ.
    scene: Option<Scene>,
}

/// What a COLLADA file places, and its geometries.
#[derive(Debug)]
struct Scene {
    placed: Vec<Placed>,
    /// By their ids.
    geometries: Vec<(String, Range<usize>)>,
}

#[derive(Debug)]
struct Placed {
    node: String,
    /// What is placed, `#ID`.
    url: String,
    is_geometry: bool,
    range: Range<usize>,
}

impl Parts {
    /// Of a mesh; `None` if its format has no names.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let text = std::str::from_utf8(bytes).ok()?.trim_start_matches('\u{feff}');
        if !text.trim_start().starts_with('<') {
            // A line may go on behind a backslash.
            let text = text.replace("\\\r\n", " ").replace("\\\n", " ");
            return Some(Parts { text, scene: None });
        }
        let scene = Some(scene(text)?);
        Some(Parts { text: text.to_owned(), scene })
    }

    /// What passing it once costs.
    pub fn cost(&self) -> usize {
        self.text.len()
    }

    /// The mesh with one part alone, and without what only others need; `None` if it has none of this name.
    pub fn part(&self, name: &str) -> Option<Vec<u8>> {
        let part = match &self.scene {
            Some(scene) => of_collada(&self.text, scene, name),
            None => of_obj(&self.text, name),
        };
        part.map(String::into_bytes)
    }
}

fn scene(text: &str) -> Option<Scene> {
    let document = parse(text, Kind::Other).ok()?;
    let (mut placed, mut geometries) = (Vec::new(), Vec::new());
    let of = |node: Node, key: &str| node.attribute(key).unwrap_or_default().to_owned();
    for node in document.descendants().filter(Node::is_element) {
        let range = node.range();
        match (node.tag_name().name(), node.parent()) {
            ("geometry", _) => geometries.push((of(node, "id"), range)),
            (kind @ ("instance_geometry" | "instance_controller"), Some(parent)) => {
                let name = parent.attribute("name").or(parent.attribute("id"));
                placed.push(Placed {
                    node: name.unwrap_or_default().to_owned(),
                    url: of(node, "url"),
                    is_geometry: kind == "instance_geometry",
                    range,
                });
            }
            _ => {}
        }
    }
    Some(Scene { placed, geometries })
}

fn of_collada(text: &str, scene: &Scene, name: &str) -> Option<String> {
    let (kept, others): (Vec<_>, Vec<_>) = scene.placed.iter().partition(|of| of.node == name);
    let needed: HashSet<&str> = kept.iter().map(|of| of.url.trim_start_matches('#')).collect();
    // A controller names its geometry itself.
    let has_controllers = kept.iter().any(|of| !of.is_geometry);
    let is_needed = |id: &str| has_controllers || needed.contains(id);
    let geometries = scene.geometries.iter().filter(|(id, _)| !is_needed(id));
    let left_out = others.iter().map(|of| &of.range).chain(geometries.map(|(_, range)| range));
    let edits = left_out.map(|range| Edit { range: range.clone(), text: String::new() });
    (!kept.is_empty()).then(|| apply(text, edits.collect()))
}

/// The words for what a corner of a face names, in their order in it.
const POINTS: [&str; 3] = ["v", "vt", "vn"];

/// The faces of an object or group, with their points and materials.
fn of_obj(text: &str, name: &str) -> Option<String> {
    let mut points: [Vec<&str>; 3] = Default::default();
    // The new number of each point that is used, by its old one.
    let mut used: [BTreeMap<usize, usize>; 3] = Default::default();
    let (mut head, mut faces) = (String::new(), Vec::new());
    let (mut is_inside, mut material) = (false, "");
    for line in text.lines() {
        let line = line.trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match word {
            "o" | "g" => is_inside = rest.trim() == name,
            "usemtl" => material = line,
            "mtllib" => head = head + line + "\n",
            "f" if is_inside => {
                let corners: Option<Vec<[Option<usize>; 3]>> =
                    rest.split_whitespace().map(|corner| of_corner(corner, &points)).collect();
                let corners = corners?;
                for (place, index) in corners.iter().flat_map(|of| of.iter().enumerate()) {
                    index.map(|index| used[place].insert(index, 0));
                }
                faces.push((material, corners));
            }
            _ => {
                if let Some(place) = POINTS.iter().position(|point| *point == word) {
                    points[place].push(line);
                }
            }
        }
    }
    if faces.is_empty() {
        return None;
    }
    let mut part = format!("{head}o {name}\n");
    for (used, points) in used.iter_mut().zip(&points) {
        for (number, (index, new)) in used.iter_mut().enumerate() {
            *new = number + 1;
            part = part + points.get(*index)? + "\n";
        }
    }
    let mut last = "";
    for (material, corners) in faces {
        if material != last {
            part = part + material + "\n";
            last = material;
        }
        part.push('f');
        for corner in corners {
            let new = |place: usize| {
                corner[place].and_then(|index| used[place].get(&index)).map(usize::to_string)
            };
            let corner = [0, 1, 2].map(|place| new(place).unwrap_or_default()).join("/");
            part = part + " " + corner.trim_end_matches('/');
        }
        part.push('\n');
    }
    Some(part)
}

/// The points of a corner, from 0; `None` if a number is none of a point so far.
fn of_corner(corner: &str, points: &[Vec<&str>; 3]) -> Option<[Option<usize>; 3]> {
    let mut found = [None; 3];
    for (place, text) in corner.split('/').enumerate().filter(|(_, text)| !text.is_empty()) {
        let number: i64 = text.parse().ok()?;
        let count = points.get(place)?.len();
        let index = match number {
            1.. => usize::try_from(number).ok()?.checked_sub(1)?,
            _ => count.checked_sub(usize::try_from(number.unsigned_abs()).ok()?)?,
        };
        *found.get_mut(place)? = Some(index);
    }
    Some(found)
}
