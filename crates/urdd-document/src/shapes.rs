//! Version-independent view of link shapes: the meaning of shape indices, and the modules with lists per link.

use nalgebra::{Rotation3, Vector3};

use crate::urdd::Urdd;
use urdd_format::link_shapes_approximations::{BoundingSphere, Obb};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shape_kind::ShapeKind;

/// The modules with lists per link.
pub const LIST_MODULES: &[ModuleKind] =
    &[ModuleKind::LinkShapesApproximations, ModuleKind::LinkShapesMaxDistanceFromOrigin];

/// The meaning of shape indices (SPEC 8.1).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shapes {
    /// Link of each full shape.
    pub full: Vec<usize>,
    /// Link and piece index of each decomposition shape.
    pub pieces: Vec<(usize, usize)>,
}

impl Shapes {
    /// The shapes that the hulls and the pieces define.
    pub fn new(urdd: &Urdd) -> Option<Shapes> {
        let hulls = urdd.meshes(ModuleKind::ConvexHullMeshes)?;
        let pieces = urdd.meshes(ModuleKind::ConvexDecompositionMeshes)?;
        Some(Shapes {
            full: (0..hulls.num_links()).filter(|link| hulls.count(*link) > 0).collect(),
            pieces: (0..pieces.num_links())
                .flat_map(|link| (0..pieces.count(link)).map(move |piece| (link, piece)))
                .collect(),
        })
    }

    /// Number of shapes of a kind.
    pub fn count(&self, kind: ShapeKind) -> usize {
        if kind.is_of_links() { self.full.len() } else { self.pieces.len() }
    }

    /// The link of a shape.
    pub fn link(&self, kind: ShapeKind, shape: usize) -> Option<usize> {
        self.place(kind, shape).map(|(link, _)| link)
    }

    /// The link and the piece of a shape; the piece of a full shape is 0.
    pub fn place(&self, kind: ShapeKind, shape: usize) -> Option<(usize, usize)> {
        match kind.is_of_links() {
            true => self.full.get(shape).map(|link| (*link, 0)),
            false => self.pieces.get(shape).copied(),
        }
    }

    /// A shape for messages: its index, with its link and piece.
    pub fn describe(&self, urdd: &Urdd, kind: ShapeKind, shape: usize) -> String {
        let link = self.link(kind, shape);
        let name = link.and_then(|link| Some(urdd.robot()?.links.get(link)?.name.as_str()));
        match (name, self.pieces.get(shape)) {
            (Some(name), _) if kind.is_of_links() => format!("{shape} (link `{name}`)"),
            (Some(name), Some((_, piece))) => format!("{shape} (piece {piece} of `{name}`)"),
            _ => shape.to_string(),
        }
    }
}

/// A bounding box or bounding sphere of a shape, in the link's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Volume {
    /// A box.
    Box {
        /// Half of each side.
        half_extents: [f64; 3],
        /// Centre.
        offset: [f64; 3],
        /// Fixed-axis roll, pitch, yaw.
        rpy: [f64; 3],
    },
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
        /// Centre.
        offset: [f64; 3],
    },
}

impl Volume {
    /// Distance of its farthest point from the link's origin. For a box, that is a corner.
    pub fn reach(&self) -> f64 {
        match *self {
            Volume::Sphere { radius, offset } => Vector3::from(offset).norm() + radius,
            Volume::Box { half_extents, offset, rpy } => {
                let turn = Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
                // In the box's own frame, the farthest corner is on the centre's side of each axis.
                let centre = turn.inverse() * Vector3::from(offset);
                let corner = centre.abs() + Vector3::from(half_extents).abs();
                corner.norm()
            }
        }
    }
}

/// A list with one entry per link: none or one for full shapes, or one for each piece.
#[derive(Debug, Clone)]
pub struct ShapeList<T> {
    /// Its key in the document.
    pub key: &'static str,
    /// The kind of shape.
    pub kind: ShapeKind,
    /// Entries of each link.
    pub links: Vec<Vec<T>>,
}

impl<T> ShapeList<T> {
    /// JSON Pointer to an entry.
    pub fn pointer(&self, link: usize, piece: usize) -> String {
        match self.kind.is_of_links() {
            true => format!("/{}/{link}", self.key),
            false => format!("/{}/{link}/{piece}", self.key),
        }
    }

