//! Terms of the format as command-line values.

use clap::ValueEnum;

use urdd_format::report::Severity;
use urdd_format::root_metadata::ConformanceClass;

/// A conformance class.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Class {
    /// The robot and its kinematics.
    Core,
    /// Core, and meshes.
    Geometry,
    /// Geometry, and boxes, spheres, distances and skips.
    Shapes,
}

impl Class {
    /// The corresponding conformance class.
    pub fn class(self) -> ConformanceClass {
        match self {
            Class::Core => ConformanceClass::Core,
            Class::Geometry => ConformanceClass::Geometry,
            Class::Shapes => ConformanceClass::Shapes,
        }
    }
}

/// A severity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Level {
    /// What programs refuse or get wrong, or what a URDD must not have.
    Error,
    /// What is wrong or risky for some programs, or what a URDD should not have.
    Warning,
    /// An outdated convention, or something worth knowing.
    Info,
}

impl Level {
    /// The corresponding severity.
    pub fn severity(self) -> Severity {
        match self {
            Level::Error => Severity::Error,
            Level::Warning => Severity::Warning,
            Level::Info => Severity::Info,
        }
    }
}
