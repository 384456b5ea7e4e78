//! What `urdd info` says of modules of a URDD: the shapes of links, the self-collision model, spheres, loops and parts.

use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::path::Path;

use serde::Serialize;

use urdd_document::robot::Robot;
use urdd_document::urdd::Urdd;
use urdd_format::composition::{CompositionBase, CompositionPart};
use urdd_format::escape::line as safe;
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_format::meshes::GeometryKind;
use urdd_format::rate::Rate;
use urdd_format::readable::counted;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::self_collision_model::ModelEvaluation;
use urdd_validate::{ModelVerdict, verify_model};

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GeometryInfo {
    /// Number of links whose shapes are those of their visual elements.
    pub visual: usize,
    /// Number of links whose shapes are those of their collision elements.
    pub collision: usize,
    /// Number of links with collision elements, whatever was taken; null if the URDF's module cannot be read.
    pub with_collision: Option<usize>,
}

impl GeometryInfo {
    pub fn of(urdd: &Urdd) -> Option<Self> {
        let Some(ModuleDocument::PlainMeshes(plain)) = urdd.document(ModuleKind::PlainMeshes)
        else {
            return None;
        };
        let count = |kind| {
            let meshes = plain.link_meshes.iter().flatten();
            meshes.filter(|mesh| mesh.geometry == kind).count()
        };
        let links = urdd.robot().map(|robot| robot.links.iter());
        Some(Self {
            visual: count(GeometryKind::Visual),
            collision: count(GeometryKind::Collision),
            with_collision: links
                .map(|links| links.filter(|link| !link.collision.is_empty()).count()),
        })
    }

    pub fn write(&self, out: &mut impl Write) -> fmt::Result {
        let Self { visual, collision, with_collision } = self;
        let what = match visual + collision {
            0 => "no link has shapes: nothing can collide".to_owned(),
            _ => format!("visual elements of {visual} links, collision elements of {collision}"),
        };
        let none = match with_collision {
            Some(0) if *visual > 0 => "; no link has a collision element",
            _ => "",
        };
        writeln!(out, "  shapes    {what}{none}")
    }
}

/// The rates of a self-collision model, as its module states them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelInfo {
    /// Share of collisions that it misses.
    pub miss_rate: Rate,
    /// Share of collisions near contact that it misses.
    pub near_contact_miss_rate: Rate,
    /// Share of free configurations that it clears.
    pub clear_rate: Rate,
    /// Whether a recount gives these rates; null if they were not verified.
    pub verified: Option<bool>,
    /// Why the rates are wrong or were not verified.
    pub reasons: Vec<String>,
}

impl ModelInfo {
    /// Verifies the stated rates with a recount.
    pub fn new(evaluation: &ModelEvaluation, path: &Path) -> Self {
        let (verified, reasons) = match verify_model(path) {
            ModelVerdict::Verified => (Some(true), Vec::new()),
            ModelVerdict::Refuted(codes) => {
                let reasons = codes.iter().map(|code| format!("{code} found a fault"));
                (Some(false), reasons.collect())
            }
            ModelVerdict::NotVerified(reasons) => (None, reasons),
        };
        Self {
            miss_rate: evaluation.miss_rate(),
            near_contact_miss_rate: evaluation.near_contact_miss_rate(),
            clear_rate: evaluation.clear_rate(),
            verified,
            reasons,
        }
    }

    pub fn write(&self, out: &mut impl Write) -> fmt::Result {
        let verdict = match self.verified {
            Some(true) => "verified",
            Some(false) => "NOT TRUE",
            None => "not verified",
        };
        let reasons = match self.reasons.is_empty() {
            true => String::new(),
            false => format!(": {}", safe(&self.reasons.join(", "))),
        };
        let Self { miss_rate, near_contact_miss_rate: near, clear_rate, .. } = self;
        let margin = "            ";
        writeln!(out, "  model     rates {verdict}{reasons} (95 % intervals in brackets)")?;
        writeln!(out, "{margin}misses {miss_rate} collisions")?;
        writeln!(
            out,
            "{margin}misses {near} collisions within a step of 0.05 rad or m of contact"
        )?;
        writeln!(out, "{margin}clears {clear_rate} free configurations")
    }
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelInfo {
    pub spheres: usize,
    /// Whether they hold all pieces of the links.
    pub covers: bool,
    pub origin: SphereOrigin,
    /// Of collisions, those that the level misses; of free configurations, those in which it touches.
    pub miss_rate: Rate,
    pub false_contact_rate: Rate,
}

impl LevelInfo {
    /// Those of a URDD, from coarse to fine; none without a usable `link_shapes_spheres_module`.
    pub fn all(urdd: &Urdd) -> Vec<Self> {
        match urdd.document(ModuleKind::LinkShapesSpheres) {
            Some(ModuleDocument::LinkShapesSpheres(module)) => {
                module.levels.iter().map(LevelInfo::of).collect()
            }
            _ => Vec::new(),
        }
    }

