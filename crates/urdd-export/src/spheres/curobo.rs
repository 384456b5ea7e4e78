//! cuRobo: the spheres of each link, and the other entries by link of its robot file. The keys are those of
//! `robot_cfg: kinematics:`. cuRobo also reads `collision_spheres` from a separate file. With
//! [`Choices::robot_file`](crate::Choices::robot_file), the whole robot file.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use nalgebra::Point3;

use super::{Model, said};
use crate::yaml::entries;
use crate::{Export, ExportError, Note, Setup, Subject, Taken, Yaml};
use urdd_format::named_configurations::NamedConfiguration;
use urdd_spheres::model::Sphere;
use urdd_xml::number::number;

const BUFFERS: &str = "Buffers are added to radii: `collision_sphere_buffer` for obstacles, `self_collision_buffer` of a link for self-collision. What is measured holds for 0.";

const SEVERAL: &str =
    "it has several DOFs, which cuRobo does not support; what it moves stays where it is";

/// cuRobo's own limits where nothing else is known: rad/s² and rad/s³, m/s² and m/s³.
const ACCELERATION: f64 = 15.0;
const JERK: f64 = 500.0;

pub(crate) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let model = Model::new(subject)?;
    let mut lines = subject.origin()?;
    lines.extend(model.said(&subject.links, subject.options.chosen.cover));
    lines.push(BUFFERS.to_owned());
    let mut notes: Vec<Note> = said::note(&model, subject).into_iter().collect();
    let spheres = by_link(subject, &model);
    let tree = match &subject.options.chosen.robot_file {
        None => Yaml::Map(spheres),
        Some(urdf) => {
            let setup = subject.setup(&mut notes)?;
            let arm = Arm::new(subject, &setup, &mut notes)?;
            notes.extend(arm.contact(subject, &model)?);
            lines.extend(arm.said(subject));
            let mut kinematics = arm.kinematics(subject, urdf);
            kinematics.extend(spheres);
            kinematics.push(("cspace".to_owned(), arm.cspace(subject, &setup)));
            let robot = [("kinematics", Yaml::Map(kinematics))];
            Yaml::map([("robot_cfg", Yaml::map(robot))])
        }
    };
    let text = tree.document(&lines);
    Ok(Export::of(text, Vec::new(), notes))
}

/// What is known by link.
fn by_link(subject: &Subject, model: &Model) -> Vec<(String, Yaml)> {
    let name = |link: usize| subject.links.get(link).map_or("", String::as_str);
    let mut ignored: BTreeMap<usize, Vec<&str>> = BTreeMap::new();
    for [a, b] in &model.ignored {
        ignored.entry(*a).or_default().push(name(*b));
    }
    let links = || model.links.iter().map(|(link, _)| name(*link));
    let sphere = |sphere: &Sphere| {
        Yaml::map([
            ("center", Yaml::numbers(&sphere.centre)),
            ("radius", Yaml::number(sphere.radius)),
        ])
    };
    let spheres = model
        .links
        .iter()
        .map(|(link, spheres)| (name(*link), Yaml::List(spheres.iter().map(sphere).collect())));
    let ignored = ignored.into_iter().map(|(link, others)| (name(link), Yaml::texts(others)));
    let buffers = links().map(|link| (link, Yaml::number(0.0)));
    entries([
        ("collision_link_names", Yaml::texts(links())),
        ("collision_spheres", Yaml::named(spheres)),
        ("collision_sphere_buffer", Yaml::number(0.0)),
        ("self_collision_ignore", Yaml::named(ignored)),
        ("self_collision_buffer", Yaml::named(buffers)),
    ])
}

/// What cuRobo plans for.
struct Arm {
    base: usize,
    ee: usize,
    /// The joints that move, in joint order.
    active: Vec<usize>,
    /// The others, with their positions.
    locked: BTreeMap<usize, f64>,
    retract: Vec<f64>,
    /// All DOFs in the retract configuration.
    configuration: Vec<f64>,
    /// Where the retract configuration comes from.
    retract_of: String,
}

