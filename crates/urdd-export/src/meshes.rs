//! The mesh files that an export references, visual geometry, and which meshes MuJoCo's compiler accepts.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Isometry3, Translation3};

use crate::names::{FileNames, last};
use crate::simplify::simplify_all;
use crate::textures::{Image, Images};
use crate::{Detail, ExportError, Format, Note, Shape, Shapes, Solid, Subject};
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::oriented_box::OrientedBox;
use urdd_geometry::primitives::Primitive;
use urdd_geometry::read::Part;
use urdd_geometry::write::{WriteError, obj, stl};
use urdd_robot::{LinkVisual, RobotError, ShapeKind, SourceShape};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MeshFormat {
    Stl,
    Obj,
}

/// Files by path. Equal content shares one file.
pub(super) struct MeshFiles<'a> {
    subject: &'a Subject<'a>,
    names: FileNames,
    by_content: HashMap<Vec<u8>, String>,
}

impl<'a> MeshFiles<'a> {
    pub fn new(subject: &'a Subject<'a>) -> Self {
        MeshFiles { subject, names: FileNames::default(), by_content: HashMap::new() }
    }

    /// Adds a mesh and returns its file's path, relative to the text.
    pub fn add(
        &mut self,
        link: usize,
        what: &str,
        mesh: Mesh,
        format: MeshFormat,
    ) -> Result<String, ExportError> {
        let parts = [Part::from(mesh)];
        let (ending, bytes) = match format {
            MeshFormat::Stl => ("stl", stl(&parts)),
            MeshFormat::Obj => ("obj", obj(&parts)),
        };
        let bytes = bytes.map_err(self.fault(link))?;
        Ok(self.file(link, what, ending, bytes))
    }

    /// Adds visual geometry as OBJ, with its texture. Returns the paths of both.
    pub fn add_look(
        &mut self,
        link: usize,
        place: usize,
        look: Look,
    ) -> Result<(String, Option<String>), ExportError> {
        let what = format!("visual_{place}");
        let Some(image) = look.image else {
            return Ok((self.add(link, &what, look.part.mesh, MeshFormat::Obj)?, None));
        };
        let image =
            self.file(link, &format!("texture_{place}"), image.ending, image.bytes.to_vec());
        let mut bytes = Vec::new();
        // MJCF names the texture itself.
        if self.subject.format != Format::Mjcf {
            let library = format!("newmtl texture\nKa 1 1 1\nKd 1 1 1\nmap_Kd {}\n", last(&image));
            let library =
                self.file(link, &format!("material_{place}"), "mtl", library.into_bytes());
            bytes = format!("mtllib {}\nusemtl texture\n", last(&library)).into_bytes();
        }
        bytes.extend(obj(&[look.part]).map_err(self.fault(link))?);
        Ok((self.file(link, &what, "obj", bytes), Some(image)))
    }

    /// Adds a file of text that USD reads, and returns its path.
    pub fn add_text(&mut self, link: usize, what: &str, text: String) -> String {
        self.file(link, what, "usda", text.into_bytes())
    }

    /// Adds the images of looks, and returns their paths.
    pub fn add_images(&mut self, link: usize, looks: &[Look]) -> Vec<Option<String>> {
        let add = |(place, look): (usize, &Look)| {
            let image = look.image.as_ref()?;
            let what = format!("texture_{place}");
            Some(self.file(link, &what, image.ending, image.bytes.to_vec()))
        };
        looks.iter().enumerate().map(add).collect()
    }

    fn fault(&self, link: usize) -> impl FnOnce(WriteError) -> ExportError + use<> {
        let link = self.subject.links[link].clone();
        |error| ExportError::Mesh { link, error }
    }

    fn file(&mut self, link: usize, what: &str, ending: &str, bytes: Vec<u8>) -> String {
        if let Some(path) = self.by_content.get(&bytes) {
            return path.clone();
        }
        let name = self.names.of(&format!("{}_{what}", self.subject.links[link]));
        let folder = &self.subject.options.mesh_folder;
        let slash = if folder.is_empty() { "" } else { "/" };
        let path = format!("{folder}{slash}{name}.{ending}");
        self.by_content.insert(bytes, path.clone());
        path
    }

    /// All files, sorted by path.
    pub fn into_files(self) -> Vec<(String, Vec<u8>)> {
        let files = self.by_content.into_iter();
        let mut files: Vec<_> = files.map(|(bytes, path)| (path, bytes)).collect();
        files.sort();
        files
    }
}

