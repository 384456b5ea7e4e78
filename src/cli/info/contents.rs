//! The contents of a URDD, without validation.

use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::path::Path;

use serde::Serialize;

use super::modules::{
    GeometryInfo, LevelInfo, LoopsInfo, ModelInfo, PartInfo, base, part_tree, write_parts,
    write_spheres,
};
use super::sampled::{SkippedContact, Statics, write_skipped};
use urdd_directory::root::ReadError;
use urdd_document::urdd::Urdd;
use urdd_export::JointOrder;
use urdd_format::dof::Quantity;
use urdd_format::escape;
use urdd_format::registry::{ModuleDocument, ModuleKind};

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Info {
    /// Name of the URDD in reports.
    pub path: String,
    pub robot_name: Option<String>,
    /// Version of the specification that the root metadata states.
    pub urdd_version: Option<String>,
    pub conformance_class: Option<String>,
    pub urdf: Option<String>,
    pub links: Option<usize>,
    pub joints: BTreeMap<String, usize>,
    pub dofs: Vec<DofInfo>,
    /// Name of the base link of a composed robot: the link that carries parts and belongs to none.
    pub base: Option<String>,
    pub parts: Vec<PartInfo>,
    pub collision_model: Option<ModelInfo>,
    /// Which elements the shapes of links are made of; null without `plain_meshes_module`.
    pub geometry: Option<GeometryInfo>,
    /// Pairs of links that are skipped because they touch in the default configuration, or in the reference; null if the
    /// modules of shapes are missing or cannot be read.
    pub skipped_contacts: Option<Vec<SkippedContact>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loops: Option<LoopsInfo>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spheres: Vec<LevelInfo>,
    pub modules: Vec<ModuleInfo>,
    /// The joints in the order of each program, if it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<Vec<JointOrder>>,
    /// What holds the robot still against gravity, if it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statics: Option<Statics>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DofInfo {
    /// Its name; for legacy modules, the name of its joint.
    pub name: String,
    /// `rad` or `m`, if the module states it.
    pub unit: Option<&'static str>,
    pub bounds: Option<[f64; 2]>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModuleInfo {
    pub path: String,
    pub version: Option<String>,
    pub files: usize,
    /// Total size of its files, in bytes.
    pub bytes: u64,
    /// Why its document is unusable, if it is.
    pub unusable: Option<String>,
}

impl Info {
    /// Reads the URDD at `path`. `name` is its name in reports.
    pub fn read(path: &Path, name: &str) -> Result<Info, ReadError> {
        let urdd = Urdd::read(path)?;
        let robot = urdd.robot();
        let mut joints = BTreeMap::new();
        for joint in robot.iter().flat_map(|robot| &robot.joints) {
            *joints.entry(joint.joint_type.to_string()).or_insert(0) += 1;
        }
        let metadata = urdd.metadata();
        let composition = match urdd.document(ModuleKind::Composition) {
            Some(ModuleDocument::Composition(composition)) => Some(composition),
            _ => None,
        };
        let model = match urdd.document(ModuleKind::SelfCollisionModel) {
            Some(ModuleDocument::SelfCollisionModel(model)) => {
                Some(ModelInfo::new(&model.evaluation, path))
            }
            _ => None,
        };
        Ok(Info {
            path: name.to_owned(),
            robot_name: robot
                .map(|robot| robot.name.clone())
                .or_else(|| metadata.map(|m| m.robot_name.clone())),
            urdd_version: metadata.map(|metadata| metadata.urdd_version.to_string()),
            conformance_class: metadata.map(|metadata| metadata.conformance_class.to_string()),
            urdf: urdd.urdf().ok().map(|urdf| urdf.path.clone()),
            links: robot.map(|robot| robot.links.len()),
            joints,
            dofs: dofs(&urdd),
            base: composition.and_then(|of| base(of.base.as_ref(), robot)),
            parts: composition.map_or_else(Vec::new, |of| part_tree(&of.parts, robot)),
            collision_model: model,
            geometry: GeometryInfo::of(&urdd),
            // A URDD without skips is not opened again.
            skipped_contacts: (urdd.document(ModuleKind::LinkShapesSkips))
                .and_then(|_| SkippedContact::all(path)),
            loops: LoopsInfo::of(&urdd),
            spheres: LevelInfo::all(&urdd),
            modules: urdd
                .modules()
                .map(|module| {
                    let entries = || urdd.listing().below(&module.folder);
                    let is_file = |path: &str| urdd.listing().has_file(path);
                    ModuleInfo {
                        path: module.folder.clone(),
                        version: module.version.clone(),
                        files: entries().filter(|entry| is_file(&entry.path)).count(),
                        bytes: entries().map(|entry| entry.size).sum(),
                        unusable: module.unusable().map(|why| why.to_string()),
                    }
                })
                .collect(),
            order: None,
            statics: None,
        })
    }
}

fn dofs(urdd: &Urdd) -> Vec<DofInfo> {
    let Some(dofs) = urdd.dofs() else {
        return Vec::new();
    };
    let bounds = urdd.bounds();
    let name_of_joint = |dof: usize| {
        let joint = dofs.dof_idx_to_joint_idx_mapping.get(dof)?;
        Some(urdd.robot()?.joints.get(joint.get())?.name.clone())
    };
    (0..dofs.dof_idx_to_joint_idx_mapping.len())
        .map(|dof| {
            let description = dofs.dofs.get(dof);
            DofInfo {
                name: description
                    .map(|description| description.name.clone())
                    .or_else(|| name_of_joint(dof))
                    .unwrap_or_else(|| format!("DOF {dof}")),
                unit: description.map(|description| match description.quantity {
                    Quantity::Angle => "rad",
                    Quantity::Length => "m",
                }),
                bounds: bounds.and_then(|bounds| bounds.bounds.get(dof).copied()),
            }
        })
        .collect()
}

pub fn write(info: &Info, out: &mut impl Write) -> fmt::Result {
    let or = |text: &Option<String>, without: &str| safe(text.as_deref().unwrap_or(without));
    writeln!(out, "{}", safe(&info.path))?;
    writeln!(out, "  robot     {}", or(&info.robot_name, "not known"))?;
    match (&info.urdd_version, &info.conformance_class) {
        (Some(version), Some(class)) => {
            writeln!(out, "  format    URDD {}, class {class}", safe(version))?
        }
        _ => writeln!(out, "  format    no root metadata")?,
    }
    writeln!(out, "  source    {}", or(&info.urdf, "no URDF is carried"))?;
    let links = info.links.map(|links| links.to_string());
    writeln!(out, "  links     {}", or(&links, "not known"))?;
    let joints = info.joints.iter().map(|(kind, n)| format!("{n} {kind}")).collect::<Vec<_>>();
    let joints = (!joints.is_empty()).then(|| joints.join(", "));
    writeln!(out, "  joints    {}", or(&joints, "none"))?;
    writeln!(out, "  DOFs      {}", info.dofs.len())?;
    let width = widest(info.dofs.iter().map(|dof| &dof.name));
    for (index, dof) in info.dofs.iter().enumerate() {
        let unit = dof.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
        let bounds = dof.bounds.map(|[lower, upper]| format!("  [{lower}, {upper}]{unit}"));
        let bounds = bounds.unwrap_or_default();
        writeln!(out, "    {index:>3}  {:width$}{bounds}", safe(&dof.name))?;
    }
    if let Some(loops) = &info.loops {
        loops.write(out)?;
    }
    if let Some(geometry) = &info.geometry {
        geometry.write(out)?;
    }
    write_skipped(info.skipped_contacts.as_deref().unwrap_or_default(), out)?;
    if let Some(model) = &info.collision_model {
        model.write(out)?;
    }
    write_spheres(&info.spheres, out)?;
    if !info.parts.is_empty() {
        let base = info.base.as_deref().map(|base| format!("on {}", safe(base)));
        writeln!(out, "{}", format!("  parts     {}", base.unwrap_or_default()).trim_end())?;
        write_parts(&info.parts, "    ", out)?;
    }
    writeln!(out, "  modules   {}", info.modules.len())?;
    let width = widest(info.modules.iter().map(|module| &module.path));
    for module in &info.modules {
        let version = safe(module.version.as_deref().unwrap_or("-"));
        let unusable = module.unusable.as_ref().map(|reason| format!("  ({})", safe(reason)));
        let unusable = unusable.unwrap_or_default();
        writeln!(
            out,
            "    {:width$}  {version:6}  {:>4} files  {:>9} kB{unusable}",
            safe(&module.path),
            module.files,
            module.bytes.div_ceil(1000)
        )?;
    }
    if let Some(orders) = &info.order {
        write_orders(orders, out)?;
    }
    info.statics.as_ref().map_or(Ok(()), |statics| statics.write(out))
}

/// Writes the joints for people: a column for each order, with the programs that have it.
fn write_orders(orders: &[JointOrder], out: &mut impl Write) -> fmt::Result {
    columns("order", "of joints that move", orders, |order| &order.joints, out)?;
    columns("actuators", "of exports that have them", orders, |order| &order.actuators, out)
}

fn columns(
    what: &str,
    of: &str,
    orders: &[JointOrder],
    list: fn(&JointOrder) -> &Vec<String>,
    out: &mut impl Write,
) -> fmt::Result {
    let mut columns: Vec<(&Vec<String>, Vec<&str>)> = Vec::new();
    for order in orders.iter().filter(|order| !list(order).is_empty()) {
        match columns.iter_mut().find(|(known, _)| *known == list(order)) {
            Some((_, programs)) => programs.push(order.program),
            None => columns.push((list(order), vec![order.program])),
        }
    }
    if columns.is_empty() {
        return Ok(());
    }
    writeln!(out, "  {what:9} {of}")?;
    let heads: Vec<String> = columns.iter().map(|(_, programs)| programs.join(", ")).collect();
    let widths =
        columns.iter().zip(&heads).map(|((names, _), head)| widest(names.iter()).max(head.len()));
    let widths: Vec<usize> = widths.collect();
    let mut line = |first: String, cell: &dyn Fn(usize) -> String| {
        let cells = widths.iter().enumerate().map(|(k, width)| format!("  {:width$}", cell(k)));
        writeln!(out, "{}", format!("    {first:>3}{}", cells.collect::<String>()).trim_end())
    };
    line(String::new(), &|column| heads[column].clone())?;
    let longest = columns.iter().map(|(names, _)| names.len()).max().unwrap_or(0);
    for row in 0..longest {
        line(row.to_string(), &|column| {
            columns[column].0.get(row).map_or(String::new(), |name| safe(name))
        })?;
    }
    Ok(())
}

/// A name on one line.
fn safe(text: &str) -> String {
    escape::line(text).into_owned()
}

/// The width of the longest of these names, in characters.
fn widest<'a>(names: impl Iterator<Item = &'a String>) -> usize {
    let widths = names.map(|name| safe(name).chars().count());
    widths.max().unwrap_or(0)
}
