//! The description of a robot: names, joints, bounds, mass, the paths of its meshes and the triangles of a mesh.

use nalgebra::{Rotation3, UnitQuaternion};
use serde_json::{Value, json};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_document::consumer::{self, ConsumerModules};
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::{MeshFormat, MeshPath};
use urdd_document::robot::{Inertial, Limit, Origin};
use urdd_document::urdd::Urdd;
use urdd_format::dof::Quantity;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_geometry::read::{GltfUp, Options, read_with};
use urdd_robot::{Configurations, Robot};

use crate::files::Files;
use crate::{answer, loops, memory};

/// The modules that [`about`] reads.
const READ: &[ModuleKind] = &[
    ModuleKind::Urdf,
    ModuleKind::Chain,
    ModuleKind::Dof,
    ModuleKind::Bounds,
    ModuleKind::OriginalMeshes,
    ModuleKind::PlainMeshes,
    ModuleKind::ConvexHullMeshes,
    ModuleKind::ConvexDecompositionMeshes,
];

/// The description of a robot, as far as its modules can be read. Missing parts are null, and listed in `faults`.
///
/// - `name`, `folder`, `profile`, `metadata` (`urdd.json`).
/// - `links`: `name`, `parent_joint`, and `inertial`: `mass` (kg), `position` (m) and `quaternion_wxyz` of the centre of
///   mass in the link's frame, `inertia` (xx, xy, xz, yy, yz, zz; kg m²).
/// - `joints`: `name`, `type`, `parent`, `child` (links), `origin` (of the joint in its parent's frame), `axis`,
///   `dofs`, `mimic` (`dof`, `multiplier`, `offset`), `limit` as in the URDF.
/// - `dofs`: `name`, `joint`, `unit`, `bounds`, `is_limited` (without, bounds are a range to sample from). `zero` and
///   `middle` are configurations.
/// - `loops`: [`loops::about`].
/// - `meshes`: by kind, the meshes of each link, each with `glb` for display and `read` for the file that is cheapest
///   to read.
pub fn about(robot: &Robot) -> Result<Value, String> {
    let part = robot.part_as_it_is(READ).map_err(|error| error.to_string())?;
    let mut faults = Vec::new();
    for kind in READ {
        if let Some(module) = part.module(*kind)
            && let Some(unusable) = module.unusable()
        {
            let reason = module.first_fault();
            faults.push(json!({
                "module": kind.name(),
                "reason": reason.unwrap_or_else(|| unusable.to_string()),
            }));
        }
    }
    let modules = consumer::modules(&part);
    let configurations = robot.configurations();
    if let Err(error) = &configurations {
        faults.push(json!({ "module": Value::Null, "reason": error.to_string() }));
    }
    let configurations = configurations.ok();
    let closing = loops::about(robot).unwrap_or_else(|error| {
        faults.push(json!({ "module": ModuleKind::Loops.name(), "reason": error.to_string() }));
        Value::Null
    });
    Ok(json!({
        "name": part.robot().map(|robot| &robot.name),
        "folder": robot.folder_name(),
        "profile": part.profile().as_str(),
        "metadata": part.metadata_file().json.document().map(|document| &document.value),
        "links": links(&part, modules.as_ref()),
        "joints": joints(&part, modules.as_ref()),
        "dofs": modules.as_ref().map(|modules| dofs(modules, configurations)),
        "loops": closing,
        "zero": configurations.map(Configurations::zero),
        "middle": configurations.map(Configurations::middle),
        "meshes": {
            "original": original(&part),
            "plain": meshes(&part, ModuleKind::PlainMeshes),
            "hulls": meshes(&part, ModuleKind::ConvexHullMeshes),
            "pieces": meshes(&part, ModuleKind::ConvexDecompositionMeshes),
        },
        "faults": faults,
    }))
}

fn links(part: &Urdd, modules: Option<&ConsumerModules>) -> Value {
    let known = part.robot();
    let inertial = |link: usize| Some(inertial_of(known?.links.get(link)?.inertial.as_ref()?));
    let link = |(k, (name, parent)): (usize, (&String, Option<usize>))| -> Value {
        json!({ "name": name, "parent_joint": parent, "inertial": inertial(k) })
    };
    match (modules, known) {
        (Some(modules), _) => {
            let links = modules.chain.links_in_chain.iter();
            let links = links.map(|link| (&link.name, link.parent_joint_idx.map(|idx| idx.get())));
            links.enumerate().map(link).collect()
        }
        (None, Some(robot)) => {
            let parent = |name: &str| robot.joints.iter().position(|joint| joint.child == name);
            let links = robot.links.iter().map(|link| (&link.name, parent(&link.name)));
            links.enumerate().map(link).collect()
        }
        (None, None) => json!([]),
    }
}

fn inertial_of(inertial: &Inertial) -> Value {
    json!({
        "mass": inertial.mass,
        "inertia": inertial.inertia,
        "position": inertial.origin.xyz,
        "quaternion_wxyz": quaternion(&inertial.origin),
    })
}

/// The rotation of an origin: w, x, y, z.
pub fn quaternion(origin: &Origin) -> [f64; 4] {
    let turn =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(origin.rotation()));
    [turn.w, turn.i, turn.j, turn.k]
}

fn limit_of(limit: Limit) -> Value {
    json!({
        "lower": limit.lower,
        "upper": limit.upper,
        "effort": limit.effort,
        "velocity": limit.velocity,
    })
}

