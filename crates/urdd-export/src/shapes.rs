//! Which shapes an export has as collision geometry, and one shape of a link.

use std::fmt;
use std::str::FromStr;

use nalgebra::{Isometry3, Translation3};

use urdd_format::shape_kind::UnknownShapeKind;
use urdd_format::urdf::Geometry;
use urdd_geometry::Mesh;
use urdd_geometry::primitives::Primitive;
use urdd_robot::{LinkShape, ShapeKind, Solid as Kept};

/// The shapes that an export has as collision geometry, and by which it judges pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shapes {
    /// The URDD's shapes of a kind.
    Kind(ShapeKind),
    /// The collision elements of the source, link by link. A link without one has its convex pieces.
    Source,
}

impl Shapes {
    /// The word for [`Shapes::Source`]; kinds have their own.
    pub const SOURCE: &str = "source";

    /// Its word for users.
    pub fn word(self) -> &'static str {
        match self {
            Shapes::Kind(kind) => kind.name(),
            Shapes::Source => Shapes::SOURCE,
        }
    }
}

impl From<ShapeKind> for Shapes {
    fn from(kind: ShapeKind) -> Self {
        Shapes::Kind(kind)
    }
}

/// As it stands in a sentence.
impl fmt::Display for Shapes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Shapes::Kind(kind) => kind.fmt(f),
            Shapes::Source => f.write_str("shapes of the source"),
        }
    }
}

impl FromStr for Shapes {
    type Err = UnknownShapeKind;

    fn from_str(word: &str) -> Result<Self, UnknownShapeKind> {
        match word {
            Shapes::SOURCE => Ok(Shapes::Source),
            word => word.parse().map(Shapes::Kind),
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    /// Its number in the link: of a piece, or of a collision element.
    pub number: usize,
    pub name: Option<String>,
    pub solid: Solid,
}

/// A solid in the link's frame, in metres.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Solid {
    /// A convex mesh: each vertex once.
    Convex(Mesh),
    /// A mesh of the source that is not convex, or not closed.
    Mesh(Mesh),
    /// A primitive, and the pose of its centre and axes.
    Primitive(Isometry3<f64>, Primitive),
}

impl From<LinkShape> for Shape {
    fn from(shape: LinkShape) -> Self {
        let solid = match shape.solid {
            Kept::Mesh(mesh) => Solid::Convex(mesh),
            Kept::Box { pose, half_extents } => {
                Solid::Primitive(pose, Primitive::Box(half_extents))
            }
            Kept::Sphere { centre, radius } => {
                let pose = Isometry3::from(Translation3::from(centre));
                Solid::Primitive(pose, Primitive::Sphere { radius })
            }
        };
        Shape { number: shape.piece, name: None, solid }
    }
}

/// Half the thickness of a flat shape for programs that refuse it, in metres.
const HALF_THICKNESS: f64 = 1e-6;

/// A primitive without a size below what programs accept.
pub(super) fn thick(primitive: Primitive) -> Primitive {
    let least = |size: f64| size.max(HALF_THICKNESS);
    match primitive {
        Primitive::Box(half) => Primitive::Box(half.map(least)),
        Primitive::Cylinder { radius, half } => {
            Primitive::Cylinder { radius: least(radius), half: least(half) }
        }
        Primitive::Capsule { radius, half } => {
            Primitive::Capsule { radius: least(radius), half: least(half) }
        }
        Primitive::Sphere { radius } => Primitive::Sphere { radius: least(radius) },
    }
}

/// How many boxes, cylinders, capsules, spheres and meshes there are.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShapeCounts([usize; 5]);

/// One and many, in the order of [`ShapeCounts`].
const WORDS: [[&str; 2]; 5] = [
    ["box", "boxes"],
    ["cylinder", "cylinders"],
    ["capsule", "capsules"],
    ["sphere", "spheres"],
    ["mesh", "meshes"],
];

impl ShapeCounts {
    pub(super) fn of<'s>(solids: impl Iterator<Item = &'s Solid>) -> Self {
        Self::counted(solids.map(|solid| match solid {
            Solid::Primitive(_, Primitive::Box(_)) => 0,
            Solid::Primitive(_, Primitive::Cylinder { .. }) => 1,
            Solid::Primitive(_, Primitive::Capsule { .. }) => 2,
            Solid::Primitive(_, Primitive::Sphere { .. }) => 3,
            Solid::Convex(_) | Solid::Mesh(_) => 4,
        }))
    }

    pub(super) fn of_elements<'s>(elements: impl Iterator<Item = &'s Geometry>) -> Self {
        Self::counted(elements.map(|element| match element {
            Geometry::Box(_) => 0,
            Geometry::Cylinder(_) => 1,
            Geometry::Capsule(_) => 2,
            Geometry::Sphere(_) => 3,
            Geometry::Mesh(_) => 4,
        }))
    }

    fn counted(kinds: impl Iterator<Item = usize>) -> Self {
        let mut counts = ShapeCounts::default();
        kinds.for_each(|kind| counts.0[kind] += 1);
        counts
    }

    /// How many there are.
    pub fn total(&self) -> usize {
        self.0.iter().sum()
    }
}

/// Such as `2 boxes, 1 mesh`.
impl fmt::Display for ShapeCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let each = self.0.iter().zip(WORDS).filter(|(count, _)| **count > 0);
        let said = each.map(|(count, [one, many])| {
            format!("{count} {}", if *count == 1 { one } else { many })
        });
        let said: Vec<String> = said.collect();
        f.write_str(if said.is_empty() { "nothing".to_owned() } else { said.join(", ") }.as_str())
    }
}
