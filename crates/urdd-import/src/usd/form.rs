//! What the shapes of USD are in a model: primitives, meshes as triangles, and how they look.

use std::collections::HashMap;
use std::ops::Range;

use nalgebra::{
    Isometry3, Matrix2, Matrix2x3, Matrix3, Rotation2, Translation3, UnitQuaternion, Vector2,
    Vector3,
};
use urdd_directory::account::AccountError;
use urdd_geometry::mesh::Bounds;
use urdd_geometry::{Mesh, primitives};
use urdd_kinematics::rotation::from_z;
use urdd_usd::{Authored, Prim, Property, Value};

use super::scene::{Scene, number, word};
use crate::features::{self, Tally};
use crate::graph::cone;
use crate::model::{Geometry, Material};
use crate::place::{Fallible, Placing};

/// Two scales that differ by less are one: those of single precision.
const NEAR: f64 = 1e-5;
/// A shape in the frame of its prim.
#[derive(Debug)]
pub enum Form {
    /// Where it is there, and what it is.
    Plain(Isometry3<f64>, Geometry),
    Meshed(Mesh),
    Nothing,
}

/// A shape that is not a mesh, stretched.
pub fn form(of: &Prim, stretch: &Matrix3<f64>, tally: &mut Tally) -> Form {
    let value = |name: &str, none: f64| number(of, name).unwrap_or(none);
    let radius_name = if of.type_name.ends_with('1') { "radiusTop" } else { "radius" };
    let radius = |none: f64| value(radius_name, none);
    let is_straight = stretch.clone_owned() == Matrix3::from_diagonal(&stretch.diagonal());
    let scale = stretch.diagonal().abs();
    let axis = match word(of, "axis") {
        Some("X") => 0,
        Some("Y") => 1,
        _ => 2,
    };
    let along = from_z(&Vector3::ith(axis, 1.0));
    let pose = Isometry3::from_parts(Translation3::identity(), along);
    let [a, b] = [scale[(axis + 1) % 3], scale[(axis + 2) % 3]];
    let is_round = is_straight && (a - b).abs() <= NEAR * a.max(b);
    let is_even = is_round && (a - scale[axis]).abs() <= NEAR * a.max(scale[axis]);
    // As a mesh along z, which is turned, then stretched.
    let stretched = |mut mesh: Mesh, along: &UnitQuaternion<f64>| {
        mesh.transform(&(stretch * along.to_rotation_matrix().matrix()).to_homogeneous());
        Form::Meshed(mesh)
    };
    let (still, unturned) = (Isometry3::identity(), UnitQuaternion::identity());
    match &*of.type_name {
        "Cube" => {
            let size = value("size", 2.0);
            tally.count(features::BOXES);
            match is_straight {
                true => Form::Plain(still, Geometry::Box((scale * size).into())),
                false => stretched(primitives::cuboid([size; 3]), &unturned),
            }
        }
        "Sphere" => {
            let radius = radius(1.0);
            tally.count(if is_even { features::BOXES } else { features::ELLIPSOIDS });
            match (is_even, is_straight) {
                (true, _) => Form::Plain(still, Geometry::Sphere(radius * scale.x)),
                (_, true) => Form::Plain(still, Geometry::Ellipsoid((scale * radius).into())),
                _ => stretched(primitives::sphere(radius), &unturned),
            }
        }
        "Cylinder" | "Cylinder_1" => {
            let (radius, height) = (radius(1.0), value("height", 2.0));
            let length = height * scale[axis];
            tally.count(features::BOXES);
            match is_round {
                true => Form::Plain(pose, Geometry::Cylinder { radius: radius * a, length }),
                false => stretched(primitives::cylinder(radius, height), &along),
            }
        }
        "Capsule" | "Capsule_1" => {
            let (radius, height) = (radius(0.5), value("height", 1.0));
            let length = height * scale[axis];
            tally.count(features::CAPSULES);
            match is_even {
                true => Form::Plain(pose, Geometry::Capsule { radius: radius * a, length }),
                false => stretched(primitives::capsule(radius, height), &along),
            }
        }
        "Cone" => {
            let (radius, height) = (radius(1.0), value("height", 2.0));
            tally.count(features::CONES);
            let mut mesh = cone();
            mesh.transform(
                &Matrix3::from_diagonal(&Vector3::new(radius, radius, height)).to_homogeneous(),
            );
            stretched(mesh, &along)
        }
        "Plane" => {
            tally.count(features::SURFACES);
            Form::Nothing
        }
        _ => {
            tally.count(features::OTHER_SHAPES);
            Form::Nothing
        }
    }
}

