//! URDDs from before version 1: as a part, and the recipe of a combined one, as far as it is recorded.
//!
//! The URDF of one names meshes in packages that do not exist here; its `original_meshes_module` contains the meshes of visual
//! elements. If one is missing, the link's plain mesh replaces it.

use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::{Component, Path};

use serde::de::DeserializeOwned;

use super::error::{CombineError, Note, PartFault};
use super::names::mesh_edits;
use super::recipe::{Attachment, BASE, Frozen, JointLimit, Part, Recipe, Sources, Word};
use super::sources::document;
use urdd_directory::file_type::FileType;
use urdd_directory::root::Root;
use urdd_format::legacy::composition::{
    Action, AddChain, AdjustedRobotModule, AttachedRobot, AttachmentPoint, CombinedRobotModule,
    CreatorModule,
};
use urdd_format::legacy::meshes::PlainMeshesModule;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Geometry, Link, Mesh};
use urdd_kinematics::rotation::{canonical, to_rpy};
use urdd_source::{MAX_SOURCE_BYTES, named, read_urdf};
use urdd_xml::element::{Edit, apply, attribute, children};
use urdd_xml::{Document, Kind, parse};

pub(super) struct Carried {
    pub file: String,
    pub found: Vec<u8>,
    /// Its text, with mesh names that refer to the URDD's files, relative to its folder.
    pub text: Vec<u8>,
    /// Links that use their plain mesh because the original is missing.
    pub plain_meshes: Vec<String>,
}

/// Reads the URDF of the legacy URDD in `folder`. Opens nothing outside that folder.
pub(super) fn read(folder: &Path) -> Result<Carried, PartFault> {
    let file = urdf_in(folder).ok_or_else(PartFault::no_urdf)?;
    let root = Root::open_folder(folder).map_err(|e| PartFault::unreadable(&file, e))?;
    let found = root.read(&file, MAX_SOURCE_BYTES).map_err(|e| PartFault::unreadable(&file, e))?;
    let robot = read_urdf(&found, "robot").map_err(|e| PartFault::unreadable(&file, e))?;
    let text = String::from_utf8(robot.carried).map_err(|e| PartFault::unreadable(&file, e))?;
    let links = &robot.robot.links;
    let is_there = |place: &str| root.open_file(place).is_ok();
    let mut places = BTreeMap::new();
    let visual = named(&robot.robot).into_iter();
    for mesh in visual.filter(|mesh| mesh.geometry == GeometryKind::Visual) {
        let name = last_component(mesh.filename.trim());
        let place = format!("{}/meshes/{name}", ModuleKind::OriginalMeshes.folder());
        if !name.is_empty() && is_there(&place) {
            places.insert(mesh.filename.to_owned(), place);
        }
    }
    let document = parse(&text, Kind::Robot)
        .map_err(|error| PartFault::unreadable(&file, error.words(&text)))?;
    let mut edits = mesh_edits(&document, &places);
    let mut plain = plain_meshes(&root);
    plain.retain(|idx, place| {
        let mesh = links.get(*idx).and_then(only_mesh);
        mesh.is_some_and(|mesh| !places.contains_key(&mesh.filename)) && is_there(place)
    });
    edits.extend(plain_edits(&document, &plain));
    Ok(Carried {
        text: apply(&text, edits).into_bytes(),
        plain_meshes: plain.keys().map(|idx| links[*idx].name.clone()).collect(),
        found,
        file,
    })
}

/// The file name of the only URDF in the folder of a legacy URDD.
fn urdf_in(folder: &Path) -> Option<String> {
    let entries = fs::read_dir(folder).ok()?;
    let files = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut urdfs = files.filter(|file| FileType::Urdf.is_of(Path::new(file)));
    let first = urdfs.next()?;
    urdfs.next().is_none().then_some(first)
}

fn last_component(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or_default()
}

/// The mesh of a link with only one visual element and no scale: the converter ignored scales.
fn only_mesh(link: &Link) -> Option<&Mesh> {
    let [visual] = link.visual.as_slice() else { return None };
    match &visual.geometry {
        Some(Geometry::Mesh(mesh)) if mesh.scale.is_none_or(|scale| scale == [1.0; 3]) => {
            Some(mesh)
        }
        _ => None,
    }
}

/// The plain mesh of each link, in the link's frame. Links whose plain meshes share a file name are left out: the
/// converter overwrote one with the other.
fn plain_meshes(root: &Root) -> BTreeMap<usize, String> {
    let folder = ModuleKind::PlainMeshes.folder();
    let module = document(root, &format!("{folder}/module.json"));
    let paths = module.map_or_else(
        |_| Vec::new(),
        |(module, _): (PlainMeshesModule, _)| module.stl_link_mesh_relative_paths,
    );
    let named = paths
        .iter()
        .enumerate()
        .filter_map(|(idx, path)| Some((idx, last_component(path.as_ref()?))));
    let mut links_of: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (idx, name) in named {
        links_of.entry(name).or_default().push(idx);
    }
    let own = links_of.into_iter().filter(|(_, links)| links.len() == 1);
    own.map(|(name, links)| (links[0], format!("{folder}/meshes/stl/{name}"))).collect()
}

