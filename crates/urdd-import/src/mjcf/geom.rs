//! Shapes, as a model says them, with their colours, materials and textures.

use std::collections::HashMap;

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::assets::{Assets, Folder};
use super::compiler::{Compiler, pose, z_to};
use super::mesh::Meshes;
use super::reading::{Attributes, Defaults, Element, MAIN, View};
use crate::fault::MjcfFault;
use crate::features::{self, Tally};
use crate::model::{Geometry, Material};
use crate::place::{Fallible, Place, at};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GeomKind {
    Plane,
    HeightField,
    Sphere,
    Capsule,
    Ellipsoid,
    Cylinder,
    Box,
    Mesh,
    DistanceField,
}

const KINDS: [(&str, GeomKind); 9] = [
    ("plane", GeomKind::Plane),
    ("hfield", GeomKind::HeightField),
    ("sphere", GeomKind::Sphere),
    ("capsule", GeomKind::Capsule),
    ("ellipsoid", GeomKind::Ellipsoid),
    ("cylinder", GeomKind::Cylinder),
    ("box", GeomKind::Box),
    ("mesh", GeomKind::Mesh),
    ("sdf", GeomKind::DistanceField),
];

impl GeomKind {
    pub fn sizes(self) -> usize {
        match self {
            GeomKind::Sphere => 1,
            GeomKind::Capsule | GeomKind::Cylinder => 2,
            GeomKind::Ellipsoid | GeomKind::Box => 3,
            GeomKind::Plane | GeomKind::HeightField | GeomKind::Mesh | GeomKind::DistanceField => 0,
        }
    }

    /// A primitive of this kind, whose sizes are halves as in MJCF; none of what is no primitive.
    pub fn solid(self, [a, b, c]: [f64; 3]) -> Option<Geometry> {
        Some(match self {
            GeomKind::Sphere => Geometry::Sphere(a),
            GeomKind::Capsule => Geometry::Capsule { radius: a, length: 2.0 * b },
            GeomKind::Ellipsoid => Geometry::Ellipsoid([a, b, c]),
            GeomKind::Cylinder => Geometry::Cylinder { radius: a, length: 2.0 * b },
            GeomKind::Box => Geometry::Box([2.0 * a, 2.0 * b, 2.0 * c]),
            GeomKind::Plane | GeomKind::HeightField | GeomKind::Mesh | GeomKind::DistanceField => {
                return None;
            }
        })
    }

    /// Whether its surface is that of a mesh.
    pub fn is_mesh(self) -> bool {
        matches!(self, GeomKind::Mesh | GeomKind::DistanceField)
    }
}

#[derive(Debug, Clone)]
pub struct Geom<'d> {
    pub name: Option<String>,
    pub kind: GeomKind,
    /// Its frame in its body's. That of a mesh is that of the mesh's file.
    pub pose: Isometry3<f64>,
    /// Radius and half lengths.
    pub size: [f64; 3],
    pub mesh: Option<&'d str>,
    pub fit_scale: f64,
    pub contype: u32,
    pub conaffinity: u32,
    pub group: i64,
    pub mass: Option<f64>,
    pub density: f64,
    pub is_shell: bool,
    /// Sliding, torsional, rolling.
    pub friction: [Option<f64>; 3],
    pub material: Option<&'d str>,
    pub rgba: Option<[f64; 4]>,
    pub place: Place,
}

impl<'d> Geom<'d> {
    /// A `<geom>` in a frame of its body.
    pub fn read(
        view: View<'d>,
        name: Option<String>,
        frame: &Isometry3<f64>,
        compiler: &Compiler,
    ) -> Fallible<Self> {
        let place = view.element.place;
        let words = KINDS.map(|(word, _)| word);
        let kind =
            view.word("type", &words, "a type of geom")?.map_or(GeomKind::Sphere, |k| KINDS[k].1);
        let mesh = view.text("mesh");
        if kind.is_mesh() && mesh.is_none() {
            return Err(at(place, MjcfFault::NoMesh));
        }
        let mut size = view.up_to::<3>("size")?.map(|size| size.unwrap_or(0.0));
        let own = match from_to(view, kind, &mut size)? {
            Some(own) => own,
            None => pose(view, compiler)?,
        };
        let sizes = if mesh.is_some() { 0 } else { kind.sizes() };
        if let Some(wrong) = size[..sizes].iter().position(|size| *size <= 0.0) {
            return Err(at(place, MjcfFault::Size(wrong + 1)));
        }
        let mask = |name| -> Fallible<u32> {
            let bits = view.integer(name)?.unwrap_or(1);
            #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "32 bits")]
            Ok(bits as u32)
        };
        Ok(Geom {
            name,
            kind,
            pose: frame * own,
            size,
            mesh,
            fit_scale: view.number("fitscale")?.unwrap_or(1.0),
            contype: mask("contype")?,
            conaffinity: mask("conaffinity")?,
            group: view.integer("group")?.unwrap_or(0),
            mass: view.number("mass")?,
            density: view.number("density")?.unwrap_or(1000.0),
            is_shell: view.flag("shellinertia")?.unwrap_or(false),
            friction: view.up_to::<3>("friction")?,
            material: view.text("material"),
            rgba: view.numbers::<4>("rgba")?,
            place,
        })
    }

    pub fn is_visual(&self) -> bool {
        self.contype == 0 && self.conaffinity == 0
    }
}

/// The pose of a shape between two points, whose length goes into its sizes.
fn from_to(
    view: View<'_>,
    kind: GeomKind,
    size: &mut [f64; 3],
) -> Fallible<Option<Isometry3<f64>>> {
    let Some((pose, half)) = between(view)? else { return Ok(None) };
    let is_long = matches!(
        kind,
        GeomKind::Capsule | GeomKind::Cylinder | GeomKind::Ellipsoid | GeomKind::Box
    );
    if !is_long || view.text("mesh").is_some() {
        return Err(at(view.element.place, MjcfFault::FromTo));
    }
    match kind {
        GeomKind::Ellipsoid | GeomKind::Box => (size[1], size[2]) = (size[0], half),
        _ => size[1] = half,
    }
    Ok(Some(pose))
}

/// The frame of a `fromto`, whose z points to its first point, and half of its length.
pub fn between(view: View<'_>) -> Fallible<Option<(Isometry3<f64>, f64)>> {
    let Some([a, b, c, d, e, f]) = view.numbers::<6>("fromto")? else { return Ok(None) };
    let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
    let along = Unit::try_new(from - to, 1e-14);
    let along = along.ok_or_else(|| at(view.element.place, MjcfFault::FromTo))?;
    let middle = Translation3::from((from + to) / 2.0);
    Ok(Some((Isometry3::from_parts(middle, z_to(along)), (from - to).norm() / 2.0)))
}

/// The colour of a shape that names none: the material goes before it.
const GREY: [f64; 4] = [0.5, 0.5, 0.5, 1.0];
const PNG: &[u8] = b"\x89PNG";

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