/// Visual geometry of one colour, or of one texture and its image.
pub(super) struct Look {
    pub part: Part,
    image: Option<Image>,
}

pub(super) struct Looks {
    pub meshes: Vec<Vec<Look>>,
    /// Those of the source, where its shapes are asked for.
    pub primitives: Vec<Vec<Painted>>,
}

/// The visual geometry of all links, its meshes simplified where that is asked for.
pub(super) fn looks(subject: &Subject, notes: &mut Vec<Note>) -> Result<Looks, ExportError> {
    let mut looks: Vec<Vec<Look>> = subject.links.iter().map(|_| Vec::new()).collect();
    let none = || subject.links.iter().map(|_| Vec::new()).collect();
    let detail = subject.options.chosen.visuals;
    if detail == Detail::Nothing {
        return Ok(Looks { meshes: looks, primitives: none() });
    }
    let (visuals, primitives) = match subject.shapes {
        Shapes::Source => source_visuals(subject)?,
        Shapes::Kind(_) => (subject.robot.visuals()?, none()),
    };
    let mut images = Images::new(subject);
    let mut textured: HashMap<usize, Vec<Part>> = HashMap::new();
    for visual in subject.robot.textured_visuals()? {
        textured.entry(visual.link).or_default().extend(visual.parts);
    }
    for visual in visuals {
        let Some(of_link) = looks.get_mut(subject.layout.body(visual.link)) else { continue };
        let textured = textured.remove(&visual.link).unwrap_or_default();
        for (mut part, image) in images.painted(visual.parts, textured)? {
            if let Some(place) = subject.layout.content.get(visual.link) {
                part.mesh.transform(&place.pose.to_homogeneous());
            }
            let name = |part: &Part| part.texture.as_ref().map(|texture| texture.name.clone());
            let is_same = |known: &Part| known.color == part.color && name(known) == name(&part);
            match of_link.iter_mut().find(|look| is_same(&look.part)) {
                Some(Look { part: known, .. }) => {
                    known.mesh.append(&part.mesh);
                    if let Some((known, new)) = known.texture.as_mut().zip(part.texture) {
                        known.uv.extend(new.uv);
                    }
                }
                None => of_link.push(Look { part, image }),
            }
        }
    }
    notes.extend(images.notes());
    let parts = looks.iter_mut().flatten().map(|look| &mut look.part);
    notes.extend(simplify_all(parts.collect(), detail));
    let place = |_, pose: &Isometry3<f64>, of: &mut Painted| of.pose = pose * of.pose;
    let primitives = subject.layout.gather(primitives, place);
    Ok(Looks { meshes: looks, primitives })
}

/// A primitive of visual geometry, in its link's frame.
pub(super) struct Painted {
    pub pose: Isometry3<f64>,
    pub primitive: Primitive,
    pub color: Option<[f64; 4]>,
    pub name: Option<String>,
}

/// The meshes of links, and their primitives in link order. A link without visual elements has its plain mesh.
fn source_visuals(subject: &Subject) -> Result<(Vec<LinkVisual>, Vec<Vec<Painted>>), RobotError> {
    let found = subject.robot.source_elements(GeometryKind::Visual)?;
    let mut primitives: Vec<Vec<Painted>> = subject.links.iter().map(|_| Vec::new()).collect();
    let mut meshes: BTreeMap<usize, Vec<Part>> = BTreeMap::new();
    let colors = Colors::of(&subject.described);
    for of in found.usable {
        let link = subject.described.links.get(of.link);
        let Some(visual) = link.and_then(|link| link.visual.get(of.element)) else { continue };
        let color = colors.get(visual.material.as_ref());
        let color = color.map(|rgba| rgba.map(|part| part.clamp(0.0, 1.0)));
        match of.shape {
            SourceShape::Primitive(pose, primitive) => {
                let name = visual.name.clone();
                primitives[of.link].push(Painted { pose, primitive, color, name });
            }
            SourceShape::Mesh(parts) => {
                let parts =
                    parts.into_iter().map(|part| Part { color: part.color.or(color), ..part });
                meshes.entry(of.link).or_default().extend(parts);
            }
        }
    }
    let is_bare = |link: &usize| primitives[*link].is_empty() && !meshes.contains_key(link);
    let bare: Vec<usize> = (0..subject.links.len()).filter(is_bare).collect();
    if !bare.is_empty() {
        let plain = subject.robot.visuals()?.into_iter();
        let plain = plain.filter(|visual| bare.contains(&visual.link));
        meshes.extend(plain.map(|visual| (visual.link, visual.parts)));
    }
    let meshes = meshes.into_iter().map(|(link, parts)| LinkVisual { link, parts }).collect();
    Ok((meshes, primitives))
}

