use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::regular;
use urdd_format::report::Fix;

use super::prelude::*;
use crate::geometry::{MeshFacts, NamedMesh, is_read_here};

declare_lint! {
    /// A collision shape has a size of 0 or less.
    ///
    /// Programs that load the robot have a shape that nothing touches. A visual of size 0 draws nothing, and is no finding.
    ///
    /// Write the size in metres, or remove the collision.
    LNT033 "size-not-positive", Error, Collisions, since "1.1.0" => size_not_positive;

    /// A body is drawn, and nothing can collide with it.
    ///
    /// It falls through the floor in simulators, and planners move through it. MoveIt warns: `Link X has visual geometry but no
    /// collision geometry`. Links that fixed joints hold together count as one body; bodies under 10 cm, and robots
    /// without any collision, are left out.
    ///
    /// Add a `<collision>`: a box or cylinder is often enough.
    LNT020 "visual-without-collision", Info, Collisions, since "1.1.0", off by default => visual_without_collision;

    /// The visuals and the collisions of a link are the same, but in different places or in different units.
    ///
    /// Boxes around both have the same three lengths to 5 %, and are apart; or one is 10, 25.4, 100 or 1000 times as large as
    /// the other. Contacts then happen where nothing is seen.
    ///
    /// Give both the same `<origin>` and `scale`.
    LNT021 "visual-and-collision-apart", Warning, Collisions, since "1.1.0" => visual_and_collision_apart;

    /// A number of a colour is below 0 or above 1.
    ///
    /// Programs leave the colour out, or show white; yourdfpy stops. Mostly these are 0 to 255.
    ///
    /// Divide by 255.
    LNT048 "color-out-of-range", Warning, Appearance, since "1.1.0" => color_out_of_range;

    /// A COLLADA file is not in metres.
    ///
    /// RViz, Gazebo and PyBullet's collisions multiply by the file's unit; Pinocchio and trimesh, so yourdfpy, do not. The part has
    /// different sizes in different programs. `urdd` multiplies, as the format demands.
    ///
    /// Export the mesh in metres, with `<unit meter="1"/>`.
    LNT031 "collada-unit", Warning, WrongPlace, since "1.1.0" => collada_unit;

    /// A COLLADA file says that another axis than z is up.
    ///
    /// Robotics programs ignore it: RViz, MoveIt, Pinocchio, PyBullet, trimesh, and `urdd`. Others turn the mesh, such as
    /// Foxglove.
    ///
    /// Export the mesh with z up, as it is to be in the link.
    LNT053 "collada-up-axis", Info, WrongPlace, since "1.1.0", off by default => collada_up_axis;

    /// An STL is text, or is cut off.
    ///
    /// A program that does not read it refuses the robot, or leaves out the shape, which its log alone says. yourdfpy reads
    /// text.
    ///
    /// Export the mesh as binary STL.
    LNT034 "stl-refused", Warning, Collisions, since "1.1.0" => stl_refused;

    /// A mesh is there, but holds no triangles that can be read.
    ///
    /// The robot has no shape there, if a program loads it at all. Often the file is a pointer of Git LFS: the mesh itself was not fetched.
    ///
    /// Export the mesh again, or fetch it: `git lfs pull`.
    LNT035 "mesh-not-readable", Error, MissingGeometry, since "1.1.0" => mesh_not_readable;

    /// A collision mesh has more than 50,000 triangles.
    ///
    /// Collision checks take long, and so does loading: PR2's took 30 s. MuJoCo refuses a robot
    /// with an STL of more than 200,000.
    /// PyBullet loads a part of a large one. Common robots have 100 to 5,000 a link.
    ///
    /// Take the convex hull, or a few boxes. `urdd generate` makes convex pieces.
    LNT024 "heavy-collision-mesh", Info, Collisions, since "1.1.0" => heavy_collision_mesh;

    /// Two different collision meshes have one file name in different folders.
    ///
    /// MuJoCo before 4.0 drops the folders of names in a URDF, and takes one mesh for both links without a word.
    ///
    /// Rename one of the files.
    LNT032 "mesh-names-clash", Info, Collisions, since "1.1.0" => mesh_names_clash;

    /// The scale of a collision mesh mirrors it, or flattens it.
    ///
    /// A mirrored mesh has its faces inside out, and Gazebo's collisions fail with it. MuJoCo 4 and trimesh turn the faces.
    /// Two negative factors are a rotation, and no finding. With a factor of 0 on a
    /// collision mesh, MuJoCo refuses the robot.
    ///
    /// Export a mirrored mesh, and write positive factors.
    LNT023 "mirrored-scale", Warning, Collisions, since "1.1.0" => mirrored_scale;

    /// A mesh is a hundred times as long as the robot's joints are apart, or shorter than a millimetre.
    ///
    /// One that is short is a warning where most meshes of the robot are longer, and no finding on a link without `<inertial>`, where
    /// it may mark a frame.
    ///
    /// It is in millimetres, or was scaled to metres twice. RViz shows nothing, because the camera is inside of the mesh; planners see
    /// everything in collision.
    ///
    /// Write `scale="0.001 0.001 0.001"`, or remove a scale that is wrong, or export the mesh in metres.
    LNT022 "mesh-in-millimetres", Error, WrongPlace, since "1.1.0" => mesh_in_millimetres
}

