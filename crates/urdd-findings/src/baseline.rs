//! What was found before, and is not to be reported again.
//!
//! A baseline counts the findings of a file by rule and link or joint, not by line: the file may grow. What is found more
//! often than it was counted is reported.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::check::{Check, Examined};
use super::code::Code;
use super::part::SkipReason;
use super::places::{at, retain};
use super::run::Run;
use super::settings_file::{self, FileError};
use urdd_directory::position::Position;
use urdd_format::report::{Kind, StaleIgnore, Urdd};

/// The only version of the file.
const VERSION: u32 = 1;
/// Maximum size of a baseline, in bytes.
const MAX_BASELINE_BYTES: u64 = 64 << 20;

/// Findings that are there already.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Baseline {
    /// The folder of the baseline's file, with symbolic links resolved: files are named as seen from it.
    folder: PathBuf,
    files: BTreeMap<String, BTreeMap<String, usize>>,
}

/// Why a baseline cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("it is not a baseline of urdd ({0}); `urdd lint --write-baseline FILE` writes one")]
pub struct BaselineError(String);

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    urdd_baseline: u32,
    /// File → rule and subject → how often.
    files: BTreeMap<String, BTreeMap<String, usize>>,
}

impl Baseline {
    /// Reads a baseline file.
    ///
    /// # Errors
    /// If it cannot be read, or is not a baseline.
    pub fn read(file: &Path) -> Result<Self, FileError<BaselineError>> {
        let folder = file.parent().unwrap_or(Path::new("."));
        settings_file::read(file, MAX_BASELINE_BYTES, |text| {
            Baseline::from_json(text, folder).map_err(|error| (None, error))
        })
    }

    /// Reads the text of a baseline file that is in `folder`.
    ///
    /// # Errors
    /// If it is not one.
    pub fn from_json(text: &str, folder: &Path) -> Result<Self, BaselineError> {
        let file: File =
            serde_json::from_str(text).map_err(|error| BaselineError(error.to_string()))?;
        match file.urdd_baseline {
            VERSION => Ok(Baseline { folder: resolved(folder), files: file.files }),
            other => Err(BaselineError(format!("version {other} is not {VERSION}"))),
        }
    }

    /// The baseline of all that a run reports, for a file in `folder`. What was not examined is never in it.
    pub fn of(run: &Run, folder: &Path) -> Self {
        let mut baseline = Baseline { folder: resolved(folder), files: BTreeMap::new() };
        let urdfs = run.report.urdds.iter().zip(&run.folders);
        let is_known = |urdf: &Urdd| urdf.kind == Kind::Urdf && urdf.not_examined.is_none();
        for (urdf, at) in urdfs.filter(|(urdf, _)| is_known(urdf)) {
            let name = urdf.path.rsplit('/').next().unwrap_or_default();
            let file = baseline.name(&at.join(name), urdf);
            for finding in &urdf.findings {
                for place in &finding.places {
                    let counts = baseline.files.entry(file.clone()).or_default();
                    *counts.entry(key(&finding.code, place.subject.as_deref())).or_default() += 1;
                }
            }
        }
        baseline
    }

    /// Its text.
    pub fn to_json(&self) -> String {
        let file = File { urdd_baseline: VERSION, files: self.files.clone() };
        // Maps with text as keys are always JSON.
        serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
    }

    /// Number of findings in it.
    pub fn count(&self) -> usize {
        self.files.values().flat_map(BTreeMap::values).sum()
    }

    /// Leaves out what it counts in the file at `path`. Returns what it counts and was not found.
    pub fn apply(&self, path: &Path, examined: &mut Examined) -> Vec<StaleIgnore> {
        if examined.report.not_examined.is_some() {
            return Vec::new();
        }
        let name = self.name(path, &examined.report);
        let known = self.files.get_key_value(&name).or_else(|| self.before_arguments(&name, path));
        let Some((name, counts)) = known else {
            return Vec::new();
        };
        let mut left = counts.clone();
        let mut known = HashSet::new();
        for check in &mut examined.checks {
            leave_out(check, &mut left, &mut known);
        }
        // What follows from them is not in the baseline, but known as well.
        for check in &mut examined.checks {
            let follows = check.effects.clone().into_iter();
            let follows = follows.filter(|one| known.contains(&one.cause));
            let follows: HashSet<_> = follows.map(|one| (one.at, one.message)).collect();
            retain(check, in_the_baseline(), |_, place| {
                let this = at(place).zip(place.message.clone());
                !this.is_some_and(|this| follows.contains(&this))
            });
        }
        let ran = |key: &str| {
            let code = key.split(' ').next();
            examined.checks.iter().any(|check| Some(check.rule.code.as_str()) == code)
        };
        left.retain(|key, count| *count > 0 && ran(key));
        left.into_keys()
            .map(|key| StaleIgnore { code: Some(key), path: format!("{name} in the baseline") })
            .collect()
    }

    /// The robot of the same file that has some of the arguments and no others: what it was before urdd.toml gave it one more,
    /// or one less. Of several, the one that has most.
    fn before_arguments(
        &self,
        name: &str,
        path: &Path,
    ) -> Option<(&String, &BTreeMap<String, usize>)> {
        let file = self.path(path);
        let arguments = |name: &str| -> Option<BTreeSet<String>> {
            let rest = name.strip_prefix(&file)?;
            let words = rest.strip_prefix(' ').or(rest.is_empty().then_some(""))?;
            Some(words.split_whitespace().map(str::to_owned).collect())
        };
        let own = arguments(name)?;
        let alike = self.files.iter().filter_map(|(name, counts)| {
            let other = arguments(name)?;
            let is_alike = own.is_subset(&other) || other.is_subset(&own);
            is_alike.then(|| (own.intersection(&other).count(), (name, counts)))
        });
        alike.max_by_key(|(common, _)| *common).map(|(_, found)| found)
    }

    /// The name of a file as seen from the baseline's folder, outside of it its whole path; and the arguments of one of its
    /// robots.
    fn name(&self, path: &Path, urdf: &Urdd) -> String {
        urdf.label_at(&self.path(path))
    }

    fn path(&self, path: &Path) -> String {
        let path = resolved(path);
        let inside = path.strip_prefix(&self.folder).unwrap_or(&path);
        inside.to_string_lossy().replace('\\', "/")
    }
}

fn in_the_baseline() -> SkipReason {
    SkipReason::Ignored("it is in the baseline".to_owned())
}

/// Leaves out what is counted in `left`, and adds its place to `known`.
fn leave_out(
    check: &mut Check,
    left: &mut BTreeMap<String, usize>,
    known: &mut HashSet<(Code, Position)>,
) {
    let code = check.rule.code;
    retain(check, in_the_baseline(), |_, place| {
        match left.get_mut(&key(code.as_str(), place.subject.as_deref())) {
            Some(count) if *count > 0 => {
                *count -= 1;
                known.extend(at(place).map(|at| (code, at)));
                false
            }
            _ => true,
        }
    });
}

fn key(code: &str, subject: Option<&str>) -> String {
    match subject {
        Some(subject) => format!("{code} {subject}"),
        None => code.to_owned(),
    }
}

fn resolved(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