    fn of(level: &SphereLevel) -> Self {
        LevelInfo {
            spheres: level.spheres.iter().map(Vec::len).sum(),
            covers: level.covers,
            origin: level.origin,
            miss_rate: level.evaluation.miss_rate(),
            false_contact_rate: level.evaluation.false_contact_rate(),
        }
    }
}

/// A line for the levels that cover, and one for each other.
pub fn write_spheres(levels: &[LevelInfo], out: &mut impl Write) -> fmt::Result {
    let covering: Vec<String> =
        levels.iter().filter(|level| level.covers).map(|level| level.spheres.to_string()).collect();
    if !covering.is_empty() {
        writeln!(out, "  spheres   levels of {} that cover the links", covering.join(", "))?;
    }
    for level in levels.iter().filter(|level| !level.covers) {
        let origin = match level.origin {
            SphereOrigin::Computed => "fitted",
            SphereOrigin::Given => "given",
        };
        let (missed, wrong) = (level.miss_rate, level.false_contact_rate);
        let count = level.spheres;
        writeln!(
            out,
            "  spheres   {count} {origin}; missed collisions {missed}; false contacts {wrong}"
        )?;
    }
    Ok(())
}

/// Maximum number of DOFs that are named.
const MOST_NAMED: usize = 8;

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopsInfo {
    /// Number of loops of each kind.
    pub kinds: BTreeMap<&'static str, usize>,
    /// Number of equations between DOFs.
    pub couplings: usize,
    pub independent: Vec<String>,
}

impl LoopsInfo {
    /// That of a URDD; `None` without a usable `loops_module`.
    pub fn of(urdd: &Urdd) -> Option<Self> {
        let Some(ModuleDocument::Loops(module)) = urdd.document(ModuleKind::Loops) else {
            return None;
        };
        let mut kinds = BTreeMap::new();
        for one in &module.loops {
            *kinds.entry(one.kind.as_str()).or_default() += 1;
        }
        let names: Vec<&str> = match urdd.document(ModuleKind::Dof) {
            Some(ModuleDocument::Dof(dof)) => dof.dofs.iter().map(|dof| &*dof.name).collect(),
            _ => Vec::new(),
        };
        let independent = module.independent_dof_idxs.iter().map(|idx| {
            names.get(idx.get()).map_or_else(|| idx.get().to_string(), |name| (*name).to_owned())
        });
        let independent = independent.collect();
        Some(LoopsInfo { kinds, couplings: module.couplings.len(), independent })
    }