fn size_not_positive(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for link in &urdf.links {
        let geometries =
            named(*link, "collision").filter_map(|collision| child(collision, "geometry"));
        for (name, shape) in geometries.flat_map(children) {
            let length = |name| number(shape, name).unwrap_or(f64::INFINITY);
            let least = match name {
                "box" => {
                    numbers::<3>(shape, "size").map_or(f64::INFINITY, |[x, y, z]| x.min(y).min(z))
                }
                "sphere" => length("radius"),
                "cylinder" | "capsule" => length("radius").min(length("length")),
                _ => continue,
            };
            if least <= 0.0 {
                let message = format!(
                    "the {name} has a size of {least}; write the size in metres, or remove the collision"
                );
                urdf.at(shape, message).report(findings);
            }
        }
    }
    Some(())
}

/// Smaller bodies are screws and finger tips, m.
const SMALL: f64 = 0.1;

fn visual_without_collision(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    let collides = |link: usize| !robot.links[link].collision.is_empty();
    if !(0..robot.links.len()).any(collides) {
        return Some(());
    }
    for (&top, body) in &geometry.bodies {
        if robot.links[top].name == "world" || bodies.members(top).any(collides) {
            continue;
        }
        let visuals = body.shapes.iter().filter(|shape| shape.kind == GeometryKind::Visual);
        let size = diagonal(visuals.flat_map(|shape| shape.corners()));
        if size >= SMALL {
            let message = format!(
                "this is drawn {} long, and nothing can collide with it; add a `<collision>`",
                metres(size)
            );
            let mut members = bodies.members(top);
            let drawn = members.find(|link| !robot.links[*link].visual.is_empty());
            urdf.at(urdf.links[drawn.unwrap_or(top)], message).report(findings);
        }
    }
    Some(())
}

/// Lengths are the same to this part.
const SAME: f64 = 0.05;
/// How far the centres may be apart, as a part of the diagonal.
const APART: f64 = 0.2;
/// Ratios of units, and to which part.
const UNITS: [f64; 4] = [10.0, 25.4, 100.0, 1000.0];
const CLOSE: f64 = 0.03;

fn visual_and_collision_apart(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let geometry = urdf.geometry(findings)?;
    for (index, link) in
        geometry.links.iter().enumerate().filter(|(_, link)| !link.is_partial && !link.is_turned)
    {
        let visual = bounds(link.corners_of(GeometryKind::Visual));
        let collision = bounds(link.corners_of(GeometryKind::Collision));
        let Some(((a, b), (c, d))) = visual.zip(collision) else { continue };
        let (visual, collision) = (b - a, d - c);
        let (seen, solid) = (visual.norm(), collision.norm());
        if seen.min(solid) <= 0.0 {
            continue;
        }
        let ratio = seen.max(solid) / seen.min(solid);
        let apart = ((a + b - c - d) / 2.0).norm();
        let message = if is_same(&visual, &collision) && apart > APART * seen.max(solid) {
            format!(
                "visuals and collisions have the same size, but are {} apart; put both in the same place",
                metres(apart)
            )
        } else if UNITS.iter().any(|unit| (ratio / unit - 1.0).abs() < CLOSE) {
            format!(
                "the visuals are {} long and the collisions {}; give both the same scale",
                metres(seen),
                metres(solid)
            )
        } else {
            continue;
        };
        urdf.at(urdf.links[index], message).report(findings);
    }
    Some(())
}