/// The box around a mesh, or what is made of its middle.
pub fn bounding(mesh: &Mesh, of: impl Fn([f64; 3]) -> Geometry) -> Form {
    let Some(bounds) = mesh.bounds() else { return Form::Nothing };
    Form::Plain(Translation3::from(middle(&bounds)).into(), of(bounds.size()))
}

fn middle(bounds: &Bounds) -> Vector3<f64> {
    (Vector3::from(bounds.min) + Vector3::from(bounds.max)) / 2.0
}

/// How far a mesh is from the middle of its box.
pub fn reach(mesh: &Mesh) -> f64 {
    let middle = mesh.bounds().map_or_else(Vector3::zeros, |bounds| middle(&bounds));
    mesh.vertices.iter().map(|point| (Vector3::from(*point) - middle).norm()).fold(0.0, f64::max)
}

/// A part of a mesh is large if it has more than one in so many triangles.
const LARGE: usize = 8;

/// Why a mesh is left out.
pub type Problem = &'static str;

/// Triangles of a mesh, each with the face that it is part of, and its corners in the list of those of faces.
pub struct Faces {
    pub mesh: Mesh,
    pub of_triangle: Vec<u32>,
    corners: Vec<[u32; 3]>,
}

/// Reads a mesh. Faces of more corners become fans; points are moved by a matrix, whose mirrors turn faces round.
pub fn faces(
    scene: &Scene<'_>,
    prim: usize,
    linear: &Matrix3<f64>,
) -> Fallible<Result<Faces, Problem>> {
    let numbers = |name| Ok(scene.value(prim, name)?.and_then(Value::numbers).unwrap_or_default());
    let [points, counts, indices] =
        [numbers("points")?, numbers("faceVertexCounts")?, numbers("faceVertexIndices")?];
    let is_left = word(scene.prim(prim), "orientation") == Some("leftHanded");
    Ok(triangulated([points, counts, indices], is_left, linear))
}

fn triangulated(
    [points, counts, indices]: [&[f64]; 3],
    is_left: bool,
    linear: &Matrix3<f64>,
) -> Result<Faces, Problem> {
    if points.is_empty() {
        return Err("it has no points");
    }
    let (triples, rest) = points.as_chunks::<3>();
    if !rest.is_empty() {
        return Err("its points do not have three numbers each");
    }
    let vertices: Vec<[f64; 3]> =
        triples.iter().map(|point| (linear * Vector3::from(*point)).into()).collect();
    let is_turned = is_left != (linear.determinant() < 0.0);
    let (mut triangles, mut of_triangle, mut corners) = (Vec::new(), Vec::new(), Vec::new());
    let mut first = 0;
    for (face, count) in counts.iter().enumerate() {
        let count = *count as usize;
        let own = indices.get(first..).and_then(|rest| rest.get(..count));
        let own = own.ok_or("its faces have more corners than there are")?;
        if own.iter().any(|corner| !(0.0..vertices.len() as f64).contains(corner)) {
            return Err("its faces name points that it does not have");
        }
        for second in 1..count.saturating_sub(1) {
            let [b, c] = if is_turned { [second + 1, second] } else { [second, second + 1] };
            triangles.push([0, b, c].map(|corner| own[corner] as u32));
            corners.push([0, b, c].map(|corner| (first + corner) as u32));
            of_triangle.push(face as u32);
        }
        first += count;
    }
    Ok(Faces { mesh: Mesh { vertices, triangles }, of_triangle, corners })
}

impl Faces {
    /// The places of the triangles of a face.
    pub fn of_face(&self, face: u32) -> Range<usize> {
        let before = |least: u64| self.of_triangle.partition_point(|of| u64::from(*of) < least);
        before(face.into())..before(u64::from(face) + 1)
    }

    /// Some of the triangles.
    pub fn part(&self, places: &[usize]) -> Mesh {
        let triangles: Vec<[u32; 3]> = places.iter().map(|at| self.mesh.triangles[*at]).collect();
        if triangles.len() > self.mesh.triangles.len() / LARGE {
            let mut mesh = Mesh { vertices: self.mesh.vertices.clone(), triangles };
            mesh.drop_unused_vertices();
            return mesh;
        }
        // Of a small part, its own vertices alone are looked at: there may be many parts.
        let mut used = triangles.concat();
        used.sort_unstable();
        used.dedup();
        let place = |of: u32| used.binary_search(&of).unwrap_or_default() as u32;
        let vertices = used.iter().map(|of| self.mesh.vertices[*of as usize]).collect();
        Mesh { vertices, triangles: triangles.iter().map(|of| of.map(place)).collect() }
    }

