//! How shapes look: colours of materials and of shapes.

use urdd_usd::{Prim, Property, Value};

use super::super::features::{self, Tally};
use super::super::model::Material;
use super::scene::Scene;

/// The longest chain of connections to a value.
const MOST_STEPS: usize = 8;

/// The material by which a shape rubs.
pub fn rubbed(scene: &Scene<'_>, prim: usize) -> Option<usize> {
    let [seen, _, physics] = &scene.material;
    physics[prim].or(seen[prim])
}

/// How a shape looks; `subset` may have a material of its own.
pub fn look(
    scene: &Scene<'_>,
    prim: usize,
    subset: Option<usize>,
    tally: &mut Tally,
) -> Option<Material> {
    let [seen, preview, _] = &scene.material;
    let part = subset.unwrap_or(prim);
    let material = seen[part].or(preview[part]);
    let colour = material.and_then(|material| colour(scene, material, tally));
    if let (Some(material), Some(rgba)) = (material, colour) {
        tally.count(features::COLOURS);
        return Some(Material {
            name: Some(scene.name(material).to_owned()),
            rgba: Some(rgba),
            texture: None,
        });
    }
    let of = scene.prim(prim);
    let first =
        |name: &str| of.value(name).and_then(Value::numbers).filter(|numbers| !numbers.is_empty());
    let &[r, g, b, ..] = first("primvars:displayColor")? else { return None };
    let alpha = first("primvars:displayOpacity").map_or(1.0, |values| values[0]);
    tally.count(features::COLOURS);
    let rgba = [r, g, b, alpha].map(|part| shortest(part).clamp(0.0, 1.0));
    Some(Material { name: None, rgba: Some(rgba), texture: None })
}

fn colour(scene: &Scene<'_>, material: usize, tally: &mut Tally) -> Option<[f64; 4]> {
    let of = scene.prim(material);
    let outputs = ["outputs:surface", "outputs:mdl:surface"];
    let shader = outputs.iter().find_map(|name| scene.target(of, name))?;
    let shader = scene.prim(shader);
    let names = ["inputs:diffuseColor", "inputs:diffuse_color_constant", "inputs:diffuse_tint"];
    let colour = names.iter().find_map(|name| value(scene, shader, name, tally));
    let [r, g, b] = colour?.tuple::<3>()?;
    let opacity = ["inputs:opacity", "inputs:opacity_constant"];
    let opacity = opacity.iter().find_map(|name| value(scene, shader, name, tally));
    let alpha = opacity.and_then(|value| value.number()).unwrap_or(1.0);
    Some([r, g, b, alpha].map(|part| shortest(part).clamp(0.0, 1.0)))
}

/// The value of an input, or of what it is connected to.
fn value(scene: &Scene<'_>, shader: &Prim, name: &str, tally: &mut Tally) -> Option<Value> {
    let mut of: &Property = shader.property(name)?;
    for _ in 0..MOST_STEPS {
        let Some(target) = of.targets.first() else { break };
        let (_, name) = target.split_once('.')?;
        let prim = scene.prim(scene.stage.find(target)?);
        if prim.value("inputs:file").is_some() {
            tally.count(features::TEXTURES);
            return prim
                .value("inputs:fallback")
                .cloned()
                .filter(|value| value.tuple::<3>().is_some())
                .or(of.value.clone());
        }
        match prim.property(name) {
            Some(next) => of = next,
            None => break,
        }
    }
    of.value.clone()
}

/// The shortest decimal that rounds to a number of single precision.
fn shortest(value: f64) -> f64 {
    format!("{}", value as f32).parse().unwrap_or(value)
}
