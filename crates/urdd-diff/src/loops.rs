//! Differences of what closes kinematic loops, of couplings between DOFs, and of which DOFs move freely: of the source of a
//! URDF, or of `loops_module`; links and DOFs are by name. Differences of the DOFs (which there are, their indices, and bounds
//! that do not follow from the joints), and of named configurations of them.

use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::{Isometry3, Translation3};
use urdd_directory::loops_toml::{File, FrameTable};
use urdd_format::diff_report::{DofDifference, PartDifference};
use urdd_format::index::Count;
use urdd_format::loops::{LoopKind, LoopsModule};
use urdd_format::pose::Pose;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_kinematics::pose::from_isometry;
use urdd_kinematics::rotation::from_rpy;

use crate::fields::{self, Fields, Parts, compare, matched};
use crate::side::{DofState, Side};

/// The part that lists the DOFs that move freely.
const INDEPENDENT: &str = "DOFs that move freely";
/// What a joint of URDF+ says of that.
pub const OF_JOINT: &str = "independent";

pub struct Both {
    parts: [Parts; 2],
    /// Whether both say which DOFs move freely, and mean the same by it: a URDF may leave it open or say too many, and a URDD
    /// has those of which the others follow.
    pub say_independent: bool,
    /// What the elements of URDF+ that say the same are called, such as `loop "pin"`.
    pub labels: HashSet<String>,
}

impl Both {
    pub fn of(before: &Side, after: &Side) -> Self {
        let mut parts = [before, after].map(of);
        let is_independent = |(name, _): &(String, Fields)| name == INDEPENDENT;
        let label = |(name, _): &(String, Fields)| {
            let (tag, own) = name.split_once(' ')?;
            Some(format!("{tag} \"{own}\""))
        };
        let elements = parts.iter().flatten().filter(|part| !is_independent(part));
        let labels = elements.filter_map(label).collect();
        let say = parts.iter().all(|parts| parts.iter().any(is_independent));
        let say_independent = say && before.urdd.is_some() == after.urdd.is_some();
        if !say_independent {
            for parts in &mut parts {
                parts.retain(|part| !is_independent(part));
            }
        }
        Both { parts, say_independent, labels }
    }

    pub fn differences(&self, tolerance: f64) -> Vec<PartDifference> {
        let [a, b] = &self.parts;
        fields::differences(a, b, tolerance)
    }
}

fn of(side: &Side) -> Parts {
    match &side.urdd {
        None => side.loops.as_ref().map_or_else(Vec::new, |file| of_file(file, side)),
        Some(urdd) => match urdd.document(ModuleKind::Loops) {
            Some(ModuleDocument::Loops(module)) => of_module(module, side),
            _ => Vec::new(),
        },
    }
}

fn of_module(module: &LoopsModule, side: &Side) -> Parts {
    let links = side.link_names();
    let link = |idx: usize| links.get(idx).copied();
    let dof =
        |idx: usize| side.dofs.get(idx).map_or_else(|| idx.to_string(), |dof| dof.name.clone());
    let mut parts: Parts = module
        .loops
        .iter()
        .map(|one| {
            let a = (link(one.link_a_idx.get()), &one.frame_a);
            let b = (link(one.link_b_idx.get()), &one.frame_b);
            (format!("loop {}", one.name), closed(one.kind, [a, b]))
        })
        .collect();
    parts.extend(module.couplings.iter().map(|one| {
        let terms = one.terms.iter().map(|term| (dof(term.dof_idx.get()), &term.coefficients[..]));
        (format!("coupling {}", one.name), coupling(one.constant, terms.collect()))
    }));
    let independent = module.independent_dof_idxs.iter().map(|idx| dof(idx.get()));
    parts.push((INDEPENDENT.to_owned(), named(independent)));
    parts
}

fn of_file(file: &File, side: &Side) -> Parts {
    // Extended URDF also names joints, and means their children.
    let joints = side.robot.joints.iter().rev();
    let mut links: HashMap<&str, &str> =
        joints.map(|joint| (&*joint.name, &*joint.child.link)).collect();
    links.extend(side.robot.links.iter().map(|link| (&*link.name, &*link.name)));
    let link = |name| links.get(name).copied().unwrap_or(name);
    let mut parts: Parts = file
        .loops
        .iter()
        .map(|one| {
            let one = one.get_ref();
            let a = (Some(link(one.link_a.get_ref())), &pose(&one.frame_a));
            let b = (Some(link(one.link_b.get_ref())), &pose(&one.frame_b));
            (format!("loop {}", one.name), closed(one.kind, [a, b]))
        })
        .collect();
    parts.extend(file.couplings.iter().map(|one| {
        let one = one.get_ref();
        let terms = one.terms.iter().map(|(name, terms)| (name.get_ref().to_string(), &terms[..]));
        (format!("coupling {}", one.name), coupling(one.constant, terms.collect()))
    }));
    let independent = file.independent.iter();
    parts.extend(independent.map(|names| {
        let names = names.iter().map(|name| name.get_ref().clone());
        (INDEPENDENT.to_owned(), named(names))
    }));
    parts
}

