//! Elements for Gazebo that wait until all frames are known.

use nalgebra::Isometry3;
use urdd_xml::writer::Element;

use super::super::place::Place;

/// An element whose pose refers to another frame than that of its link or joint.
pub struct Posed {
    pub element: Element,
    pub owner: String,
    pub node: usize,
    pub pose: (Isometry3<f64>, String),
    pub place: Place,
}
