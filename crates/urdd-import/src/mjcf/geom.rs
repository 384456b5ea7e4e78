//! Shapes, as a model says them.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::super::model::Geometry;
use super::super::place::Place;
use super::super::refusal::{Fallible, at};
use super::compiler::Compiler;
use super::fault::MjcfFault;
use super::orientation::{pose, z_to};
use super::reading::{Attributes, View};

/// What a shape is.
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
    /// How many sizes it has.
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

/// A shape of a body.
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

    /// Whether it is only seen.
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