impl Arm {
    fn new(subject: &Subject, setup: &Setup, notes: &mut Vec<Note>) -> Result<Self, ExportError> {
        let space = subject.robot.configurations()?;
        let named = subject.robot.named_configurations()?;
        let chosen = setup.curobo.retract.as_deref();
        let of = |name: &str| {
            let found =
                named.iter().find(|named: &&NamedConfiguration| named.name.as_str() == name);
            found.map(|named| named.configuration.clone())
        };
        let (mut configuration, retract_of) = match chosen.and_then(|name| Some((of(name)?, name)))
        {
            Some((configuration, name)) => {
                (configuration, format!("the named configuration `{name}`"))
            }
            None => (space.zero(), "the default configuration".to_owned()),
        };
        let dofs = subject.dofs()?;
        for (joint, position) in &setup.curobo.locked {
            if let Some(dof) = dofs[*joint] {
                configuration[dof] = *position;
            }
        }
        let position = |joint: usize| dofs[joint].map_or(0.0, |dof| configuration[dof]);
        let root = subject.tree.root;
        let ee = setup.curobo.ee_link.or_else(|| setup.tools.value.first().copied());
        let ee = ee.unwrap_or_else(|| subject.tree.order.last().copied().unwrap_or(root));
        let on_way: BTreeSet<usize> = subject.between(root, ee).into_iter().collect();
        // What joints on the way follow moves with them.
        let follows =
            |joint: &usize| subject.mimics.by_joint[*joint].as_ref().map(|mimic| mimic.driver);
        let moved: BTreeSet<usize> =
            on_way.iter().map(|joint| follows(joint).unwrap_or(*joint)).collect();
        let mut arm = Arm {
            base: root,
            ee,
            active: Vec::new(),
            locked: setup.curobo.locked.clone(),
            retract: Vec::new(),
            configuration: configuration.clone(),
            retract_of,
        };
        for (joint, of) in subject.view.joints.iter().enumerate() {
            if of.num_dofs() > 1 {
                notes.push(Note::joint(&of.name, SEVERAL));
            }
            if !subject.is_driven(joint) || arm.locked.contains_key(&joint) {
                continue;
            }
            // Without chosen locks, what does not move the end effector is locked.
            let is_free = subject.locked_at(joint).is_none();
            if is_free
                && (moved.contains(&joint) || (moved.is_empty() && setup.curobo.ee_link.is_none()))
            {
                arm.active.push(joint);
                arm.retract.push(position(joint));
            } else {
                arm.locked.insert(joint, position(joint));
            }
        }
        Ok(arm)
    }

    /// The deepest contact of spheres in the retract configuration, if there is one.
    fn contact(&self, subject: &Subject, model: &Model) -> Result<Option<Note>, ExportError> {
        let poses = subject.robot.link_poses(&self.configuration)?;
        let of_link = |(link, spheres): &(usize, Vec<Sphere>)| {
            let (link, pose) = (*link, poses[*link]);
            let place = |sphere: &Sphere| (link, pose * Point3::from(sphere.centre), sphere.radius);
            spheres.iter().map(place).collect::<Vec<_>>()
        };
        let placed: Vec<(usize, Point3<f64>, f64)> = model.links.iter().flat_map(of_link).collect();
        let ignored: HashSet<[usize; 2]> = model.ignored.iter().copied().collect();
        let mut deepest: Option<(f64, [usize; 2])> = None;
        for (place, (b, q, s)) in placed.iter().enumerate() {
            for (a, p, r) in &placed[..place] {
                let depth = r + s - (p - q).norm();
                let is_checked = a != b && !ignored.contains(&[*a, *b]);
                if is_checked && depth > deepest.map_or(0.0, |(depth, _)| depth) {
                    deepest = Some((depth, [*a, *b]));
                }
            }
        }
        Ok(deepest.map(|(depth, links)| Note::Retract {
            links: links.map(|link| subject.links[link].clone()),
            millimetres: number((depth * 1e4).ceil() / 10.0),
        }))
    }

