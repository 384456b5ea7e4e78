//! The tree of bodies, with frames and replicas written out, and what is in it by name.

use std::collections::HashMap;

use nalgebra::{Isometry3, Translation3, Vector3};
use urdd_directory::account::{Account, Charged};

use super::compiler::{Compilers, euler, pose};
use super::geom::{Geom, between};
use super::joint;
use super::reading::{Attributes, Defaults, Element, MAIN, PASSED, View, required, unknown, wrong};
use crate::fault::MjcfFault;
use crate::features::{self, Tally};
use crate::model::{Body, Closing, Coupled, Joint, JointKind, LETTER};
use crate::place::{Fallible, Place, Placing, at};

/// What an element costs beside what the model has of it, bytes.
const RAW: usize = 2000;

/// The world is the first body.
pub const WORLD: usize = 0;

#[derive(Default)]
pub struct RawBody<'d> {
    pub name: Option<String>,
    pub parent: Option<usize>,
    pub pose: Isometry3<f64>,
    /// Its `pos`, without the frame that it is in.
    pub written_position: Vector3<f64>,
    pub inertial: Option<View<'d>>,
    /// How many it has: the last counts.
    pub inertials: usize,
    /// A name is empty where there is none.
    pub joints: Vec<Joint>,
    pub geoms: Vec<Geom<'d>>,
    pub frames: Vec<RawFrame>,
    pub is_mocap: bool,
    pub place: Place,
}

/// A site or a camera.
pub struct RawFrame {
    pub name: Option<String>,
    /// `site` or `camera`.
    pub kind: &'static str,
    pub pose: Isometry3<f64>,
    pub place: Place,
}

pub struct Bodies<'d> {
    /// The world first, each parent before its children.
    pub all: Vec<RawBody<'d>>,
    /// What is put behind the names in replicas, by name.
    pub suffixes: HashMap<String, Vec<String>>,
    /// Whether there are bodies that are not read, so that positions cannot be counted.
    pub is_partial: bool,
}

pub fn bodies<'d>(
    root: &'d Element,
    defaults: &'d Defaults<'d>,
    compilers: &'d Compilers,
    tally: &mut Tally,
    account: &Account,
) -> Fallible<Bodies<'d>> {
    let bodies =
        Bodies { all: vec![RawBody::default()], suffixes: HashMap::new(), is_partial: false };
    let mut builder = Builder { bodies, defaults, compilers, tally, account };
    let suffix = String::new();
    for section in root.all("worldbody") {
        builder.bodies.all[WORLD].place = section.place;
        let scope =
            Scope { body: WORLD, frame: Isometry3::identity(), class: MAIN, suffix: &suffix };
        builder.children(section, scope)?;
    }
    Ok(builder.bodies)
}

struct Builder<'d, 't> {
    bodies: Bodies<'d>,
    defaults: &'d Defaults<'d>,
    compilers: &'d Compilers,
    tally: &'t mut Tally,
    account: &'t Account,
}

/// Where elements are.
#[derive(Clone, Copy)]
struct Scope<'s> {
    body: usize,
    /// The frame around them, in the body's.
    frame: Isometry3<f64>,
    class: usize,
    /// What is put behind their names.
    suffix: &'s str,
}

