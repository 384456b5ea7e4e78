//! Converts the composition of a published URDD from before version 1 to a recipe, as far as it is recorded.

use std::collections::HashSet;
use std::path::{Component, Path};

use serde::de::DeserializeOwned;

use super::document::parsed;
use super::error::{CombineError, PartFault};
use super::note::Note;
use super::recipe::{Attachment, BASE, Base, JointDescription, Part, Recipe, Sources, Word};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_format::legacy::adjusted_robot::AdjustedRobotModule;
use urdd_format::legacy::combined_robot::{AttachedRobot, AttachmentPoint, CombinedRobotModule};
use urdd_format::legacy::creator::{Action, AddChain, CreatorModule};
use urdd_format::legacy::urdf;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{JointType, Limit};
use urdd_kinematics::rotation::{canonical, to_rpy};

/// The name of the world link in the published robots.
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
        let whole = folder.canonicalize();
        let whole = whole.map_err(|e| refused(PartFault::unreadable("", e)))?;
        let beside = whole.parent().unwrap_or(Path::new("/")).to_owned();
        let mut reader = Reader {
            notes: Vec::new(),
            recipe: Recipe {
                shown: shown.clone(),
                name: Word::default(),
                base: None,
                parts: Vec::new(),
                sources: Sources::In(beside.clone()),
            },
            ids: HashSet::new(),
            beside: &beside,
        };
        if let Some(module) = read(&root, ModuleKind::CombinedRobot).map_err(refused)? {
            reader.combined(&module);
        } else if let Some(module) = read(&root, ModuleKind::AdjustedRobot).map_err(refused)? {
            reader.adjusted(&module);
        } else if let Some(module) = read(&root, ModuleKind::Creator).map_err(refused)? {
            reader.created(&module);
        } else {
            return Err(refused(PartFault::NotComposed));
        }
        if reader.recipe.parts.is_empty() {
            let said = reader.notes.iter().map(ToString::to_string);
            return Err(refused(PartFault::SaysNothing(said.collect())));
        }
        for part in &reader.recipe.parts {
            if !is_folder_name(&part.source, &beside) {
                return Err(part.refused(PartFault::NotBeside));
            }
        }
        reader.recipe.check()?;
        Ok((reader.recipe, reader.notes))
    }
}

/// Whether a source is a folder directly in `beside`, or does not exist; not a file, which could be a program.
fn is_folder_name(source: &Path, beside: &Path) -> bool {
    let name = source.strip_prefix(beside);
    let mut parts = name.iter().flat_map(|name| name.components());
    let is_name = matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None));
    is_name && !source.is_file()
}

/// The corresponding type in version 1.
fn of_legacy(joint_type: urdf::JointType) -> JointType {
    let mut types = JointType::ALL.iter().copied();
    let same = types.find(|of| of.as_str() == joint_type.as_str());
    same.unwrap_or(JointType::Fixed)
}

/// The document of a module, if it is there.
fn read<T: DeserializeOwned>(root: &Root, kind: ModuleKind) -> Result<Option<T>, PartFault> {
    let path = format!("{}/module.json", kind.folder());
    match root.read(&path, MAX_DOCUMENT_BYTES) {
        Ok(bytes) => parsed(&bytes, &path).map(Some),
        Err(_) => Ok(None),
    }
}

struct Reader<'a> {
    recipe: Recipe,
    notes: Vec<Note>,
    /// The ids of the parts in lower case.
    ids: HashSet<String>,
    beside: &'a Path,
}