    /// The same with places in an image, one for each vertex; none if the mesh does not say them.
    pub fn painted(
        &self,
        scene: &Scene<'_>,
        prim: usize,
        image: &Image,
        places: &[usize],
    ) -> Fallible<Option<(Mesh, Vec<[f64; 2]>)>> {
        let name = format!("primvars:{}", image.primvar);
        let numbers = |name: &str| Ok(scene.value(prim, name)?.and_then(Value::numbers));
        let Some(pairs) = numbers(&name)? else { return Ok(None) };
        let indices = numbers(&format!("{name}:indices"))?;
        let of = scene.prim(prim).property(&name);
        let kind = of.and_then(|of| of.field("interpolation")?.word()).unwrap_or("constant");
        Ok(self.placed(image, (pairs, indices, kind), places))
    }

    fn placed(
        &self,
        image: &Image,
        (pairs, indices, kind): (&[f64], Option<&[f64]>, &str),
        places: &[usize],
    ) -> Option<(Mesh, Vec<[f64; 2]>)> {
        let (pairs, _) = pairs.as_chunks::<2>();
        let (mut mesh, mut uv) = (Mesh::default(), Vec::new());
        let mut known: HashMap<(u32, usize), u32> = HashMap::new();
        for at in places.iter().copied() {
            let (triangle, face) = (&self.mesh.triangles[at], self.of_triangle[at]);
            let mut corners = [0; 3];
            for side in 0..3 {
                let place = match kind {
                    "faceVarying" => self.corners[at][side],
                    "vertex" | "varying" => triangle[side],
                    "uniform" => face,
                    _ => 0,
                } as usize;
                let place =
                    indices.map_or(Some(place), |all| all.get(place).map(|of| *of as usize));
                let place = place?;
                corners[side] = match known.get(&(triangle[side], place)) {
                    Some(known) => *known,
                    None => {
                        let [u, v] = *pairs.get(place)?;
                        let pair = image.moved * Vector3::new(u, v, 1.0);
                        uv.push(pair.iter().all(|of| of.is_finite()).then(|| pair.into())?);
                        mesh.vertices.push(self.mesh.vertices[triangle[side] as usize]);
                        known.insert((triangle[side], place), uv.len() as u32 - 1);
                        uv.len() as u32 - 1
                    }
                };
            }
            mesh.triangles.push(corners);
        }
        Some((mesh, uv))
    }
}

/// The longest chain of connections to a value.
const MOST_STEPS: usize = 8;

pub struct Image {
    pub file: String,
    /// The primvar that says where it is.
    pub primvar: String,
    /// From that, with 1 as its third number, to places in the image.
    pub moved: Matrix2x3<f64>,
    /// What the mesh looks like with it.
    pub rgba: [f64; 4],
}

/// The material by which a shape rubs.
pub fn rubbed(scene: &Scene<'_>, prim: usize) -> Option<usize> {
    let [seen, _, physics] = &scene.material;
    physics[prim].or(seen[prim])
}

/// How a shape looks, without and with an image; `subset` may have a material of its own.
pub fn look(
    scene: &Scene<'_>,
    prim: usize,
    subset: Option<usize>,
    tally: &mut Tally,
) -> Fallible<(Option<Material>, Option<Image>)> {
    let [seen, preview, _] = &scene.material;
    let part = subset.unwrap_or(prim);
    let material = seen[part].or(preview[part]);
    let look = material.map(|material| of_material(scene, material)).transpose()?;
    let (rgba, image) = look.unwrap_or_default();
    if let (Some(material), true) = (material, rgba.is_some() || image.is_some()) {
        tally.count(features::COLOURS);
        let name = Some(scene.name(material)?.to_owned());
        return Ok((Some(Material { name, rgba, texture: None }), image));
    }
    let first = |name| Ok(scene.value(prim, name)?.and_then(Value::numbers).unwrap_or_default());
    let &[r, g, b, ..] = first("primvars:displayColor")? else { return Ok((None, None)) };
    let alpha = first("primvars:displayOpacity")?.first().copied().unwrap_or(1.0);
    tally.count(features::COLOURS);
    let rgba = Some(shown([r, g, b], alpha));
    Ok((Some(Material { name: None, rgba, texture: None }), None))
}