fn joints(part: &Urdd, modules: Option<&ConsumerModules>) -> Value {
    let Some(robot) = part.robot() else {
        return json!([]);
    };
    let joints = robot.joints.iter().enumerate();
    joints
        .map(|(k, joint)| {
            let chain = modules.and_then(|m| m.chain.joints_in_chain.get(k));
            let dofs = modules.and_then(|m| m.dof.joint_idx_to_dof_idxs_mapping.get(k));
            let mimic = modules.and_then(|m| m.dof.joint_idx_to_mimic_mapping.get(k)?.as_ref());
            json!({
                "name": joint.name,
                "type": joint.joint_type,
                "parent": robot.link(&joint.parent),
                "child": robot.link(&joint.child),
                "origin": chain.map(|chain| json!({
                    "position": chain.origin.position,
                    "quaternion_wxyz": chain.origin.quaternion_wxyz,
                })),
                "axis": chain.and_then(|chain| chain.axis),
                "dofs": dofs.map(|dofs| dofs.iter().map(|dof| dof.get()).collect::<Vec<_>>()),
                "mimic": mimic.map(|mimic| json!({
                    "dof": mimic.dof_idx.map(|dof| dof.get()),
                    "multiplier": mimic.multiplier,
                    "offset": mimic.offset,
                })),
                "limit": joint.limit.map(limit_of),
            })
        })
        .collect()
}

fn dofs(modules: &ConsumerModules, space: Option<&Configurations>) -> Value {
    let dofs = modules.dof.dofs.iter().enumerate();
    dofs.map(|(k, dof)| {
        json!({
            "name": dof.name,
            "joint": dof.joint_idx.get(),
            "unit": match dof.quantity { Quantity::Angle => "rad", Quantity::Length => "m" },
            "bounds": space.and_then(|space| space.bounds().get(k)),
            "is_limited": space.and_then(|space| space.dof_is_limited().get(k)),
        })
    })
    .collect()
}

/// The meshes of each link.
fn meshes(part: &Urdd, kind: ModuleKind) -> Option<Value> {
    let meshes = part.meshes(kind)?;
    let files = MeshFiles::new(part);
    let own = |path: &MeshPath| Some(files.own(meshes.profile, path.path)?.to_owned());
    let of_link = |link: usize| -> Value {
        let piece = |piece: usize| {
            let lists = meshes.lists.iter();
            let found = lists.filter_map(|list| list.links.get(link)?.get(piece));
            let paths: Vec<&MeshPath> = found.flat_map(|mesh| &mesh.paths).collect();
            // An archive in a page in one file omits some formats.
            let is_there = |path: &MeshPath| {
                let own = files.own(meshes.profile, path.path);
                own.is_some_and(|own| part.listing().has_file(own))
            };
            let of = |format| {
                let mut of_format = paths.iter().filter(|path| path.format == Some(format));
                of_format.find(|path| is_there(path))
            };
            let read = [MeshFormat::Stl, MeshFormat::Obj, MeshFormat::Glb].into_iter().find_map(of);
            json!({
                "glb": of(MeshFormat::Glb).and_then(|path| own(path)),
                "read": read.or(paths.first()).and_then(|path| own(path)),
            })
        };
        (0..meshes.count(link)).map(piece).collect()
    };
    Some((0..meshes.num_links()).map(of_link).collect())
}

/// The mesh files that the URDF references, with their links.
fn original(part: &Urdd) -> Option<Value> {
    let Some(ModuleDocument::OriginalMeshes(module)) = part.document(ModuleKind::OriginalMeshes)
    else {
        return None;
    };
    let references = module.references.iter();
    Some(
        references
            .map(|reference| {
                json!({
                    "link": reference.link_idx.get(),
                    "geometry": reference.geometry,
                    "element": reference.element_idx.get(),
                    "filename": reference.filename,
                    "path": reference.path,
                })
            })
            .collect(),
    )
}

/// Maximum number of triangles of a mesh file.
const MAX_TRIANGLES: usize = 5_000_000;

/// The triangles of a mesh file as stored in the URDD (without an axis conversion for .glb): an answer of
/// [`answer::bytes_or_error`] with little-endian 32-bit words: the number of vertices; the number of triangles; x, y, z
/// of each vertex, binary32; three indices of each triangle.
///
/// # Safety
/// `files` is open; the path, in UTF-8, is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_mesh(files: *mut Files, path: *const u8, length: usize) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, path) = unsafe { (&*files, memory::bytes(path, length)) };
    answer::bytes_or_error(triangles(files, &String::from_utf8_lossy(path)))
}

fn triangles(files: &Files, path: &str) -> Result<Vec<u8>, String> {
    let bytes = files.read(path, MAX_DOCUMENT_BYTES)?;
    let options =
        Options { gltf_up: GltfUp::Keep, max_triangles: MAX_TRIANGLES, ..Options::default() };
    let scene =
        read_with(&bytes, path, &mut |_| None, &options).map_err(|error| match &error.place {
            Some(place) => format!("{place}: {}", error.fault),
            None => error.fault.to_string(),
        })?;
    let mesh = scene.merged();
    let words = 2 + 3 * (mesh.vertices.len() + mesh.triangles.len());
    let mut out = Vec::with_capacity(4 * words);
    let mut word = |word: u32| out.extend_from_slice(&word.to_le_bytes());
    let count = |count: usize| u32::try_from(count).map_err(|_| "it is too large".to_owned());
    word(count(mesh.vertices.len())?);
    word(count(mesh.triangles.len())?);
    for x in mesh.vertices.iter().flatten() {
        word((*x as f32).to_bits());
    }
    mesh.triangles.iter().flatten().for_each(|index| word(*index));
    Ok(out)
}