    fn said(&self, subject: &Subject) -> Vec<String> {
        let joint = |(joint, position): (&usize, &f64)| {
            format!("`{}` at {}", subject.view.joints[*joint].name, number(*position))
        };
        let mut said = vec![format!(
            "Retract configuration: {}. Limits of velocity and position are the URDF's.",
            self.retract_of
        )];
        if !self.locked.is_empty() {
            let locked: Vec<String> = self.locked.iter().map(joint).collect();
            said.push(format!(
                "Locked, since they do not move `{}`, have equal limits or were chosen: {}.",
                subject.links[self.ee],
                locked.join(", ")
            ));
        }
        said
    }

    fn kinematics(&self, subject: &Subject, urdf: &str) -> Vec<(String, Yaml)> {
        let null = || Yaml::plain("null");
        let [mut links, mut joints] = [&subject.links, &subject.names.joints].map(Taken::new);
        let object = links.free("attached_object".to_owned());
        let attach = joints.free("attach_joint".to_owned());
        let joint = |joint: &usize| subject.view.joints[*joint].name.as_str();
        let locked = self.locked.iter().map(|(of, at)| (joint(of), Yaml::number(*at)));
        let attached = Yaml::map([
            ("parent_link_name", Yaml::text(&subject.links[self.ee])),
            ("link_name", Yaml::text(&object)),
            ("fixed_transform", Yaml::numbers(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])),
            ("joint_type", Yaml::text("FIXED")),
            ("joint_name", Yaml::text(&attach)),
        ]);
        entries([
            ("usd_path", null()),
            ("usd_robot_root", null()),
            ("isaac_usd_path", null()),
            ("usd_flip_joints", Yaml::EMPTY),
            ("usd_flip_joint_limits", Yaml::List(Vec::new())),
            ("urdf_path", Yaml::text(urdf)),
            ("asset_root_path", Yaml::text("")),
            ("base_link", Yaml::text(&subject.links[self.base])),
            ("ee_link", Yaml::text(&subject.links[self.ee])),
            ("link_names", null()),
            ("lock_joints", if self.locked.is_empty() { null() } else { Yaml::named(locked) }),
            ("extra_links", Yaml::named([(object.as_str(), attached)])),
            ("extra_collision_spheres", Yaml::named([(object.as_str(), Yaml::plain("4"))])),
            ("use_global_cumul", Yaml::plain("true")),
            ("mesh_link_names", null()),
        ])
    }

    fn cspace(&self, subject: &Subject, setup: &Setup) -> Yaml {
        let joints = self.active.iter().map(|joint| &subject.view.joints[*joint]);
        let ones = || Yaml::numbers(&vec![1.0; self.active.len()]);
        // cuRobo has one limit for all joints, or one for each.
        let each = |of: &dyn Fn(usize) -> Option<f64>, default: f64| {
            let values = self.active.iter().map(|joint| of(*joint).unwrap_or(default));
            if self.active.iter().any(|joint| of(*joint).is_some()) {
                Yaml::numbers(&values.collect::<Vec<_>>())
            } else {
                Yaml::number(default)
            }
        };
        let limit = |joint: usize| subject.urdf.joints[joint].limit.as_ref();
        Yaml::map([
            ("joint_names", Yaml::texts(joints.map(|joint| joint.name.as_str()))),
            ("retract_config", Yaml::numbers(&self.retract)),
            ("null_space_weight", ones()),
            ("cspace_distance_weight", ones()),
            ("max_jerk", each(&|joint| limit(joint)?.jerk, setup.jerk.unwrap_or(JERK))),
            (
                "max_acceleration",
                each(
                    &|joint| limit(joint)?.acceleration,
                    setup.acceleration.unwrap_or(ACCELERATION),
                ),
            ),
        ])
    }
}