/// The edits that make links use their plain meshes, in which the origins are already applied.
fn plain_edits(document: &Document, plain: &BTreeMap<usize, String>) -> Vec<Edit> {
    let links = children(document.root_element()).filter(|(tag, _)| *tag == "link");
    let mut edits = Vec::new();
    for (idx, (_, link)) in links.enumerate() {
        let Some(place) = plain.get(&idx) else { continue };
        let visuals = children(link).filter(|(tag, _)| *tag == "visual");
        for (tag, element) in visuals.flat_map(|(_, visual)| children(visual)) {
            if tag == "origin" {
                let (range, text) = (element.range(), String::new());
                edits.push(Edit { range, text });
            }
            let meshes = children(element).filter(|(tag, _)| *tag == "mesh");
            for found in meshes.filter_map(|(_, mesh)| attribute(mesh, "filename")) {
                let (range, text) = (found.range_value(), crate::combine::names::escaped(place));
                edits.push(Edit { range, text });
            }
        }
    }
    edits
}

const WORLD: &str = "combined_robot_world";

impl Recipe {
    /// The recipe of a combined, adjusted or created published URDD in `folder`, whose parts are in sibling folders.
    ///
    /// # Errors
    /// If it is none of these, or contains nothing that a recipe can express.
    pub fn of_legacy(folder: &Path) -> Result<(Recipe, Vec<Note>), CombineError> {
        let shown = folder.display().to_string();
        let refused = |fault: PartFault| CombineError::Part {
            id: String::new(),
            source_path: shown.clone(),
            fault,
        };
        let root = Root::open(folder).map_err(|e| refused(PartFault::unreadable("", e)))?;
        let whole = folder.canonicalize().map_err(|e| refused(PartFault::unreadable("", e)))?;
        let beside = whole.parent().unwrap_or(Path::new("/"));
        let mut reader = LegacyReader {
            notes: Vec::new(),
            recipe: Recipe {
                shown: shown.clone(),
                text: String::new(),
                name: Word::default(),
                base: None,
                parts: Vec::new(),
                sources: Sources::In(beside.to_owned()),
            },
            ids: HashSet::new(),
            beside,
        };
        if let Some(module) = module_of(&root, ModuleKind::CombinedRobot).map_err(refused)? {
            reader.combined(&module);
        } else if let Some(module) = module_of(&root, ModuleKind::AdjustedRobot).map_err(refused)? {
            reader.adjusted(&module);
        } else if let Some(module) = module_of(&root, ModuleKind::Creator).map_err(refused)? {
            reader.created(&module);
        } else {
            let fault = "this URDD has no combined_robot_module, adjusted_robot_module or creator_module, which describe how it was combined";
            return Err(refused(PartFault::unusable(fault)));
        }
        let LegacyReader { recipe, notes, .. } = reader;
        if recipe.parts.is_empty() {
            let left_out: Vec<String> = notes.iter().map(ToString::to_string).collect();
            let left_out = left_out.join("; ");
            let fault = format!("a recipe cannot express how it was combined: {left_out}");
            return Err(refused(PartFault::unusable(fault)));
        }
        if let Some(part) = recipe.parts.iter().find(|part| !is_folder_name(&part.source, beside)) {
            let fault = "a legacy module names a part by a folder beside its own, but this is not the name of a folder: correct it, or write a recipe";
            return Err(part.refused(PartFault::unusable(fault)));
        }
        recipe.check()?;
        Ok((recipe, notes))
    }
}

/// Whether a source is a folder directly in `beside`, or does not exist; not a file, which could be a program.
fn is_folder_name(source: &Path, beside: &Path) -> bool {
    let name = source.strip_prefix(beside);
    let mut parts = name.iter().flat_map(|name| name.components());
    let is_name = matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None));
    is_name && !source.is_file()
}

fn module_of<T: DeserializeOwned>(root: &Root, kind: ModuleKind) -> Result<Option<T>, PartFault> {
    let path = format!("{}/module.json", kind.folder());
    if root.open_file(&path).is_err() {
        return Ok(None);
    }
    document(root, &path).map(|(module, _)| Some(module))
}

struct LegacyReader<'a> {
    recipe: Recipe,
    notes: Vec<Note>,
    /// The ids of the parts in lower case.
    ids: HashSet<String>,
    beside: &'a Path,
}