fn is_same(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    let sorted = |lengths: &Vector3<f64>| {
        let mut sorted = [lengths.x, lengths.y, lengths.z];
        sorted.sort_by(f64::total_cmp);
        sorted
    };
    let pairs = sorted(a).into_iter().zip(sorted(b));
    pairs.into_iter().all(|(a, b)| (a - b).abs() <= SAME * a.max(b))
}

/// A rounded 1.
const MOST: f64 = 1.001;
const BYTE: f64 = 255.0;

fn color_out_of_range(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let colors = urdf.root.descendants().filter(|node| node.tag_name().name() == "color");
    for color in colors {
        let Some(rgba) = numbers::<4>(color, "rgba") else { continue };
        if rgba.iter().all(|value| (0.0..=MOST).contains(value)) {
            continue;
        }
        let message = "the colour is not red, green, blue and opacity from 0 to 1; divide by 255";
        let is_bytes = rgba.iter().all(|value| (0.0..=BYTE).contains(value));
        let fix = urdf.value(color, "rgba").filter(|_| is_bytes).map(|range| {
            // An opacity of 1 beside bytes may be either.
            let [r, g, b, a] = rgba;
            let a = if a <= MOST { a } else { a / BYTE };
            let mended = [r / BYTE, g / BYTE, b / BYTE, a].map(|value| format!("{value}"));
            let fix = urdf.fix("divide the colour by 255", range, mended.join(" "));
            Fix { is_safe: false, ..fix }
        });
        urdf.at_attribute(color, "rgba", message).fix(fix).report(findings);
    }
    Some(())
}

/// Says what `fault` finds in meshes that were read.
fn each(
    urdf: &Subject,
    findings: &mut Findings,
    fault: impl Fn(Node, &NamedMesh) -> Option<String>,
) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        if let Some(message) = fault(node, &mesh) {
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}

/// Whether the reader noted something of a mesh.
fn is_noted(facts: &MeshFacts, code: NoteCode) -> bool {
    facts.notes.iter().any(|note| note.code == code)
}

fn collada_unit(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let message = "the mesh is not in metres, and programs differ in whether they convert it; export it in metres";
    each(urdf, findings, |_, mesh| {
        is_noted(mesh.facts.ok()?, NoteCode::UnitApplied).then(|| message.to_owned())
    })
}

fn collada_up_axis(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let message = "the mesh says that another axis than z is up, and some viewers turn it; export it with z up";
    each(urdf, findings, |_, mesh| {
        is_noted(mesh.facts.ok()?, NoteCode::UpAxisIgnored).then(|| message.to_owned())
    })
}

fn stl_refused(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    each(urdf, findings, |_, mesh| {
        let facts = mesh.facts.ok()?;
        let message = match facts.format {
            Format::StlAscii => "the STL is text; export it as binary STL",
            Format::StlBinary if is_noted(facts, NoteCode::CutOff) => {
                "the STL is cut off; export it again"
            }
            _ => return None,
        };
        Some(message.to_owned())
    })
}

fn mesh_not_readable(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    each(urdf, findings, |_, mesh| {
        let reason = mesh.facts.err().filter(|_| is_read_here(mesh.file))?;
        // Most reasons of the reader end with what to do.
        let advice = if reason.contains("; ") { "" } else { "; export the mesh again" };
        Some(format!("the mesh cannot be read: {reason}{advice}"))
    })
}

