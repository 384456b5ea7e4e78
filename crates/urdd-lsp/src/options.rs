//! What the user sets, in the editor.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::Value;

use urdd_directory::cancellation::Cancellation;
use urdd_lint::LintSettings;
use urdd_source::Packages;

/// How long after a change findings are computed, unless the user sets another time.
const DEBOUNCE: Duration = Duration::from_millis(150);
/// The longest time that can be set.
const LONGEST_DEBOUNCE: u64 = 10_000;

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Options {
    /// Whether a xacro file is expanded when it is saved. That runs code that the file contains.
    pub xacro: bool,
    pub package_paths: Vec<PathBuf>,
    /// The baseline, whose findings are not shown, if the user names one.
    pub baseline: Option<PathBuf>,
    pub debounce: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Options { xacro: false, package_paths: Vec::new(), baseline: None, debounce: DEBOUNCE }
    }
}

impl Options {
    /// Takes over what a value sets: `{"xacro": false, "packagePaths": []}`, alone or as `urdd`. What it does not name,
    /// or has of another type, stays. Relative paths are below `root`.
    pub fn update(&mut self, value: &Value, root: Option<&Path>) {
        let value = value.get("urdd").unwrap_or(value);
        if let Some(xacro) = value.get("xacro").and_then(Value::as_bool) {
            self.xacro = xacro;
        }
        let absolute = |path: &str| root.map_or_else(|| path.into(), |root| root.join(path));
        if let Some(paths) = value.get("packagePaths").and_then(Value::as_array) {
            let paths = paths.iter().filter_map(Value::as_str);
            self.package_paths = paths.map(absolute).collect();
        }
        if let Some(file) = value.get("baseline").and_then(Value::as_str) {
            self.baseline = (!file.is_empty()).then(|| absolute(file));
        }
        if let Some(debounce) = value.get("debounce").and_then(Value::as_u64) {
            self.debounce = Duration::from_millis(debounce.min(LONGEST_DEBOUNCE));
        }
    }

    /// The settings of a run of the rules, without those of files.
    pub fn lint_settings(&self, cancellation: &Cancellation) -> LintSettings {
        let mut settings = LintSettings::default();
        settings.source.packages = Packages::from_environment(|name| {
            let value = std::env::var_os(name);
            match name {
                "ROS_PACKAGE_PATH" => self.before(value),
                _ => value,
            }
        });
        settings.source.cancellation = cancellation.clone();
        settings
    }

    /// The folders, and behind them those of a search path.
    fn before(&self, paths: Option<OsString>) -> Option<OsString> {
        let paths = paths.unwrap_or_default();
        let own = self.package_paths.iter().cloned();
        let all: Vec<PathBuf> = own.chain(std::env::split_paths(&paths)).collect();
        // A folder with the separator in its name cannot be in a search path.
        let all = all.iter().filter(|path| std::env::join_paths([path]).is_ok());
        std::env::join_paths(all).ok()
    }
}
