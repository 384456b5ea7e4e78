//! Terms of the format as command-line values.

use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::meshes::GeometryKind;
use urdd_format::report::Severity;
use urdd_format::root_metadata::ConformanceClass;
use urdd_robot::ShapeKind;

/// Declares values with the names of a type's, and what they say in `--help`.
macro_rules! words {
    ($($(#[$about:meta])* $word:ident for $term:ident { $($(#[$help:meta])* $variant:ident,)+ })+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
        pub enum $word {
            $($(#[$help])* $variant,)+
        }

        impl From<$word> for $term {
            fn from(word: $word) -> Self {
                match word {
                    $($word::$variant => $term::$variant,)+
                }
            }
        }
    )+};
}

words! {
    /// A conformance class.
    Class for ConformanceClass {
        /// The robot and its kinematics.
        Core,
        /// Core, and meshes.
        Geometry,
        /// Geometry, and boxes, spheres, distances and skips.
        Shapes,
    }

    /// A severity.
    Level for Severity {
        /// What programs refuse or get wrong, or what a URDD must not have.
        Error,
        /// What is wrong or risky for some programs, or what a URDD should not have.
        Warning,
        /// An outdated convention, or something worth knowing.
        Info,
    }

    /// The elements that geometry is taken from.
    Preferred for GeometryKind {
        /// The visual elements.
        Visual,
        /// The collision elements.
        Collision,
    }

    /// A reason to skip a pair of shapes.
    Skip for SkippedReason {
        /// Both shapes belong to the same link.
        SameLink,
        /// In contact in every sampled configuration.
        Always,
        /// A joint connects the two links.
        Adjacent,
        /// In contact in the default configuration: zero, clamped to the bounds.
        Default,
        /// In contact in no sampled configuration.
        Never,
    }

    /// A kind of shapes.
    Shapes for ShapeKind {
        /// The convex pieces of links.
        Pieces,
        /// The convex hulls of links.
        Hulls,
        /// The bounding boxes of hulls.
        Boxes,
        /// The bounding spheres of hulls.
        Spheres,
        /// The bounding boxes of pieces.
        PieceBoxes,
        /// The bounding spheres of pieces.
        PieceSpheres,
    }
}