    /// Its entries, each with its link and its index within the link.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, T)>
    where
        T: Copy,
    {
        let links = self.links.iter().enumerate();
        links.flat_map(|(link, entries)| {
            let entries = entries.iter().enumerate();
            entries.map(move |(piece, entry)| (link, piece, *entry))
        })
    }

    /// A list of the document: an option or a list for each link.
    fn new<'a, S: 'a, L>(
        kind: ShapeKind,
        key: &'static str,
        list: &'a [L],
        read: impl Fn(&'a S) -> T,
    ) -> Self
    where
        &'a L: IntoIterator<Item = &'a S>,
    {
        let links = list.iter();
        let links = links.map(|entry| entry.into_iter().map(&read).collect());
        ShapeList { key, kind, links: links.collect() }
    }
}

/// The lists of `link_shapes_approximations_module`: boxes and spheres.
pub fn approximations(document: &ModuleDocument) -> Option<[ShapeList<Volume>; 4]> {
    let ModuleDocument::LinkShapesApproximations(module) = document else {
        return None;
    };
    let of_box = |b: &Obb| Volume::Box {
        half_extents: b.half_extents,
        offset: b.offset_xyz,
        rpy: b.offset_rpy,
    };
    let of_sphere = |s: &BoundingSphere| Volume::Sphere { radius: s.radius, offset: s.offset_xyz };
    macro_rules! lists {
        ($($kind:ident $field:ident $read:ident),*) => {
            [$(ShapeList::new(ShapeKind::$kind, stringify!($field), &module.$field, $read)),*]
        };
    }
    Some(lists!(
        Boxes full_obbs of_box,
        Spheres full_bounding_spheres of_sphere,
        PieceBoxes decomposition_obbs of_box,
        PieceSpheres decomposition_bounding_spheres of_sphere
    ))
}

/// The lists of `link_shapes_max_distance_from_origin_module`, in the order of [`ShapeKind::ALL`].
pub fn max_distances(document: &ModuleDocument) -> Option<[ShapeList<f64>; 6]> {
    let ModuleDocument::LinkShapesMaxDistanceFromOrigin(module) = document else {
        return None;
    };
    macro_rules! lists {
        ($($kind:ident $field:ident)*) => {
            [$(ShapeList::new(ShapeKind::$kind, stringify!($field), &module.$field, |d: &f64| *d)),*]
        };
    }
    Some(lists!(
        Hulls full_convex_hulls_maximum_distances
        Boxes full_obbs_maximum_distances
        Spheres full_bounding_spheres_maximum_distances
        Pieces decomposition_convex_hulls_maximum_distances
        PieceBoxes decomposition_obbs_maximum_distances
        PieceSpheres decomposition_bounding_spheres_maximum_distances
    ))
}

/// The number of entries per link, for every list of a module with lists.
pub fn entry_counts(document: &ModuleDocument) -> Vec<ShapeList<()>> {
    fn counts<T>(lists: &[ShapeList<T>]) -> Vec<ShapeList<()>> {
        let count = |list: &ShapeList<T>| ShapeList {
            key: list.key,
            kind: list.kind,
            links: list.links.iter().map(|entry| vec![(); entry.len()]).collect(),
        };
        lists.iter().map(count).collect()
    }
    match (approximations(document), max_distances(document)) {
        (Some(lists), _) => counts(&lists),
        (_, Some(lists)) => counts(&lists),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_corner_of_a_box() {
        let turned = Volume::Box {
            half_extents: [1.0, 2.0, 3.0],
            offset: [0.5, -4.0, 0.25],
            rpy: [0.3, -1.1, 2.4],
        };
        let Volume::Box { half_extents: h, offset, rpy } = turned else {
            panic!("a box");
        };
        let turn = Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
        let mut farthest = 0.0_f64;
        for corner in 0..8 {
            let sign = |bit: usize| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let local = Vector3::new(h[0] * sign(0), h[1] * sign(1), h[2] * sign(2));
            farthest = farthest.max((Vector3::from(offset) + turn * local).norm());
        }
        assert!((turned.reach() - farthest).abs() < 1e-12);
    }

    #[test]
    fn the_farthest_point_of_a_sphere() {
        let sphere = Volume::Sphere { radius: 2.0, offset: [0.0, 3.0, -4.0] };
        assert_eq!(sphere.reach(), 7.0);
    }
}
