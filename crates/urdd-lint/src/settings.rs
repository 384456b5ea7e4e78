//! How URDFs are linted.

use super::baseline::Baseline;
use urdd_validate::settings::Settings;

/// How URDFs are linted.
#[derive(Debug, Clone, Default)]
pub struct LintSettings {
    /// What is reported, and how severe it is.
    pub report: Settings,
    /// Where packages and meshes are, and how xacro files are expanded.
    pub source: urdd_generate::Settings,
    /// What was found before, and is not reported.
    pub baseline: Option<Baseline>,
    /// Whether no mesh file is read, as while somebody types: rules about the shapes of links are skipped.
    pub without_meshes: bool,
}