/// Smaller areas vanish, m²: well above MuJoCo's mjMINVAL of 1e-15.
const SMALLEST_AREA: f64 = 1e-14;

/// Smaller volumes are treated as flat, m³: well above mjMINVAL too.
const SMALLEST_VOLUME: f64 = 1e-13;

/// A shape that is thinner than this part of its greatest coordinate is treated as flat: binary32 has 24 bits.
const THINNEST: f64 = 1.0 / 1_048_576.0;

/// The least number of vertices of a mesh.
const VERTICES: usize = 4;

/// The most faces, and the largest coordinate, of an STL. An OBJ has no such limits.
const STL_FACES: usize = 200_000;
const STL_REACH: f64 = 1_073_741_824.0;

/// Completes a visual mesh, in binary32: one of fewer than four vertices gets another that no triangle uses, in its
/// middle. False if it has no area.
pub fn complete(mesh: &mut Mesh) -> bool {
    mesh.round_to_f32();
    if mesh.area() < SMALLEST_AREA {
        return false;
    }
    if let [first, .., last] = mesh.vertices[..] {
        let middle = [0, 1, 2].map(|k| f64::midpoint(first[k], last[k]));
        mesh.vertices.resize(mesh.vertices.len().max(VERTICES), middle);
    }
    true
}

/// Whether a convex mesh has no volume, once its coordinates are binary32.
pub fn is_flat(mesh: &Mesh) -> bool {
    let mut rounded = mesh.clone();
    rounded.round_to_f32();
    let Ok(hull) = ConvexHull::new(&rounded.vertices) else { return true };
    let (volume, area) = (hull.mesh().signed_volume(), hull.mesh().area());
    hull.is_flat() || volume < SMALLEST_VOLUME || 2.0 * volume < THINNEST * reach(mesh) * area
}

/// Whether MuJoCo reads a mesh from an STL.
pub fn fits_stl(mesh: &Mesh) -> bool {
    mesh.triangles.len() <= STL_FACES && reach(mesh) <= STL_REACH
}

/// The greatest coordinate, m.
fn reach(mesh: &Mesh) -> f64 {
    mesh.vertices.as_flattened().iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The bounding boxes of a robot's shapes, if these are meshes.
pub(crate) struct FlatShapes {
    boxes: Vec<Vec<Shape>>,
    links: Vec<String>,
}

impl FlatShapes {
    pub fn new(subject: &Subject) -> Result<Self, ExportError> {
        let boxes = match subject.shapes {
            Shapes::Kind(ShapeKind::Pieces) => subject.shapes_of(ShapeKind::PieceBoxes)?,
            Shapes::Kind(ShapeKind::Hulls) => subject.shapes_of(ShapeKind::Boxes)?,
            _ => Vec::new(),
        };
        Ok(FlatShapes { boxes, links: subject.links.clone() })
    }

    /// The box of a flat mesh, the link's piece of this number or another, and a note.
    pub fn cuboid(
        &self,
        mesh: &Mesh,
        piece: usize,
        link: usize,
        notes: &mut Vec<Note>,
    ) -> (Isometry3<f64>, Primitive) {
        let thickness = "0.000002";
        notes.push(Note::Flat { link: self.links[link].clone(), thickness });
        let mut boxes = self.boxes.get(link).into_iter().flatten();
        match boxes.find(|of| of.number == piece).map(|found| &found.solid) {
            Some(Solid::Primitive(pose, primitive)) => (*pose, *primitive),
            _ => around(mesh),
        }
    }
}

/// The smallest box around a mesh; along the axes where its points are on a line.
fn around(mesh: &Mesh) -> (Isometry3<f64>, Primitive) {
    match ConvexHull::new(&mesh.vertices) {
        Ok(hull) => {
            let of = OrientedBox::around(&hull);
            let pose = Isometry3::from_parts(Translation3::from(of.centre), of.rotation);
            (pose, Primitive::Box(of.half_extents))
        }
        Err(_) => {
            let (centre, half) = mesh.bounds().map_or(([0.0; 3], [0.0; 3]), |of| {
                let half = of.size().map(|side| side / 2.0);
                ([0, 1, 2].map(|k| of.min[k] + half[k]), half)
            });
            (Isometry3::from(Translation3::from(centre)), Primitive::Box(half))
        }
    }
}
