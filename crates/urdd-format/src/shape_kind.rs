//! The six kinds of link shape, and the members of modules with one value for each.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::legacy::shapes as legacy;
use super::link_shapes_distance_statistics::{
    DistanceStatistics, LinkShapesDistanceStatisticsModule,
};
use super::link_shapes_simple_skips::{LinkShapesSimpleSkipsModule, SkipReason, SkipReasons};
use super::link_shapes_skips::LinkShapesSkipsModule;
use super::registry::ModuleKind;

/// The kinds, in the order of the specification (8.1), each with its name.
macro_rules! shape_kinds {
    ($($(#[$doc:meta])* $kind:ident $name:literal;)*) => {
        /// A kind of shapes that approximate links.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum ShapeKind { $($(#[$doc])* $kind,)* }

        impl ShapeKind {
            /// Every kind, in the order of the specification (8.1).
            pub const ALL: [ShapeKind; 6] = [$(ShapeKind::$kind),*];

            /// Its short name, as used on command lines.
            pub fn name(self) -> &'static str {
                match self { $(ShapeKind::$kind => $name,)* }
            }
        }
    };
}

shape_kinds! {
    /// The convex hull of each link.
    Hulls "hulls";
    /// The bounding box of each hull.
    Boxes "boxes";
    /// The bounding sphere of each hull.
    Spheres "spheres";
    /// The convex pieces of each link.
    Pieces "pieces";
    /// The bounding box of each piece.
    PieceBoxes "piece-boxes";
    /// The bounding sphere of each piece.
    PieceSpheres "piece-spheres";
}

impl ShapeKind {
    /// The key of the kind in documents, or the beginning of its keys.
    pub fn key(self) -> &'static str {
        SkipReasons::KEYS[self as usize]
    }

    /// Whether the shapes are of whole links, at most one each; else they are of pieces.
    pub fn is_of_links(self) -> bool {
        self < ShapeKind::Pieces
    }

    /// Whether the shapes are the hulls or pieces themselves; else they are their bounding volumes.
    pub fn is_convex_mesh(self) -> bool {
        matches!(self, ShapeKind::Hulls | ShapeKind::Pieces)
    }

    /// The module that has the shapes.
    pub fn module(self) -> ModuleKind {
        if self.is_convex_mesh() { self.meshes() } else { ModuleKind::LinkShapesApproximations }
    }

    /// The module with the meshes that the shapes are or bound.
    pub fn meshes(self) -> ModuleKind {
        match self.is_of_links() {
            true => ModuleKind::ConvexHullMeshes,
            false => ModuleKind::ConvexDecompositionMeshes,
        }
    }
}

impl fmt::Display for ShapeKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// No kind of shapes has this name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no kind of shapes `{}`", .0.escape_debug())]
pub struct UnknownShapeKind(pub String);

impl FromStr for ShapeKind {
    type Err = UnknownShapeKind;

    fn from_str(name: &str) -> Result<Self, UnknownShapeKind> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| UnknownShapeKind(name.to_owned()))
    }
}

/// Six members, one for each kind of shape.
pub trait OfKinds {
    /// The value of a member.
    type Value: ?Sized;
    /// The keys of the members, in the order of [`ShapeKind::ALL`].
    const KEYS: [&'static str; 6];
    /// The members, in the order of [`ShapeKind::ALL`]; `None` for null.
    fn of_kinds(&self) -> [Option<&Self::Value>; 6];
    /// The member of a kind; `None` for null.
    fn of_kind(&self, kind: ShapeKind) -> Option<&Self::Value> {
        self.of_kinds()[kind as usize]
    }
}

/// A member: always present, or optional.
trait Member<V: ?Sized> {
    fn value(&self) -> Option<&V>;
}

impl<V> Member<V> for V {
    fn value(&self) -> Option<&V> {
        Some(self)
    }
}

impl<V> Member<V> for Option<V> {
    fn value(&self) -> Option<&V> {
        self.as_ref()
    }
}

macro_rules! of_kinds {
    (simple $type:ty) => {
        of_kinds! {
            $type => Vec<Vec<bool>>;
            full_convex_hulls_simple_skips full_obbs_simple_skips
            full_bounding_spheres_simple_skips decomposition_convex_hulls_simple_skips
            decomposition_obbs_simple_skips decomposition_bounding_spheres_simple_skips
        }
    };
    (edited $type:ty) => {
        of_kinds! {
            $type => Vec<Vec<bool>>;
            full_convex_hulls_skips full_obbs_skips full_bounding_spheres_skips
            decomposition_convex_hulls_skips decomposition_obbs_skips
            decomposition_bounding_spheres_skips
        }
    };
    ($type:ty => $value:ty; $($member:ident)*) => {
        impl OfKinds for $type {
            type Value = $value;
            const KEYS: [&'static str; 6] = [$(stringify!($member)),*];
            fn of_kinds(&self) -> [Option<&$value>; 6] {
                [$(Member::<$value>::value(&self.$member)),*]
            }
        }
    };
    ($type:ty => $value:ty) => {
        of_kinds! {
            $type => $value;
            full_convex_hulls full_obbs full_bounding_spheres
            decomposition_convex_hulls decomposition_obbs decomposition_bounding_spheres
        }
    };
}

of_kinds! { LinkShapesDistanceStatisticsModule => DistanceStatistics }
of_kinds! { legacy::LinkShapesDistanceStatisticsModule => legacy::DistanceStatistics }
of_kinds! { SkipReasons => Vec<Vec<SkipReason>> }
of_kinds! { simple LinkShapesSimpleSkipsModule }
of_kinds! { simple legacy::LinkShapesSimpleSkipsModule }
of_kinds! { edited LinkShapesSkipsModule }
of_kinds! { edited legacy::LinkShapesSkipsModule }