fn heavy_collision_mesh(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    const MANY: usize = 50_000;
    // PyBullet is asked for the triangles: scenery that robots move in.
    let is_concave = |above: Node<'_, '_>| above.attribute("concave") == Some("yes");
    each(urdf, findings, |node, mesh| {
        let count = mesh.facts.ok()?.triangles;
        let is_heavy = mesh.kind == GeometryKind::Collision && count > MANY;
        (is_heavy && !node.ancestors().any(is_concave)).then(|| {
            format!(
                "the collision mesh has {count} triangles; take its convex hull, or a few boxes"
            )
        })
    })
}

fn mesh_names_clash(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let mut by_name: BTreeMap<&std::ffi::OsStr, Vec<(_, &Path)>> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for (node, mesh) in urdf.read_meshes(findings)? {
        if let (GeometryKind::Collision, Some(name)) = (mesh.kind, mesh.file.file_name())
            && seen.insert(mesh.file)
        {
            by_name.entry(name).or_default().push((node, mesh.file));
        }
    }
    for files in by_name.into_values().filter(|files| files.len() > 1) {
        let bytes = |file: &Path| regular::read(file, MAX_DOCUMENT_BYTES).ok();
        let Some(((first_node, first), rest)) = files.split_first() else {
            continue;
        };
        let first = bytes(first);
        if let Some((node, _)) = rest.iter().find(|(_, file)| bytes(file) != first) {
            let message = "another collision mesh in another folder has this file name, and MuJoCo before 4.0 takes one for both; \
                rename one of them";
            let first = urdf.at_attribute(*first_node, "filename", "the other mesh is here");
            urdf.at_attribute(*node, "filename", message).related(first).report(findings);
        }
    }
    Some(())
}

fn mirrored_scale(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.meshes(findings)? {
        let Some(scale) = numbers::<3>(node, "scale") else { continue };
        let is_collision = mesh.geometry == GeometryKind::Collision;
        let message = if scale.contains(&0.0) {
            "a factor of 0 flattens the mesh; write what it is to be multiplied by"
        } else if scale.map(f64::signum).iter().product::<f64>() < 0.0 && is_collision {
            "the scale mirrors the mesh, so that its faces are inside out; export a mirrored mesh"
        } else {
            continue;
        };
        urdf.at_attribute(node, "scale", message).report(findings);
    }
    Some(())
}

fn mesh_in_millimetres(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    /// The shortest mesh, m.
    const SHORTEST: f64 = 0.001;
    const REMOVE: &str = "if it is in metres, remove the scale";
    if !urdf.moves() {
        return Some(());
    }
    let longest = urdf.longest_part(findings)?;
    let meshes = urdf.read_meshes(findings)?;
    let size = |mesh: &NamedMesh| {
        // One mesh may have very many scales.
        let lengths = mesh.facts.ok()?.lengths;
        Some(lengths.component_mul(&Vector3::from(mesh.scale)).norm())
    };
    let sizes: Vec<f64> = meshes.iter().filter_map(|(_, mesh)| size(mesh)).collect();
    let are_most = 2 * sizes.iter().filter(|size| **size < SHORTEST).count() > sizes.len();
    for (node, mesh) in &meshes {
        let Some(size) = size(mesh) else { continue };
        let largest = mesh.scale.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let (what, advice) = if size > longest {
            let unit = "if it is in millimetres, write scale=\"0.001 0.001 0.001\"";
            ("far more than the robot", if largest > 1.0 { REMOVE } else { unit })
        } else if size < SHORTEST && (are_most || has_mass(*node)) {
            let unit = "export it in metres, or write the scale that makes it so";
            ("less than a millimetre", if largest < 1.0 { REMOVE } else { unit })
        } else {
            continue;
        };
        let message = format!("the mesh is {} long, {what}; {advice}", metres(size));
        let is_odd = size < SHORTEST && !are_most;
        let severity = is_odd.then_some(Severity::Warning);
        let finding = urdf.at_attribute(*node, "filename", message);
        Finding { severity, ..finding }.report(findings);
    }
    Some(())
}

/// Whether the link around an element has a mass: one without is a frame, which may have a marker.
fn has_mass(node: Node) -> bool {
    let link = node.ancestors().find(|above| above.tag_name().name() == "link");
    let inertial = link.and_then(|link| link.children().find(|one| one.has_tag_name("inertial")));
    inertial.is_some()
}
