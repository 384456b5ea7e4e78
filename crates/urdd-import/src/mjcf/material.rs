//! Colours, materials and textures.

use std::collections::HashMap;

use super::super::features::{self, Tally};
use super::super::model::Material;
use super::super::refusal::{Fallible, at};
use super::assets::{Assets, Folder};
use super::defaults::{Defaults, MAIN};
use super::element::Element;
use super::fault::MjcfFault;
use super::geom::Geom;
use super::mesh::Meshes;
use super::reading::{Attributes, View};

/// The colour of a shape that names none: the material goes before it.
const GREY: [f64; 4] = [0.5, 0.5, 0.5, 1.0];
/// The first bytes of a PNG.
const PNG: &[u8] = b"\x89PNG";

/// The materials of a model.
pub struct Materials<'d> {
    by_name: HashMap<&'d str, View<'d>>,
    textures: HashMap<&'d str, &'d Element>,
}

impl<'d> Materials<'d> {
    /// The materials and textures that a model defines.
    pub fn of_model(root: &'d Element, defaults: &'d Defaults<'d>) -> Fallible<Self> {
        let mut materials = Materials { by_name: HashMap::new(), textures: HashMap::new() };
        for element in root.sections("asset") {
            match (element.tag.as_str(), element.text("name").or(element.stem())) {
                ("material", Some(name)) => {
                    materials.by_name.insert(name, View::new(element, defaults, MAIN)?);
                }
                ("texture", Some(name)) => {
                    materials.textures.insert(name, element);
                }
                _ => {}
            }
        }
        Ok(materials)
    }

    /// How a shape looks, if it says it.
    pub fn of(
        &self,
        geom: &Geom<'d>,
        meshes: &Meshes<'d>,
        assets: &mut Assets<'_>,
        tally: &mut Tally,
    ) -> Fallible<Option<Material>> {
        let (name, own) = said(geom, meshes);
        let Some(name) = name else {
            return Ok(own.map(|rgba| {
                tally.count(features::COLOURS);
                Material { name: None, rgba: Some(rgba), texture: None }
            }));
        };
        let view = self.by_name.get(name);
        let view =
            view.ok_or_else(|| at(geom.place, MjcfFault::UnknownMaterial(name.to_owned())))?;
        let rgba = match own {
            Some(own) => Some(own),
            None => Some(view.numbers::<4>("rgba")?.unwrap_or([1.0; 4])),
        };
        tally.count(features::COLOURS);
        let layers = view.element.all("layer");
        let mut colours = layers.filter(|layer| matches!(layer.get("role"), Some("rgb" | "rgba")));
        let texture =
            view.text("texture").or_else(|| colours.find_map(|layer| layer.text("texture")));
        let texture = match texture {
            Some(texture) => self.texture(texture, *view, assets, tally)?,
            None => None,
        };
        // A name stands for one look.
        let name = own.is_none().then(|| name.to_owned());
        Ok(Some(Material { name, rgba, texture }))
    }

    /// Whether a shape is transparent.
    pub fn is_clear(&self, geom: &Geom<'d>, meshes: &Meshes<'d>) -> Fallible<bool> {
        let (name, own) = said(geom, meshes);
        let view = name.filter(|_| own.is_none()).and_then(|name| self.by_name.get(name));
        let rgba = match view {
            Some(view) => view.numbers::<4>("rgba")?,
            None => own,
        };
        Ok(rgba.is_some_and(|rgba| rgba[3] == 0.0))
    }

    fn texture(
        &self,
        name: &str,
        material: View<'d>,
        assets: &mut Assets<'_>,
        tally: &mut Tally,
    ) -> Fallible<Option<usize>> {
        let place = material.element.place;
        let texture = self.textures.get(name);
        let texture =
            texture.ok_or_else(|| at(place, MjcfFault::UnknownTexture(name.to_owned())))?;
        let is_flat = texture.get("type") == Some("2d");
        let Some(file) =
            texture.text("file").filter(|_| is_flat && texture.get("gridsize").is_none())
        else {
            tally.count(features::MADE_TEXTURES);
            return Ok(None);
        };
        let found = assets.find(file, Folder::Textures, texture.place)?;
        let key = format!("image {}", found.file.display());
        if let Some(known) = assets.known(&key) {
            tally.count(features::TEXTURES);
            return Ok(Some(known));
        }
        let Some(bytes) = assets.image(&found, PNG, texture.place)? else {
            tally.count(features::MADE_TEXTURES);
            return Ok(None);
        };
        tally.count(features::TEXTURES);
        let stem = found.file.file_stem().unwrap_or_default().to_string_lossy();
        let path = format!("textures/{stem}.png");
        assets.add(&key, &path, bytes.into(), texture.place).map(Some)
    }
}

/// The material of a shape, and the colour that goes before it.
fn said<'d>(geom: &Geom<'d>, meshes: &Meshes<'d>) -> (Option<&'d str>, Option<[f64; 4]>) {
    let name = geom.material.or_else(|| meshes.material(geom.mesh?));
    (name, geom.rgba.filter(|rgba| name.is_none() || *rgba != GREY))
}