/// The colour of a material, and its image.
fn of_material(scene: &Scene<'_>, material: usize) -> Fallible<(Option<[f64; 4]>, Option<Image>)> {
    let (mut shader, place) = (None, scene.place(material));
    for name in ["outputs:surface", "outputs:mdl:surface"] {
        shader = shader.or(scene.target(material, name)?);
    }
    let Some(shader) = shader else { return Ok((None, None)) };
    let source = |of: usize, name: &str| source(scene, of, name).at(place);
    let sources = |names: &[&str]| {
        let found = names.iter().map(|name| source(shader, name));
        found.filter_map(Result::transpose).next().transpose()
    };
    let opacity = sources(&["inputs:opacity", "inputs:opacity_constant"])?;
    let alpha = opacity.and_then(|(_, of)| of.value()?.number()).unwrap_or(1.0);
    let rgba = shown([1.0; 3], alpha);
    let colour =
        sources(&["inputs:diffuseColor", "inputs:diffuse_color_constant", "inputs:diffuse_tint"])?;
    let colour_of = |value: Option<Authored<'_>>| Some(shown(value?.tuple::<3>()?, alpha));
    let file = |of: usize, name: &str| {
        let Some((_, file)) = source(of, name)? else { return Ok(None) };
        Ok(text(scene, file).at(place)?.filter(|file| !file.is_empty()))
    };
    if let Some((texture, _)) = colour
        && let Some(file) = file(texture, "inputs:file")?
    {
        let (primvar, moved) = placing(scene, texture).at(place)?;
        let image = Image { file, primvar, moved, rgba };
        let own = scene.prim(shader).value("inputs:diffuseColor");
        let fallback = scene.prim(texture).value("inputs:fallback");
        return Ok((colour_of(fallback.or(own)), Some(image)));
    }
    let rgba_of = colour.and_then(|(_, of)| colour_of(of.value()));
    let image = file(shader, "inputs:diffuse_texture")?;
    let (primvar, moved) = placing(scene, shader).at(place)?;
    Ok((rgba_of, image.map(|file| Image { file, primvar, moved, rgba })))
}

/// The primvar by which a texture is placed, and what moves it.
fn placing(scene: &Scene<'_>, texture: usize) -> Result<(String, Matrix2x3<f64>), AccountError> {
    let mut moved = Matrix2x3::identity();
    let mut of = source(scene, texture, "inputs:st")?.map(|(prim, _)| prim);
    if let Some(turned) = of.filter(|of| scene.prim(*of).property("inputs:in").is_some()) {
        let own = scene.prim(turned);
        let pair = |name: &str| own.value(name).and_then(Authored::tuple::<2>).map(Vector2::from);
        let angle = number(own, "inputs:rotation").unwrap_or(0.0).to_radians();
        let scale = Matrix2::from_diagonal(&pair("inputs:scale").unwrap_or(Vector2::repeat(1.0)));
        let turn = Rotation2::new(angle).into_inner() * scale;
        let shift = pair("inputs:translation").unwrap_or_default();
        moved = Matrix2x3::from_columns(&[turn.column(0).into(), turn.column(1).into(), shift]);
        of = source(scene, turned, "inputs:in")?.map(|(prim, _)| prim);
    }
    let name = of.map(|of| source(scene, of, "inputs:varname")).transpose()?.flatten();
    let name = name.map(|(_, of)| text(scene, of)).transpose()?.flatten();
    Ok((name.unwrap_or_else(|| "st".to_owned()), moved))
}

/// The text that a property says.
fn text(scene: &Scene<'_>, of: &Property) -> Result<Option<String>, AccountError> {
    let value = of.value().map(|value| value.take(&scene.account)).transpose()?;
    Ok(value.and_then(Value::text).map(ToString::to_string))
}

/// What an input is connected to in the end, through others: the prim and its property.
fn source<'s>(
    scene: &Scene<'s>,
    shader: usize,
    name: &str,
) -> Result<Option<(usize, &'s Property)>, AccountError> {
    let Some(own) = scene.prim(shader).property(name) else { return Ok(None) };
    let mut of = (shader, own);
    for _ in 0..MOST_STEPS {
        let Some(target) = of.1.targets().first() else { break };
        let found = scene.stage.find(target, &scene.account)?;
        let Some((prim, (_, name))) = found.zip(target.split_once('.')) else { return Ok(None) };
        match scene.prim(prim).property(name) {
            Some(next) => of = (prim, next),
            None => break,
        }
    }
    Ok(Some(of))
}

/// A colour of light as one of a screen (sRGB), which URDF has; to 6 digits, which single precision gives.
fn shown([r, g, b]: [f64; 3], alpha: f64) -> [f64; 4] {
    let screen = |value: f64| match value.clamp(0.0, 1.0) {
        value if value <= 0.0031308 => value * 12.92,
        value => 1.055 * value.powf(1.0 / 2.4) - 0.055,
    };
    [screen(r), screen(g), screen(b), alpha.clamp(0.0, 1.0)].map(|part| (part * 1e6).round() / 1e6)
}