impl Reader<'_> {
    fn unsaid(&mut self, what: String) {
        self.notes.push(Note::not_said(what));
    }

    fn part(&mut self, robot: &str, prefix: String, attach: Option<Attachment>) -> &mut Part {
        let mut id =
            robot.replace(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '-', "_");
        while !self.ids.insert(id.to_ascii_lowercase()) {
            id += &format!("_{}", self.recipe.parts.len());
        }
        let part = Part::new(id, self.beside.join(robot), prefix);
        self.recipe.parts.push(Part { attach, ..part });
        let last = self.recipe.parts.len() - 1;
        &mut self.recipe.parts[last]
    }

    fn combined(&mut self, module: &CombinedRobotModule) {
        self.recipe.name = Word::new(&module.name);
        for (idx, robot) in module.attached_robots.iter().enumerate() {
            let joint = self.joint(idx, robot);
            let prefix = format!("robot_{idx}_");
            let attach = match &robot.attachment_point {
                AttachmentPoint::World if self.recipe.base.is_none() => {
                    let link = Word::new(WORLD);
                    self.recipe.base = Some(Base { link, joint });
                    None
                }
                AttachmentPoint::World => {
                    Some(Attachment { to: Word::new(format!("{BASE}/{WORLD}")), joint })
                }
                AttachmentPoint::Link(link) => {
                    let holder = self.recipe.parts.get(link.robot_idx.get());
                    let Some(holder) = holder.map(|part| part.id.text.clone()) else {
                        let name = &robot.robot_name;
                        self.unsaid(format!(
                            "robot {idx}, `{name}`, is attached to a robot that does not exist; it is left out"
                        ));
                        continue;
                    };
                    let to = Word::new(format!("{holder}/{}", link.link_name));
                    Some(Attachment { to, joint })
                }
            };
            self.part(&robot.robot_name, prefix, attach);
        }
    }

    fn joint(&mut self, idx: usize, robot: &AttachedRobot) -> JointDescription {
        let joint_type = of_legacy(robot.joint_type);
        let moves = joint_type != JointType::Fixed;
        let axis = robot.axis.xyz;
        if moves && axis == [0.0; 3] {
            self.unsaid(format!("the axis of the joint of robot {idx} is 0 0 0; 1 0 0 is used"));
        }
        if moves && (robot.dynamics.is_some() || robot.safety_controller.is_some()) {
            self.unsaid(format!(
                "dynamics and soft limits of the joint of robot {idx} are left out"
            ));
        }
        let is_limited = matches!(joint_type, JointType::Revolute | JointType::Prismatic);
        let limit = &robot.limit;
        JointDescription {
            name: Word::new(format!("connection_joint_robot_{idx}")),
            joint_type,
            xyz: robot.origin.xyz,
            rpy: robot.origin.rpy,
            axis: (moves && axis != [0.0; 3]).then_some(axis),
            limit: is_limited.then(|| Limit {
                lower: Some(limit.lower),
                upper: Some(limit.upper),
                effort: (limit.effort != 0.0).then_some(limit.effort),
                velocity: (limit.velocity != 0.0).then_some(limit.velocity),
                acceleration: None,
                deceleration: None,
                jerk: None,
            }),
        }
    }

    fn adjusted(&mut self, module: &AdjustedRobotModule) {
        self.recipe.name = Word::new(&module.name);
        let part = self.part(&module.base_robot_name, String::new(), None);
        part.drop = module.dead_end_link_names.iter().map(Word::new).collect();
        let fixed = module.fixed_base_joints.iter();
        part.freeze = fixed.map(|(joint, values)| (Word::new(joint), values.clone())).collect();
        // Sorted, as in a file.
        part.freeze.sort_by(|a, b| a.0.text.cmp(&b.0.text));
    }

    fn created(&mut self, module: &CreatorModule) {
        self.recipe.name = Word::new(&module.name);
        for (idx, action) in module.actions.iter().enumerate() {
            match action {
                Action::AddAlreadyExistingChain(chain)
                | Action::AddAlreadyExistingEnvironment(chain) => self.chain(idx, chain),
                other => {
                    let kind = serde_json::to_value(other).ok();
                    let kind =
                        kind.and_then(|value| Some(value.as_object()?.keys().next()?.clone()));
                    let kind = kind.unwrap_or_default();
                    self.unsaid(format!(
                        "action {idx}, {kind}, creates or changes links, which a recipe cannot do"
                    ));
                }
            }
        }
    }

    fn chain(&mut self, idx: usize, chain: &AddChain) {
        if chain.scale != [1.0; 3] {
            self.unsaid(format!(
                "action {idx} scales `{}`, which a recipe cannot do; its size is unchanged",
                chain.name
            ));
        }
        let [x, y, z, w] = chain.base_offset.rotation;
        let rotation = nalgebra::Quaternion::new(w, x, y, z);
        let rotation = nalgebra::UnitQuaternion::try_new(rotation, 0.0);
        let rotation = rotation.map(|rotation| canonical(&rotation)).unwrap_or_default();
        let rpy = to_rpy(rotation.to_rotation_matrix().matrix());
        let xyz = chain.base_offset.translation;
        let joint = JointDescription::fixed(format!("connection_joint_{idx}"), xyz, rpy);
        let link = Word::new("world");
        let attach = match self.recipe.base {
            Some(_) => Some(Attachment { to: Word::new(format!("{BASE}/world")), joint }),
            None => {
                self.recipe.base = Some(Base { link, joint });
                None
            }
        };
        self.part(&chain.name, String::new(), attach);
    }
}
