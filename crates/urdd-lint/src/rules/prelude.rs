//! Names that rules use.

pub(super) use std::collections::{BTreeMap, BTreeSet};
pub(super) use std::path::Path;

pub(super) use nalgebra::{Point3, Vector3};
pub(super) use urdd_xml::Node;

pub(super) use crate::elements::{ONE_DOF, WITH_AXIS, child, named, number, numbers};
pub(super) use crate::geometry::{bounds, diagonal};
pub(super) use crate::hull::Hull;
pub(super) use crate::inertial::Inertial;
pub(super) use crate::rule::declare_lint;
pub(super) use crate::srdf;
pub(super) use crate::subject::Subject;
pub(super) use crate::textures::textures;
pub(super) use crate::unknown::What;
pub(super) use urdd_findings::description::Severity;
pub(super) use urdd_findings::finding::{Finding, Findings};
pub(super) use urdd_format::meshes::GeometryKind;
pub(super) use urdd_format::readable::metres;
pub(super) use urdd_geometry::read::{Format, NoteCode};
pub(super) use urdd_xml::element::children;