impl LegacyReader<'_> {
    /// Notes content that a recipe cannot express, or that it needs and lacks.
    fn note(&mut self, text: String) {
        self.notes.push(Note { kind: "not-said", part: None, text });
    }

    fn part(&mut self, robot: &str, prefix: String, attach: Option<Attachment>) -> &mut Part {
        let mut id =
            robot.replace(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '-', "_");
        while !self.ids.insert(id.to_ascii_lowercase()) {
            id += &format!("_{}", self.recipe.parts.len());
        }
        let part = Part::new(id, self.beside.join(robot), prefix, attach);
        self.recipe.parts.push(part);
        let last = self.recipe.parts.len() - 1;
        &mut self.recipe.parts[last]
    }

    /// Attaches the next part to the link `world`, which the first of them adds as `[base]`.
    fn on_world(&mut self, world: &str, joint: Attachment) -> Option<Attachment> {
        if self.recipe.base.is_some() {
            return Some(Attachment { to: Word::new(format!("{BASE}/{world}")), ..joint });
        }
        self.recipe.base = Some(Attachment { to: Word::new(world), ..joint });
        None
    }

    fn combined(&mut self, module: &CombinedRobotModule) {
        self.recipe.name = Word::new(&module.name);
        for (idx, robot) in module.attached_robots.iter().enumerate() {
            let joint = self.joint(idx, robot);
            let name = &robot.robot_name;
            let attach = match &robot.attachment_point {
                AttachmentPoint::World => self.on_world(WORLD, joint),
                AttachmentPoint::Link(link) => {
                    let Some(holder) = self.recipe.parts.get(link.robot_idx.get()) else {
                        self.note(format!(
                            "robot {idx}, `{name}`, is attached to a robot that does not exist; it is left out"
                        ));
                        continue;
                    };
                    let to = Word::new(format!("{}/{}", holder.id.text, link.link_name));
                    Some(Attachment { to, ..joint })
                }
            };
            self.part(name, format!("robot_{idx}_"), attach);
        }
    }

    /// The joint of an attached robot, still without a link above it.
    fn joint(&mut self, idx: usize, robot: &AttachedRobot) -> Attachment {
        let joint_type = robot.joint_type.as_str().to_ascii_lowercase();
        let moves = joint_type != "fixed";
        let axis = robot.axis.xyz;
        if moves && axis == [0.0; 3] {
            self.note(format!("the axis of the joint of robot {idx} is 0 0 0; 1 0 0 is used"));
        }
        if moves && (robot.dynamics.is_some() || robot.safety_controller.is_some()) {
            self.note(format!("dynamics and soft limits of the joint of robot {idx} are left out"));
        }
        let is_limited = matches!(joint_type.as_str(), "revolute" | "prismatic");
        let limit = &robot.limit;
        let unless_zero = |value: f64| (value != 0.0).then_some(value);
        Attachment {
            to: Word::default(),
            name: Word::new(format!("connection_joint_robot_{idx}")),
            joint: Word::new(joint_type),
            xyz: robot.origin.xyz,
            rpy: robot.origin.rpy,
            axis: (moves && axis != [0.0; 3]).then_some(axis),
            limit: is_limited.then(|| JointLimit {
                lower: Some(limit.lower),
                upper: Some(limit.upper),
                effort: unless_zero(limit.effort),
                velocity: unless_zero(limit.velocity),
            }),
        }
    }

    fn adjusted(&mut self, module: &AdjustedRobotModule) {
        self.recipe.name = Word::new(&module.name);
        let part = self.part(&module.base_robot_name, String::new(), None);
        part.drop = module.dead_end_link_names.iter().map(Word::new).collect();
        let fixed = module.fixed_base_joints.iter();
        part.freeze =
            fixed.map(|(joint, at)| (Word::new(joint), Frozen::Each(at.clone()))).collect();
    }

    fn created(&mut self, module: &CreatorModule) {
        self.recipe.name = Word::new(&module.name);
        for (idx, action) in module.actions.iter().enumerate() {
            match action {
                Action::AddAlreadyExistingChain(chain)
                | Action::AddAlreadyExistingEnvironment(chain) => self.chain(idx, chain),
                other => {
                    let kind = serde_json::to_value(other)
                        .ok()
                        .and_then(|value| Some(value.as_object()?.keys().next()?.clone()))
                        .unwrap_or_default();
                    self.note(format!(
                        "action {idx}, {kind}, creates or changes links, which a recipe cannot do"
                    ));
                }
            }
        }
    }

    fn chain(&mut self, idx: usize, chain: &AddChain) {
        if chain.scale != [1.0; 3] {
            self.note(format!(
                "action {idx} scales `{}`, which a recipe cannot do; its size is unchanged",
                chain.name
            ));
        }
        let [x, y, z, w] = chain.base_offset.rotation;
        let rotation = nalgebra::Quaternion::new(w, x, y, z);
        let rotation = nalgebra::UnitQuaternion::try_new(rotation, 0.0);
        let rotation = rotation.map(|rotation| canonical(&rotation)).unwrap_or_default();
        let rpy = to_rpy(rotation.to_rotation_matrix().matrix());
        let pose = [chain.base_offset.translation, rpy];
        let joint = Attachment::fixed(String::new(), format!("connection_joint_{idx}"), pose);
        let attach = self.on_world("world", joint);
        self.part(&chain.name, String::new(), attach);
    }
}
