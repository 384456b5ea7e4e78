//! Robot of boxes -> mesh modules and their files.

use std::collections::BTreeMap;

use serde_json::json;
use urdd_format::convex_decomposition_meshes::*;
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::index::{ElementIdx, LinkIdx};
use urdd_format::meshes::{GeometryKind, MeshFiles};
use urdd_format::original_meshes::*;
use urdd_format::plain_meshes::{PlainMesh, PlainMeshesModule};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Geometry, Link, Origin, Visual};

use super::robot::Robot;
use super::transform::{Rotation, apply, rotation_of_rpy, transform};

pub type Point = [f64; 3];

/// The twelve triangles of a box, counter-clockwise seen from outside. Bits 0, 1 and 2 of a corner's index select its
/// side along x, y and z.
pub const TRIANGLES: [[u16; 3]; 12] = [
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
];

/// A box in a link's frame.
#[derive(Debug, Clone)]
pub struct Solid {
    pub centre: Point,
    pub rpy: [f64; 3],
    /// The corners as in the files: rounded to binary32.
    pub corners: [Point; 8],
}

impl Solid {
    pub fn rotation(&self) -> Rotation {
        rotation_of_rpy(self.rpy)
    }

    fn new(xyz: Point, rpy: [f64; 3], low: Point, high: Point) -> Solid {
        let place = transform(rotation_of_rpy(rpy), xyz);
        let corner = |number: usize| {
            let side = |bit: usize| {
                if number >> bit & 1 == 0 { low[bit] } else { high[bit] }
            };
            apply(&place, [side(0), side(1), side(2)]).map(|c| f64::from(c as f32) + 0.0)
        };
        Solid {
            centre: apply(&place, [0, 1, 2].map(|i| (low[i] + high[i]) / 2.0)),
            rpy,
            corners: std::array::from_fn(corner),
        }
    }
}

/// The meshes of a link.
#[derive(Debug, Clone)]
pub struct LinkSolids {
    /// The kind of elements that they come from.
    pub geometry: GeometryKind,
    /// The colour, if the URDF has one.
    pub color: Option<[f64; 4]>,
    /// The plain mesh, which is also the hull.
    pub whole: Solid,
    /// The whole box for links with an odd index, otherwise its two halves.
    pub pieces: Vec<Solid>,
}

/// The mesh modules of a robot.
pub struct Meshes {
    pub originals: OriginalMeshesModule,
    pub plain: PlainMeshesModule,
    pub hulls: ConvexHullMeshesModule,
    pub pieces: ConvexDecompositionMeshesModule,
    /// Every file that these modules reference.
    pub files: BTreeMap<String, Vec<u8>>,
    /// The geometry in the files, per link.
    pub solids: Vec<Option<LinkSolids>>,
}

impl Meshes {
    /// # Panics
    /// If a link has more than one visual or collision element, or a round one.
    pub fn new(robot: &Robot) -> Meshes {
        let mut files = BTreeMap::new();
        let originals = original_meshes_module(robot, &mut files);
        let solids: Vec<Option<LinkSolids>> =
            (0..robot.urdf.links.len()).map(|idx| link_solids(robot, idx)).collect();
        let mut link_meshes = Vec::new();
        let mut link_hulls = Vec::new();
        let mut link_pieces = Vec::new();
        for (idx, (solids, link)) in solids.iter().zip(&robot.urdf.links).enumerate() {
            let stem = format!("{idx}_{}", slug(&link.name));
            let Some(solids) = solids else {
                link_meshes.push(None);
                link_hulls.push(None);
                link_pieces.push(Vec::new());
                continue;
            };
            let mut write = |kind: ModuleKind, stem: &str, solid: &Solid| {
                let path = |extension: &str| {
                    format!("{}/meshes/{extension}/{stem}.{extension}", kind.folder())
                };
                let named =
                    MeshFiles { stl: Some(path("stl")), obj: Some(path("obj")), glb: path("glb") };
                files.insert(path("stl"), stl(&solid.corners));
                files.insert(path("obj"), obj(&solid.corners, None));
                files.insert(named.glb.clone(), glb(&solid.corners, solids.color));
                named
            };
            link_meshes.push(Some(PlainMesh {
                geometry: solids.geometry,
                files: write(ModuleKind::PlainMeshes, &stem, &solids.whole),
            }));
            link_hulls.push(Some(write(ModuleKind::ConvexHullMeshes, &stem, &solids.whole)));
            let pieces = solids.pieces.iter().enumerate().map(|(i, piece)| {
                let stem = format!("{stem}/{i}");
                write(ModuleKind::ConvexDecompositionMeshes, &stem, piece)
            });
            link_pieces.push(pieces.collect());
        }
        Meshes {
            originals,
            plain: PlainMeshesModule { preferred_geometry: GeometryKind::Visual, link_meshes },
            hulls: ConvexHullMeshesModule { link_hulls },
            pieces: ConvexDecompositionMeshesModule {
                method: DecompositionMethod {
                    name: "halves".to_owned(),
                    surface_tolerance: Some(0.0),
                },
                link_pieces,
            },
            files,
            solids,
        }
    }
}

