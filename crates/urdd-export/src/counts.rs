//! How many shapes there are of each kind.

use std::fmt;

use super::shapes::Solid;
use urdd_format::urdf::Geometry;
use urdd_geometry::primitives::Primitive;

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
