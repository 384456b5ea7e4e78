//! Composing robots in tests.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use urdd_generate::combine::{CombineError, Combined, Recipe, combine};
use urdd_generate::{Selection, Settings, SourceSettings};

/// The path of one of our robots.
pub fn ours(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots");
    folder.join(format!("{name}.urdf"))
}

/// Settings that generate only kinematics: no geometry, so it takes no time.
pub fn core() -> Settings {
    Settings {
        selection: Selection::parse(["core", "kinematics_samples"]).expect("modules"),
        ..with_ours()
    }
}

/// The usual settings, with which a recipe may use our robots as parts.
pub fn with_ours() -> Settings {
    Settings {
        source: SourceSettings {
            allowed_folders: vec![ours("gripper").parent().expect("a folder").to_owned()],
            ..SourceSettings::default()
        },
        ..Settings::default()
    }
}

/// Reads and applies a recipe, in a folder of its own.
pub fn put_together(
    recipe: &str,
    folder: &Path,
    settings: &Settings,
) -> Result<(Combined, PathBuf), CombineError> {
    let recipe = Recipe::from_toml(recipe, "cell.toml", folder)?;
    let target = folder.join("cell");
    let made = combine(&recipe, &target, settings, &BTreeSet::new(), &())?;
    Ok((made, target))
}

/// The validator's findings as `CODE message`; warnings about the source concern the parts.
pub fn findings(urdd: &Path) -> Vec<String> {
    let settings = urdd_validate::settings::Settings::default();
    let run = urdd_validate::validate(&[urdd], &settings).expect("a URDD");
    let report = run.report;
    let findings = report.urdds.iter().flat_map(|urdd| &urdd.findings);
    let told = findings
        .filter(|finding| !finding.code.starts_with("SRC"))
        .map(|finding| format!("{} {:?} {}", finding.code, finding.file, finding.message));
    told.collect()
}