/// The slug of a link's name (7.3).
pub fn slug(name: &str) -> String {
    let mut slug = String::new();
    let mut in_run = false;
    for c in name.chars() {
        let stays = c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if stays {
            slug.push(c);
        } else if !in_run {
            slug.push('_');
        }
        in_run = !stays;
    }
    slug.truncate(64);
    if slug.is_empty() {
        slug.push_str("link");
    }
    slug
}

// ---- Originals

fn original_meshes_module(
    robot: &Robot,
    files: &mut BTreeMap<String, Vec<u8>>,
) -> OriginalMeshesModule {
    let folder = format!("{}/meshes", ModuleKind::OriginalMeshes.folder());
    let mut carried: BTreeMap<String, OriginalMesh> = BTreeMap::new();
    let mut references = Vec::new();
    for (link_idx, link) in (0..).map(LinkIdx).zip(&robot.urdf.links) {
        for (geometry, elements) in elements_of(link) {
            for (element_idx, element) in (0..).map(ElementIdx).zip(elements) {
                let Some(Geometry::Mesh(mesh)) = element.1 else {
                    continue;
                };
                let place = robot.meshes.keys().position(|f| *f == mesh.filename);
                let path = place.map(|n| {
                    let name = mesh.filename.rsplit('/').next().unwrap_or_default();
                    let path = format!("{folder}/{n}/{name}");
                    let (bytes, side) = original(name, robot.meshes[&mesh.filename]);
                    files.insert(path.clone(), bytes);
                    let side = side.map(|(name, bytes)| {
                        let side_path = format!("{folder}/{n}/{name}");
                        files.insert(side_path.clone(), bytes);
                        side_path
                    });
                    let entry = OriginalMesh {
                        path: path.clone(),
                        side_files: side.into_iter().collect(),
                        usable: true,
                    };
                    carried.insert(path.clone(), entry);
                    path
                });
                references.push(MeshReference {
                    link_idx,
                    geometry,
                    element_idx,
                    filename: mesh.filename.clone(),
                    path,
                });
            }
        }
    }
    OriginalMeshesModule { references, files: carried.into_values().collect() }
}

/// A mesh file of a box in the format of its file extension, and the file that it references, if any.
fn original(name: &str, size: [f64; 3]) -> (Vec<u8>, Option<(String, Vec<u8>)>) {
    let (low, high) = sides(size);
    let corners = Solid::new([0.0; 3], [0.0; 3], low, high).corners;
    match name.to_lowercase().rsplit_once('.') {
        Some((stem, "obj")) => {
            let material = format!("{stem}.mtl");
            let text = "newmtl grey\nKd 0.5 0.5 0.5\n";
            let mesh = obj(&corners, Some(&material));
            (mesh, Some((material, text.as_bytes().to_vec())))
        }
        Some((_, "glb")) => (glb(&corners, None), None),
        _ => (stl(&corners), None),
    }
}

/// The extreme corners of a box in a mesh file, rounded to binary32.
fn sides(size: [f64; 3]) -> (Point, Point) {
    let high = size.map(|side| f64::from((side / 2.0) as f32));
    (high.map(|side| -side), high)
}

type Element<'a> = (&'a Option<Origin>, &'a Option<Geometry>);

