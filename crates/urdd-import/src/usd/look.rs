//! How shapes look: colours and images of materials, and colours of shapes.

use nalgebra::{Matrix2, Matrix2x3, Rotation2, Vector2};
use urdd_usd::{Prim, Property, Value};

use super::super::features::{self, Tally};
use super::super::model::Material;
use super::scene::{Scene, number};

/// The longest chain of connections to a value.
const MOST_STEPS: usize = 8;

/// An image on a mesh.
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
) -> (Option<Material>, Option<Image>) {
    let [seen, preview, _] = &scene.material;
    let part = subset.unwrap_or(prim);
    let material = seen[part].or(preview[part]);
    let (rgba, image) = material.map_or((None, None), |material| of_material(scene, material));
    if let (Some(material), true) = (material, rgba.is_some() || image.is_some()) {
        tally.count(features::COLOURS);
        let name = Some(scene.name(material).to_owned());
        return (Some(Material { name, rgba, texture: None }), image);
    }
    let of = scene.prim(prim);
    let first =
        |name: &str| of.value(name).and_then(Value::numbers).filter(|numbers| !numbers.is_empty());
    let Some(&[r, g, b, ..]) = first("primvars:displayColor") else { return (None, None) };
    let alpha = first("primvars:displayOpacity").map_or(1.0, |values| values[0]);
    tally.count(features::COLOURS);
    (Some(Material { name: None, rgba: Some(shown([r, g, b], alpha)), texture: None }), None)
}

/// The colour of a material, and its image.
fn of_material(scene: &Scene<'_>, material: usize) -> (Option<[f64; 4]>, Option<Image>) {
    let of = scene.prim(material);
    let outputs = ["outputs:surface", "outputs:mdl:surface"];
    let Some(shader) = outputs.iter().find_map(|name| scene.target(of, name)) else {
        return (None, None);
    };
    let shader = scene.prim(shader);
    let sources = |names: &[&str]| names.iter().find_map(|name| source(scene, shader, name));
    let opacity = sources(&["inputs:opacity", "inputs:opacity_constant"]);
    let alpha = opacity.and_then(|(_, of)| of.value.as_ref()?.number()).unwrap_or(1.0);
    let rgba = shown([1.0; 3], alpha);
    let colour =
        sources(&["inputs:diffuseColor", "inputs:diffuse_color_constant", "inputs:diffuse_tint"]);
    let colour_of = |value: Option<&Value>| Some(shown(value?.tuple::<3>()?, alpha));
    let file = |of: &Prim, name: &str| {
        let file = source(scene, of, name)?.1.value.as_ref()?.text()?;
        Some(file.to_string()).filter(|file| !file.is_empty())
    };
    if let Some((texture, _)) = colour
        && let Some(file) = file(texture, "inputs:file")
    {
        let (primvar, moved) = placing(scene, texture);
        let image = Image { file, primvar, moved, rgba };
        let own = shader.value("inputs:diffuseColor");
        return (colour_of(texture.value("inputs:fallback").or(own)), Some(image));
    }
    let rgba_of = colour.and_then(|(_, of)| colour_of(of.value.as_ref()));
    let image = file(shader, "inputs:diffuse_texture");
    let (primvar, moved) = placing(scene, shader);
    (rgba_of, image.map(|file| Image { file, primvar, moved, rgba }))
}

/// The primvar by which a texture is placed, and what moves it.
fn placing(scene: &Scene<'_>, texture: &Prim) -> (String, Matrix2x3<f64>) {
    let mut moved = Matrix2x3::identity();
    let mut of = source(scene, texture, "inputs:st").map(|(prim, _)| prim);
    if let Some(turned) = of.filter(|of| of.property("inputs:in").is_some()) {
        let pair = |name: &str| turned.value(name).and_then(Value::tuple::<2>).map(Vector2::from);
        let angle = number(turned, "inputs:rotation").unwrap_or(0.0).to_radians();
        let scale = Matrix2::from_diagonal(&pair("inputs:scale").unwrap_or(Vector2::repeat(1.0)));
        let turn = Rotation2::new(angle).into_inner() * scale;
        let shift = pair("inputs:translation").unwrap_or_default();
        moved = Matrix2x3::from_columns(&[turn.column(0).into(), turn.column(1).into(), shift]);
        of = source(scene, turned, "inputs:in").map(|(prim, _)| prim);
    }
    let name = of.and_then(|of| source(scene, of, "inputs:varname")?.1.value.as_ref()?.text());
    (name.map_or("st", |name| name).to_owned(), moved)
}

/// What an input is connected to in the end, through others: the prim and its property.
fn source<'s>(scene: &Scene<'s>, shader: &'s Prim, name: &str) -> Option<(&'s Prim, &'s Property)> {
    let mut of = (shader, shader.property(name)?);
    for _ in 0..MOST_STEPS {
        let Some(target) = of.1.targets.first() else { break };
        let (_, name) = target.split_once('.')?;
        let prim = scene.prim(scene.stage.find(target)?);
        match prim.property(name) {
            Some(next) => of = (prim, next),
            None => break,
        }
    }
    Some(of)
}

/// A colour of light as one of a screen (sRGB), which URDF has; to 6 digits, which single precision gives.
fn shown([r, g, b]: [f64; 3], alpha: f64) -> [f64; 4] {
    let screen = |value: f64| match value.clamp(0.0, 1.0) {
        value if value <= 0.0031308 => value * 12.92,
        value => 1.055 * value.powf(1.0 / 2.4) - 0.055,
    };
    [screen(r), screen(g), screen(b), alpha.clamp(0.0, 1.0)].map(|part| (part * 1e6).round() / 1e6)
}
