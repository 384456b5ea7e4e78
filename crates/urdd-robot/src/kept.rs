//! What an open robot keeps once it was read.

use nalgebra::Isometry3;

use urdd_geometry::Mesh;

/// The mass of a link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinkMass {
    /// kg; 0 where the source states none.
    pub mass: f64,
    /// The centre of mass, in the link's frame, m.
    pub centre: [f64; 3],
}

/// A shape in its link's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkShape {
    /// The link.
    pub link: usize,
    /// Index of the link's piece that it is or bounds; 0 for a hull and its bounding volumes.
    pub piece: usize,
    /// The shape.
    pub solid: Solid,
}

/// A solid in the link's frame, in metres.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A convex mesh, each vertex once.
    Mesh(Mesh),
    /// An oriented box.
    Box {
        /// The pose of its centre and axes.
        pose: Isometry3<f64>,
        /// Half extents along its axes.
        half_extents: [f64; 3],
    },
    /// A sphere.
    Sphere {
        /// The centre.
        centre: [f64; 3],
        /// The radius.
        radius: f64,
    },
}
