//! How URDFs are linted.

use std::path::Path;
use std::sync::Arc;

use urdd_findings::baseline::Baseline;
use urdd_findings::examined::Examined;
use urdd_findings::settings::Settings;
use urdd_findings::settings_file::SettingsFile;
use urdd_source::Declared;

/// How URDFs are linted.
#[derive(Debug, Clone, Default)]
pub struct LintSettings {
    /// What is reported, and how severe it is.
    pub report: Settings,
    /// Where packages and meshes are, and how xacro files are expanded.
    pub source: urdd_source::Settings,
    /// What was found before, and is not reported.
    pub baseline: Option<Arc<Baseline>>,
    /// Whether no mesh file is read, as while somebody types: rules about the shapes of links are skipped.
    pub without_meshes: bool,
}

/// The robots that a settings file declares.
pub fn declared(file: &SettingsFile) -> Vec<Declared> {
    let one = |robot: &urdd_findings::robots::DeclaredRobot| Declared {
        source: robot.file.clone(),
        name: robot.name.clone(),
        arguments: robot.arguments.clone(),
    };
    file.robots.iter().map(one).collect()
}

impl LintSettings {
    /// Leaves out of the result for one file what the baseline and the settings leave out, and changes severities, as
    /// [`lint`](super::lint) does. `seen` is the path that patterns of the settings match.
    pub fn apply(&self, path: Option<&Path>, seen: String, mut examined: Examined) -> Examined {
        examined.report.path = seen;
        if let (Some(baseline), Some(path)) = (&self.baseline, path) {
            baseline.apply(path, &mut examined);
        }
        let mut examined = [examined];
        self.report.apply(&mut examined);
        let [examined] = examined;
        examined
    }
}
