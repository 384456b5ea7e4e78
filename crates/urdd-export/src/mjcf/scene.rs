//! A scene for the robot: floor and light; and where the robot stands on the floor.

use nalgebra::{Isometry3, Point3};

use super::super::element::Element;
use super::super::error::ExportError;
use super::super::options::MjcfOptions;
use super::super::output::Files;
use super::super::subject::Subject;
use urdd_robot::{LinkShape, Solid};
use urdd_xml::number::{number, numbers};

/// Where the robot stands.
pub(super) struct Stand {
    /// Height of a free base in the default configuration, m: the lowest shape touches z = 0. 0 without a free base.
    pub base_height: f64,
    /// Height of the floor, m: 0 for a free base, and otherwise at most as high as the lowest shape.
    floor: f64,
    /// All shapes, where they are needed.
    shapes: Vec<LinkShape>,
}

impl Stand {
    pub fn new(subject: &Subject, options: &MjcfOptions) -> Result<Self, ExportError> {
        let mut stand = Stand { base_height: 0.0, floor: 0.0, shapes: Vec::new() };
        let is_free = subject.has_free_base();
        if is_free || options.scene_of.is_some() {
            let zero = subject.robot.configurations()?.zero();
            stand.shapes = subject.robot.shapes(subject.shapes)?;
            let up = stand.height(subject, &zero)?;
            match is_free {
                true => stand.base_height = up,
                false => stand.floor = (-up).min(0.0),
            }
        }
        Ok(stand)
    }

    /// The height of a free base at which the lowest shape touches z = 0, m, to a micrometre.
    pub fn height(&self, subject: &Subject, configuration: &[f64]) -> Result<f64, ExportError> {
        let poses = subject.robot.link_poses(configuration)?;
        let lowest = self
            .shapes
            .iter()
            .map(|shape| lowest(&shape.solid, &poses[shape.link]))
            .fold(f64::INFINITY, f64::min);
        // No shape touches anything.
        Ok(match lowest.is_finite() {
            true => (-lowest * 1e6).round() / 1e6,
            false => 0.0,
        })
    }
}

/// The smallest z of a solid, m.
fn lowest(solid: &Solid, pose: &Isometry3<f64>) -> f64 {
    match solid {
        Solid::Mesh(mesh) => {
            let vertices = mesh.vertices.iter();
            let heights = vertices.map(|vertex| (pose * Point3::from(*vertex)).z);
            heights.fold(f64::INFINITY, f64::min)
        }
        Solid::Box { pose: own, half_extents } => {
            let placed = pose * own;
            let axes = placed.rotation.to_rotation_matrix();
            let reach = (0..3).map(|k| axes[(2, k)].abs() * half_extents[k]);
            placed.translation.z - reach.sum::<f64>()
        }
        Solid::Sphere { centre, radius } => (pose * Point3::from(*centre)).z - radius,
    }
}

/// The scene that includes a file.
pub(super) fn scene(subject: &Subject, file: &str, stand: &Stand) -> Result<Files, ExportError> {
    let stem = file.strip_suffix(".xml").unwrap_or(file);
    let mut root = Element::new("mujoco").with("model", format!("{} scene", subject.urdf.name));
    root.push(Element::new("include").with("file", file));
    let headlight = Element::new("headlight")
        .with("diffuse", "0.6 0.6 0.6")
        .with("ambient", "0.3 0.3 0.3")
        .with("specular", "0 0 0");
    root.push(Element::new("visual").holding(headlight));
    let sky = Element::new("texture")
        .with("type", "skybox")
        .with("builtin", "gradient")
        .with("rgb1", "0.3 0.5 0.7")
        .with("rgb2", "0 0 0")
        .with("width", "512")
        .with("height", "3072");
    let checker = Element::new("texture")
        .with("name", "floor")
        .with("type", "2d")
        .with("builtin", "checker")
        .with("rgb1", "0.2 0.3 0.4")
        .with("rgb2", "0.1 0.2 0.3")
        .with("width", "300")
        .with("height", "300");
    let material = Element::new("material")
        .with("name", "floor")
        .with("texture", "floor")
        .with("texuniform", "true")
        .with("texrepeat", "5 5");
    root.push(Element::new("asset").holding(sky).holding(checker).holding(material));
    let light = Element::new("light")
        .with("pos", "0 0 3")
        .with("dir", "0 0 -1")
        .with("directional", "true");
    // Names of our geoms have a slash.
    let floor = Element::new("geom")
        .with("name", "floor")
        .with("type", "plane")
        .with("size", "0 0 0.05")
        .with("pos", numbers(&[0.0, 0.0, stand.floor]))
        .with("material", "floor");
    root.push(Element::new("worldbody").holding(light).holding(floor));
    let what = format!("The floor is at z = {} m.", number(stand.floor));
    let text = root.document(&subject.comments(what, &[])?);
    Ok(vec![(format!("{stem}_scene.xml"), text.into_bytes())])
}