impl<'d> Builder<'d, '_> {
    fn children(&mut self, parent: &'d Element, scope: Scope<'_>) -> Fallible<()> {
        for element in &parent.children {
            self.charge(element, scope)?;
            let is_world = scope.body == WORLD;
            match element.tag.as_str() {
                "body" => self.body(element, scope)?,
                "frame" => self.frame(element, scope)?,
                "replicate" => self.replicate(element, scope)?,
                "inertial" | "joint" | "freejoint" if is_world => {
                    return Err(at(element.place, MjcfFault::InWorld(element.tag.clone())));
                }
                "inertial" => {
                    let view = View::new(element, self.defaults, scope.class)?;
                    self.bodies.all[scope.body].inertial = Some(view);
                    self.bodies.all[scope.body].inertials += 1;
                }
                "joint" | "freejoint" => self.joint(element, scope)?,
                "geom" => {
                    let name = self.name(element, scope);
                    let view = View::new(element, self.defaults, scope.class)?;
                    let geom =
                        Geom::read(view, name, &scope.frame, self.compilers.at(element.place))?;
                    self.bodies.all[scope.body].geoms.push(geom);
                }
                "site" => self.site(element, "site", scope)?,
                "camera" => self.site(element, "camera", scope)?,
                "composite" | "flexcomp" => {
                    self.tally.count(features::SOFT);
                    self.bodies.is_partial = true;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Charges an element, each time that it is replicated, with its name and other texts.
    fn charge(&self, element: &Element, scope: Scope<'_>) -> Fallible<()> {
        let name = element.text("name").map_or(0, str::len) + scope.suffix.len();
        let bytes = RAW + LETTER * name + PASSED * element.length();
        self.account.charge(bytes).at(element.place)
    }

    fn name(&mut self, element: &Element, scope: Scope<'_>) -> Option<String> {
        let name = element.text("name")?;
        if !scope.suffix.is_empty() {
            let suffixes = self.bodies.suffixes.entry(name.to_owned()).or_default();
            suffixes.push(scope.suffix.to_owned());
        }
        Some(format!("{name}{}", scope.suffix))
    }

    fn body(&mut self, element: &'d Element, scope: Scope<'_>) -> Fallible<()> {
        let view = View::new(element, self.defaults, scope.class)?;
        let own = pose(view, self.compilers.at(element.place))?;
        let class = self.defaults.scope(element, scope.class)?;
        let body = RawBody {
            name: self.name(element, scope),
            parent: Some(scope.body),
            pose: scope.frame * own,
            written_position: own.translation.vector,
            is_mocap: view.flag("mocap")?.unwrap_or(false),
            place: element.place,
            ..RawBody::default()
        };
        let inner =
            Scope { body: self.bodies.all.len(), frame: Isometry3::identity(), class, ..scope };
        self.bodies.all.push(body);
        self.children(element, inner)?;
        self.check_joints(inner.body)
    }

    /// What MuJoCo does not simulate.
    fn check_joints(&self, body: usize) -> Fallible<()> {
        let RawBody { joints, parent, place, .. } = &self.bodies.all[body];
        let kinds: Vec<JointKind> = joints.iter().map(|joint| joint.kind).collect();
        let is_free = kinds.contains(&JointKind::Floating);
        let ball = kinds.iter().position(|kind| *kind == JointKind::Ball);
        let turns_after =
            ball.is_some_and(|ball| kinds[ball + 1..].iter().any(|kind| *kind != JointKind::Slide));
        let freedoms: usize =
            kinds.iter().map(|kind| 1 + 2 * usize::from(*kind == JointKind::Ball)).sum();
        if is_free && (kinds.len() > 1 || *parent != Some(WORLD)) || turns_after || freedoms > 6 {
            return Err(at(*place, MjcfFault::Joints));
        }
        Ok(())
    }

    fn frame(&mut self, element: &'d Element, scope: Scope<'_>) -> Fallible<()> {
        let view = View::new(element, self.defaults, scope.class)?;
        let frame = scope.frame * pose(view, self.compilers.at(element.place))?;
        let class = self.defaults.scope(element, scope.class)?;
        self.children(element, Scope { frame, class, ..scope })
    }

    fn replicate(&mut self, element: &'d Element, scope: Scope<'_>) -> Fallible<()> {
        required(element, "count")?;
        let count = element.integer("count")?.unwrap_or_default();
        if count < 1 {
            return Err(wrong(element, "count", "a number of replicas"));
        }
        let offset = Vector3::from(element.numbers::<3>("offset")?.unwrap_or_default());
        let angles = element.numbers::<3>("euler")?.unwrap_or_default();
        let separator = element.get("sep").unwrap_or_default();
        let class = self.defaults.scope(element, scope.class)?;
        let width = count.to_string().len();
        let mut position = Vector3::zeros();
        for number in 0..count {
            self.charge(element, scope)?;
            #[expect(clippy::cast_precision_loss, reason = "as many as can be charged")]
            let turn =
                euler(angles.map(|angle| angle * number as f64), self.compilers.at(element.place));
            let at = Isometry3::from_parts(Translation3::from(position), turn);
            position += turn * offset;
            let suffix = format!("{separator}{number:0width$}{}", scope.suffix);
            let frame = scope.frame * at;
            self.children(element, Scope { frame, class, suffix: &suffix, ..scope })?;
        }
        Ok(())
    }

    fn joint(&mut self, element: &'d Element, scope: Scope<'_>) -> Fallible<()> {
        let name = self.name(element, scope).unwrap_or_default();
        let joint = match element.tag.as_str() {
            "freejoint" => joint::free(element, name),
            _ => {
                let view = View::new(element, self.defaults, scope.class)?;
                let compiler = self.compilers.at(element.place);
                joint::read(view, name, &scope.frame, compiler, self.tally)?
            }
        };
        self.bodies.all[scope.body].joints.push(joint);
        Ok(())
    }

    fn site(&mut self, element: &'d Element, kind: &'static str, scope: Scope<'_>) -> Fallible<()> {
        let view = View::new(element, self.defaults, scope.class)?;
        let pose = match between(view)? {
            Some((pose, _)) => pose,
            None => pose(view, self.compilers.at(element.place))?,
        };
        let frame = RawFrame {
            name: self.name(element, scope),
            kind,
            pose: scope.frame * pose,
            place: element.place,
        };
        self.bodies.all[scope.body].frames.push(frame);
        Ok(())
    }
}

/// The bodies of the robot, and what each raw one became.
#[derive(Default)]
pub struct Made {
    pub bodies: Charged<Body>,
    /// Whether the first one moves freely.
    pub is_floating: bool,
    /// The index of a raw body's body.
    pub index: HashMap<usize, usize>,
    /// The body and joint of each raw body's joints.
    pub joints: HashMap<(usize, usize), (usize, usize)>,
    /// The body and joint that each follower follows.
    pub leaders: HashMap<(usize, usize), (usize, usize)>,
    /// What closes its chains, and equations that no mimic can say.
    pub closings: Charged<Closing>,
    pub couplings: Charged<Coupled>,
}

/// Bodies, joints and shapes by name.
pub struct Lookup<'b> {
    bodies: HashMap<&'b str, usize>,
    /// By body and place in it.
    joints: HashMap<&'b str, (usize, usize)>,
    geoms: HashMap<&'b str, (usize, usize)>,
    suffixes: &'b HashMap<String, Vec<String>>,
    account: &'b Account,
}

/// What an element costs for each replica of what it names, beside the names.
const REPLICA: usize = 200;

impl<'b> Lookup<'b> {
    pub fn of(bodies: &'b Bodies<'_>, account: &'b Account) -> Self {
        let mut lookup = Lookup {
            bodies: HashMap::from([("world", super::body::WORLD)]),
            joints: HashMap::new(),
            geoms: HashMap::new(),
            suffixes: &bodies.suffixes,
            account,
        };
        for (index, body) in bodies.all.iter().enumerate() {
            lookup.bodies.extend(body.name.as_deref().map(|name| (name, index)));
            let joints = body.joints.iter().enumerate().filter(|(_, of)| !of.name.is_empty());
            lookup.joints.extend(joints.map(|(at, of)| (of.name.as_str(), (index, at))));
            let geoms = body.geoms.iter().enumerate();
            lookup
                .geoms
                .extend(geoms.filter_map(|(at, of)| Some((of.name.as_deref()?, (index, at)))));
        }
        lookup
    }

    /// What is put behind the names that an element says, once for each replica of what it names.
    pub fn replicas(&self, element: &Element, names: &[Option<&str>]) -> Fallible<&'b [String]> {
        const ITSELF: &[String] = &[String::new()];
        let is_known = |name: &str| {
            self.joints.contains_key(name)
                || self.bodies.contains_key(name)
                || self.geoms.contains_key(name)
        };
        let mut replicated = names.iter().flatten().filter(|name| !is_known(name));
        let suffixes = replicated.find_map(|name| self.suffixes.get(*name));
        let suffixes = suffixes.map_or(ITSELF, Vec::as_slice);
        let each = REPLICA + names.iter().flatten().map(|name| name.len()).sum::<usize>();
        self.account.charge(suffixes.len().saturating_mul(each)).at(element.place)?;
        Ok(suffixes)
    }

    pub fn account(&self) -> &Account {
        self.account
    }

    pub fn charge(&self, element: &Element, work: usize) -> Fallible<()> {
        self.account.charge(work).at(element.place)
    }

    pub fn joint(&self, element: &Element, name: &str, suffix: &str) -> Fallible<(usize, usize)> {
        found(&self.joints, element, "joint", name, suffix)
    }

    pub fn body(&self, element: &Element, name: &str, suffix: &str) -> Fallible<usize> {
        found(&self.bodies, element, "body", name, suffix)
    }

    pub fn geom(&self, element: &Element, name: &str, suffix: &str) -> Fallible<(usize, usize)> {
        found(&self.geoms, element, "geom", name, suffix)
    }
}

fn found<T: Copy>(
    named: &HashMap<&str, T>,
    element: &Element,
    what: &'static str,
    name: &str,
    suffix: &str,
) -> Fallible<T> {
    let replica = match suffix {
        "" => None,
        suffix => named.get(format!("{name}{suffix}").as_str()),
    };
    replica.or_else(|| named.get(name)).copied().ok_or_else(|| unknown(element, what, name))
}
