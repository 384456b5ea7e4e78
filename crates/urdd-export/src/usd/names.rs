//! Names of prims: letters, digits and `_` of ASCII, no digit first, which every version of USD takes. Prims in one place
//! have different names.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::prim::Prim;
use crate::pairs::ascending;
use crate::{Subject, Taken};

/// The paths of a robot's prims.
pub(super) struct Paths {
    /// The name of the default prim, which holds all others.
    pub root: String,
    pub links: Vec<String>,
    pub joints: Vec<String>,
    /// The names of what holds joints, and materials.
    pub scopes: [String; 2],
    /// What the joint to the world is called.
    pub world: String,
    /// The names beside joints that are taken.
    pub taken_joints: Taken,
    /// Names that are written in another way.
    pub mended: Vec<String>,
}

impl Paths {
    pub fn new(subject: &Subject) -> Self {
        let mut mended = Vec::new();
        let root = mend(&subject.urdf.name);
        if root != subject.urdf.name {
            mended.push(subject.urdf.name.clone());
        }
        let mut taken = Taken::default();
        if subject.layout.is_frame.contains(&true) {
            // Frames are beside what holds the shapes of their body.
            for holder in [COLLISIONS, VISUALS, VISUAL_PRIMITIVES] {
                taken.insert(holder);
            }
        }
        let links = names(&subject.links, &mut taken, &mut mended);
        let path = |(link, name): (usize, &String)| match subject.tree.parent_link[link] {
            Some(body) if subject.is_frame(link) => format!("/{root}/{}/{name}", links[body]),
            _ => format!("/{root}/{name}"),
        };
        let scopes = ["Joints", "Looks"].map(|scope| taken.free(scope.to_owned()));
        let mut taken = Taken::default();
        let joints = names(&subject.names.joints, &mut taken, &mut mended);
        let world = taken.free("world_fixed".to_owned());
        Paths {
            links: links.iter().enumerate().map(path).collect(),
            joints: joints.iter().map(|joint| format!("/{root}/{}/{joint}", scopes[0])).collect(),
            root,
            scopes,
            world,
            taken_joints: taken,
            mended,
        }
    }
}

/// What holds the shapes of a link.
pub(super) const COLLISIONS: &str = "collisions";

/// What holds the visual geometry of a link.
pub(super) const VISUALS: &str = "visuals";
/// What holds the primitives of visual geometry of a link.
pub(super) const VISUAL_PRIMITIVES: &str = "visual_primitives";

/// The path of a shape of a link.
pub(super) fn path_of_shape(link: &str, piece: usize) -> String {
    format!("{link}/{COLLISIONS}/piece_{piece}")
}

/// The names of the prims of joints.
pub(crate) fn names_of_joints(joints: &[String]) -> Vec<String> {
    names(joints, &mut Taken::default(), &mut Vec::new())
}

/// The names of prims in one place, in order. A name that USD can have stays, so that another one with the same mended
/// name gets a number.
fn names(wanted: &[String], taken: &mut Taken, mended: &mut Vec<String>) -> Vec<String> {
    let is_kept = |name: &&String| mend(name) == **name;
    let kept: HashMap<&String, String> =
        wanted.iter().filter(is_kept).map(|name| (name, taken.free(name.clone()))).collect();
    let name = |name: &String| {
        kept.get(name).cloned().unwrap_or_else(|| {
            mended.push(name.clone());
            taken.free(mend(name))
        })
    };
    wanted.iter().map(name).collect()
}

/// The nearest name that a prim can have.
pub fn mend(name: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut mended: String = name.chars().map(kept).collect();
    if mended.is_empty() || mended.starts_with(|c: char| c.is_ascii_digit()) {
        mended.insert(0, '_');
    }
    mended
}

/// Pairs that need no collision check: of two bodies, or, where a person keeps pairs of which the URDD checks some pieces,
/// of two of their shapes. MuJoCo, by which Newton simulates, has 32 bits for pairs of shapes, which do not suffice for
/// most robots; pairs of bodies it leaves out exactly.
///
/// The two bodies of a joint are not checked unless the joint says so: a joint whose links the URDD checks does.
#[derive(Default)]
pub(super) struct Filters {
    /// For the path of a link or a shape, those that it is not checked with.
    targets: BTreeMap<String, Vec<String>>,
    /// The joints whose links are checked with each other, at least in part.
    pub checked: HashSet<usize>,
}

impl Filters {
    pub fn new(subject: &Subject, paths: &Paths) -> Self {
        let mut filters = Filters::default();
        let joints = &subject.tree.joint_links;
        let joint = |links: [usize; 2]| {
            joints.iter().position(|&(parent, child)| ascending(parent, child) == links)
        };
        for pair in &subject.pairs {
            let joint = joint(pair.links);
            let [a, b] = pair.links.map(|link| &paths.links[link]);
            if pair.disabled {
                if joint.is_none() {
                    filters.add(a.clone(), b.clone());
                }
                continue;
            }
            filters.checked.extend(joint);
            for [one, other] in pair.mixed.iter().flat_map(|mixed| &mixed.skipped) {
                filters.add(path_of_shape(a, *one), path_of_shape(b, *other));
            }
        }
        filters
    }

    /// Says on the prim of a path what it is not checked with.
    pub fn apply(&self, path: &str, prim: &mut Prim) {
        if let Some(targets) = self.targets.get(path) {
            prim.apply("PhysicsFilteredPairsAPI");
            prim.relate("physics:filteredPairs", targets);
        }
    }

    fn add(&mut self, from: String, to: String) {
        self.targets.entry(from).or_default().push(to);
    }
}