    pub fn write(&self, out: &mut impl Write) -> fmt::Result {
        let mut parts: Vec<String> =
            self.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        if self.couplings > 0 {
            parts.push(counted(self.couplings, "coupling"));
        }
        let parts = if parts.is_empty() { "none".to_owned() } else { parts.join(", ") };
        let free = self.independent.len();
        let named: Vec<String> =
            self.independent.iter().take(MOST_NAMED).map(|name| safe(name).to_string()).collect();
        let more = if free > MOST_NAMED { " and others" } else { "" };
        let named = if free == 0 { String::new() } else { format!(": {}{more}", named.join(", ")) };
        let (dofs, moves) = (counted(free, "DOF"), if free == 1 { "moves" } else { "move" });
        writeln!(out, "  loops     {parts}; {dofs} {moves} freely{named}")
    }
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartInfo {
    pub id: String,
    /// Name of the robot that it was made from.
    pub robot: String,
    pub prefix: String,
    pub links: usize,
    /// Number of its links that were dropped.
    pub dropped_links: usize,
    /// Number of its joints that were made fixed.
    pub frozen_joints: usize,
    /// Id of the part that carries it; null if the base or nothing does.
    pub on_part: Option<String>,
    /// Name of the link that carries it, if known.
    pub on_link: Option<String>,
    /// Name of the joint that attaches it, if known.
    pub by_joint: Option<String>,
    /// Type of that joint, if known.
    pub joint_type: Option<String>,
    pub carries: Vec<PartInfo>,
    /// The parts that it was itself composed of.
    pub parts: Vec<PartInfo>,
}

/// The parts of a composition that no other part carries, each with the parts attached to it. `robot` is the robot that
/// the indices refer to, if available.
pub fn part_tree(parts: &[CompositionPart], robot: Option<&Robot>) -> Vec<PartInfo> {
    let on = |part: &CompositionPart| Some(part.attachment.as_ref()?.part_idx?.get());
    let tops = (0..parts.len()).filter(|idx| on(&parts[*idx]).is_none());
    tops.map(|idx| part(parts, idx, robot, parts.len())).collect()
}

/// `depth` bounds the recursion for invalid documents, in which a part can be attached to itself.
fn part(parts: &[CompositionPart], idx: usize, robot: Option<&Robot>, depth: usize) -> PartInfo {
    let of = &parts[idx];
    let attachment = of.attachment.as_ref();
    let carrier = attachment.and_then(|attachment| parts.get(attachment.part_idx?.get()));
    let link = attachment.and_then(|attachment| {
        let idx = attachment.link_idx;
        let known = || robot?.links.get(idx.get()).map(|link| link.name.clone());
        let of_part = || {
            let carrier = carrier?;
            let link = carrier.links.iter().find(|link| link.link_idx == idx)?;
            Some(format!("{}{}", carrier.prefix, link.name))
        };
        known().or_else(of_part)
    });
    let joint = attachment.and_then(|of| robot?.joints.get(of.joint_idx.get()));
    let hangs_here = |other: &usize| {
        let attachment = parts[*other].attachment.as_ref();
        let on = attachment.and_then(|attachment| attachment.part_idx);
        depth > 0 && on.is_some_and(|on| on.get() == idx)
    };
    PartInfo {
        id: of.id.clone(),
        robot: of.name.clone(),
        prefix: of.prefix.clone(),
        links: of.links.len(),
        dropped_links: of.dropped_links.len(),
        frozen_joints: of.frozen_joints.len(),
        on_part: carrier.map(|carrier| carrier.id.clone()),
        on_link: link,
        by_joint: joint.map(|joint| joint.name.clone()),
        joint_type: joint.map(|joint| joint.joint_type.to_string()),
        carries: (0..parts.len())
            .filter(hangs_here)
            .map(|other| part(parts, other, robot, depth.saturating_sub(1)))
            .collect(),
        parts: (of.composition.as_ref())
            .map_or_else(Vec::new, |nested| part_tree(&nested.parts, None)),
    }
}

pub fn base(base: Option<&CompositionBase>, robot: Option<&Robot>) -> Option<String> {
    let link = robot?.links.get(base?.link_idx.get())?;
    Some(link.name.clone())
}

pub fn write_parts(parts: &[PartInfo], margin: &str, out: &mut impl Write) -> fmt::Result {
    for part in parts {
        write!(out, "{margin}{}", safe(&part.id))?;
        write!(out, "  (robot {}, {} links", safe(&part.robot), part.links)?;
        let counts = [(part.dropped_links, "dropped"), (part.frozen_joints, "joints frozen")];
        for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
            write!(out, ", {count} {what}")?;
        }
        out.write_str(")")?;
        if let Some(link) = &part.on_link {
            write!(out, "  on {}", safe(link))?;
        }
        if let (Some(joint), Some(kind)) = (&part.by_joint, &part.joint_type) {
            write!(out, "  by {} ({})", safe(joint), safe(kind))?;
        }
        out.write_char('\n')?;
        if !part.parts.is_empty() {
            writeln!(out, "{margin}  is put together of")?;
            write_parts(&part.parts, &format!("{margin}    "), out)?;
        }
        write_parts(&part.carries, &format!("{margin}  "), out)?;
    }
    Ok(())
}