fn named(names: impl Iterator<Item = String>) -> Fields {
    let mut fields = Fields::default();
    for name in names {
        fields.text(name, Some("yes"));
    }
    fields.sorted()
}

/// As `loops_module` has it: the same numbers, whoever said them.
fn pose(frame: &FrameTable) -> Pose {
    from_isometry(&Isometry3::from_parts(Translation3::from(frame.xyz), from_rpy(frame.rpy)))
}

/// A loop, by the links of its ends and the frames in them.
fn closed(kind: LoopKind, ends: [(Option<&str>, &Pose); 2]) -> Fields {
    let mut fields = Fields::default();
    fields.text("kind", Some(kind.as_str()));
    for (end, (link, frame)) in ["a", "b"].into_iter().zip(ends) {
        fields.text(format!("link_{end}"), link);
        fields.numbers(format!("frame_{end}.position"), "m", Some(frame.position));
        let turn = Some(frame.quaternion_wxyz);
        fields.numbers(format!("frame_{end}.quaternion_wxyz"), "", turn);
    }
    fields
}

fn coupling(constant: f64, terms: BTreeMap<String, &[f64]>) -> Fields {
    let mut fields = Fields::default();
    fields.number("constant", "", Some(constant));
    for (name, coefficients) in terms {
        let mut four = [0.0; 4];
        for (to, from) in four.iter_mut().zip(coefficients) {
            *to = *from;
        }
        fields.numbers(name, "", Some(four));
    }
    fields
}

pub fn dofs(before: &Side, after: &Side, tolerance: f64) -> Vec<DofDifference> {
    let mut found = Vec::new();
    for part in matched(&names(before), &names(after)) {
        let mut changes = Vec::new();
        if let Some((i, j)) = part.both() {
            let (x, y) = (&before.dofs[i], &after.dofs[j]);
            // What follows from the joint is said at the joint.
            let departs = |dof: &DofState| dof.stated.key() != dof.derived.key();
            if departs(x) || departs(y) {
                changes = compare("", &x.stated, &y.stated, tolerance);
            }
            if i == j && changes.is_empty() {
                continue;
            }
        }
        found.push(DofDifference {
            name: part.name.to_owned(),
            presence: part.presence(),
            index_before: part.before.map(Count::saturating),
            index_after: part.after.map(Count::saturating),
            changes,
        });
    }
    found
}

fn names(side: &Side) -> Vec<&str> {
    side.dofs.iter().map(|dof| dof.name.as_str()).collect()
}

/// The named configurations that differ; `None` unless one is a URDD, and the other one too or imported.
pub fn configurations(before: &Side, after: &Side, tolerance: f64) -> Option<Vec<PartDifference>> {
    before.urdd.as_ref().or(after.urdd.as_ref())?;
    let (a, b) = (configurations_of(before)?, configurations_of(after)?);
    Some(fields::differences(&a, &b, tolerance))
}

/// The configurations of a URDD or an import by name, each with one value per DOF; none without the module.
fn configurations_of(side: &Side) -> Option<Parts> {
    let fields = |values: &mut dyn Iterator<Item = f64>| {
        let mut fields = Fields::default();
        for (dof, value) in side.dofs.iter().zip(values) {
            fields.number(&dof.name, dof.unit(), Some(value));
        }
        fields
    };
    let Some(urdd) = &side.urdd else {
        let named = side.beside.import.as_ref()?.configurations.iter().map(|named| {
            // DOFs that an import does not place are at 0, as in a URDD.
            let mut values = side.dofs.iter().map(|dof| {
                let placed = named.positions.iter().find(|at| at.dof_name == dof.name);
                placed.map_or(0.0, |at| at.position)
            });
            (named.name.to_string(), fields(&mut values))
        });
        return Some(named.collect());
    };
    let Some(ModuleDocument::NamedConfigurations(module)) =
        urdd.document(ModuleKind::NamedConfigurations)
    else {
        return Some(Vec::new());
    };
    let named = module.configurations.iter();
    let named = named
        .map(|named| (named.name.to_string(), fields(&mut named.configuration.iter().copied())));
    Some(named.collect())
}
