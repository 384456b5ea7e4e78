//! The spheres of links of a URDD.

use std::fmt::{self, Write};

use serde::Serialize;

use urdd_document::urdd::Urdd;
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_format::rate::Rate;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// A level of spheres.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelInfo {
    /// Number of spheres.
    pub spheres: usize,
    /// Whether they hold all pieces of the links.
    pub covers: bool,
    /// Where they are from.
    pub origin: SphereOrigin,
    /// Of collisions, those that the level misses; of free configurations, those in which it touches.
    pub miss_rate: Rate,
    pub false_contact_rate: Rate,
}

impl LevelInfo {
    /// Those of a URDD, from coarse to fine; none without a usable `link_shapes_spheres_module`.
    pub fn all(urdd: &Urdd) -> Vec<Self> {
        match urdd.document(ModuleKind::LinkShapesSpheres) {
            Some(ModuleDocument::LinkShapesSpheres(module)) => {
                module.levels.iter().map(LevelInfo::of).collect()
            }
            _ => Vec::new(),
        }
    }

    fn of(level: &SphereLevel) -> Self {
        LevelInfo {
            spheres: level.spheres.iter().map(Vec::len).sum(),
            covers: level.covers,
            origin: level.origin,
            miss_rate: level.evaluation.miss_rate(),
            false_contact_rate: level.evaluation.false_contact_rate(),
        }
    }
}

/// A line for the levels that cover, and one for each other.
pub fn write(levels: &[LevelInfo], out: &mut impl Write) -> fmt::Result {
    let covering: Vec<String> =
        levels.iter().filter(|level| level.covers).map(|level| level.spheres.to_string()).collect();
    if !covering.is_empty() {
        writeln!(out, "  spheres   levels of {} that cover the links", covering.join(", "))?;
    }
    for level in levels.iter().filter(|level| !level.covers) {
        let origin = match level.origin {
            SphereOrigin::Computed => "fitted",
            SphereOrigin::Given => "given",
        };
        let (missed, wrong) = (level.miss_rate, level.false_contact_rate);
        let count = level.spheres;
        writeln!(
            out,
            "  spheres   {count} {origin}; missed collisions {missed}; false contacts {wrong}"
        )?;
    }
    Ok(())
}