fn elements_of(link: &Link) -> [(GeometryKind, Vec<Element<'_>>); 2] {
    let visual = link.visual.iter().map(|v| (&v.origin, &v.geometry));
    let collision = link.collision.iter().map(|c| (&c.origin, &c.geometry));
    [(GeometryKind::Visual, visual.collect()), (GeometryKind::Collision, collision.collect())]
}

// ---- Solids

fn link_solids(robot: &Robot, idx: usize) -> Option<LinkSolids> {
    let link = &robot.urdf.links[idx];
    let (geometry, elements) = elements_of(link).into_iter().find(|(_, e)| !e.is_empty())?;
    let [(origin, shape)] = elements[..] else {
        panic!("link {:?}: one visual or collision, please", link.name);
    };
    let (low, high) = match shape.as_ref()? {
        Geometry::Box(cuboid) => (cuboid.size.map(|s| -s / 2.0), cuboid.size.map(|s| s / 2.0)),
        Geometry::Mesh(mesh) => {
            let (low, high) = sides(*robot.meshes.get(&mesh.filename)?);
            let scale = mesh.scale.unwrap_or([1.0; 3]);
            let scaled = |side: Point| [0, 1, 2].map(|i| side[i] * scale[i]);
            (scaled(low), scaled(high))
        }
        other => panic!("link {:?}: {other:?} is round", link.name),
    };
    let xyz = origin.as_ref().and_then(|o| o.xyz).unwrap_or_default();
    let rpy = origin.as_ref().and_then(|o| o.rpy).unwrap_or_default();
    let whole = Solid::new(xyz, rpy, low, high);
    let middle = (low[0] + high[0]) / 2.0;
    let pieces = if idx % 2 == 1 {
        vec![whole.clone()]
    } else {
        vec![
            Solid::new(xyz, rpy, low, [middle + robot.overlap, high[1], high[2]]),
            Solid::new(xyz, rpy, [middle - robot.overlap, low[1], low[2]], high),
        ]
    };
    let color = link.visual.first().and_then(|visual| color(robot, visual));
    Some(LinkSolids { geometry, color, whole, pieces })
}

fn color(robot: &Robot, visual: &Visual) -> Option<[f64; 4]> {
    let material = visual.material.as_ref()?;
    let named = robot.urdf.materials.iter().find(|m| m.name == material.name);
    let color = material.color.as_ref();
    let color = color.or_else(|| named.and_then(|m| m.color.as_ref()));
    color.map(|c| c.rgba)
}

// ---- Files

/// Binary STL.
pub fn stl(corners: &[Point; 8]) -> Vec<u8> {
    let mut out = vec![b' '; 80];
    out.extend(12u32.to_le_bytes());
    for [a, b, c] in TRIANGLES {
        let [a, b, c] = [a, b, c].map(|i| corners[usize::from(i)]);
        let normal = super::transform::unit(cross(minus(b, a), minus(c, a)));
        for v in [normal, a, b, c] {
            v.iter().for_each(|x| out.extend((*x as f32 + 0.0).to_le_bytes()));
        }
        out.extend([0, 0]);
    }
    out
}

/// Wavefront OBJ. Each binary32 is written exactly, so that readers of any precision get the same value.
pub fn obj(corners: &[Point; 8], material: Option<&str>) -> Vec<u8> {
    let mut out = String::new();
    if let Some(material) = material {
        out.push_str(&format!("mtllib {material}\nusemtl grey\n"));
    }
    for [x, y, z] in corners {
        out.push_str(&format!("v {x} {y} {z}\n"));
    }
    for [a, b, c] in TRIANGLES {
        out.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    }
    out.into_bytes()
}

/// Binary glTF 2.0: one mesh with one primitive, on one node without a transform.
pub fn glb(corners: &[Point; 8], color: Option<[f64; 4]>) -> Vec<u8> {
    let mut data: Vec<u8> = Vec::new();
    for x in corners.as_flattened() {
        data.extend((*x as f32).to_le_bytes());
    }
    for i in TRIANGLES.as_flattened() {
        data.extend(i.to_le_bytes());
    }
    let extreme = |pick: fn(f64, f64) -> f64| {
        [0, 1, 2].map(|i| corners.iter().map(|c| c[i]).reduce(pick).expect("eight"))
    };
    let mut gltf = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
              "min": extreme(f64::min), "max": extreme(f64::max) },
            { "bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 96, "target": 34962 },
            { "buffer": 0, "byteOffset": 96, "byteLength": 72, "target": 34963 },
        ],
        "buffers": [{ "byteLength": data.len() }],
    });
    if let Some(color) = color {
        gltf["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorFactor": color } }]);
        gltf["meshes"][0]["primitives"][0]["material"] = json!(0);
    }
    let mut text = gltf.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = b"glTF".to_vec();
    let total = 12 + 8 + text.len() + 8 + data.len();
    out.extend([2, total as u32].map(u32::to_le_bytes).as_flattened());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &data)] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend(kind);
        out.extend(chunk);
    }
    out
}

pub fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

pub fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
