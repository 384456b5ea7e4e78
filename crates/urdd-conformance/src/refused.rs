//! URDFs that have no URDD as they are: a producer refuses or repairs them. They are sources of cases, and a few more.
//! And the validator's result on what a producer wrote.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::data::Damage;
use crate::process::{End, Ran};
use crate::suite::{CaseKind, Suite};
use crate::tree::{FilePath, Tree, TreeError};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::regular;
use urdd_format::conformance::{RefusedOutcome, RefusedScore, ScoreStatus};
use urdd_format::report::{Finding, Severity, Urdd, Verdict};
use urdd_format::root_metadata::{ConformanceClass, RootMetadata};
use urdd_validate::settings::Settings;
use urdd_validate::validate;

/// The folder of those that are not sources of cases, and of all in an exported suite.
pub const REFUSED: &str = "refused";

/// The bases of cases whose URDF is at fault: faults of the base's URDF, by the rules of 6.1.3 to 6.1.6 and of its reading.
/// Other bases are odd robots, whose URDFs are right, or are at the limits of size, where they take megabytes.
const BASES: [&str; 2] = ["toy", "toy_core"];
const SOURCE: &str = "robot.urdf";
const RULES: std::ops::RangeInclusive<&str> = "URD002"..="URD012";

/// A URDF to refuse.
#[derive(Debug, Clone, PartialEq)]
pub struct Refused {
    /// The rule that every URDD of it would break, a slash and a name.
    pub id: String,
    /// Its text.
    pub urdf: Vec<u8>,
}

/// Every URDF to refuse, by id.
///
/// # Errors
/// If a case is damaged.
pub fn all(suite: &Suite) -> Result<Vec<Refused>, Damage> {
    let refused = |id: &str, bytes: &[u8]| Refused { id: id.to_owned(), urdf: bytes.to_owned() };
    let files = suite.data.below(REFUSED);
    let files = files.filter_map(|(path, bytes)| Some(refused(path.strip_suffix(".urdf")?, bytes)));
    let mut all: Vec<Refused> = files.collect();
    let source = FilePath::from(SOURCE);
    for case in &suite.cases {
        let is_at_fault = case.kind == CaseKind::Invalid
            && RULES.contains(&case.code.as_str())
            && BASES.contains(&case.base.as_str())
            && case.changes.iter().any(|change| change.file == source);
        if is_at_fault {
            let tree = suite.tree(case)?;
            all.extend(tree.file(SOURCE).map(|bytes| refused(&case.id(), bytes)));
        }
    }
    all.sort_by(|a, b| a.id.cmp(&b.id));
    Ok(all)
}

/// The URDFs as files of an exported suite.
pub fn tree(all: &[Refused]) -> Tree {
    let mut tree = Tree::default();
    for urdf in all {
        let path = format!("{}.urdf", urdf.id);
        tree.put(FilePath::from(path.as_str()), urdf.urdf.as_slice());
    }
    tree
}

impl Refused {
    fn name(&self) -> &str {
        self.id.rsplit('/').next().unwrap_or(&self.id)
    }

    /// Writes it into a folder of its own. Returns its path, and the path for its URDD.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(PathBuf, PathBuf), TreeError> {
        let file = format!("{}.urdf", self.name());
        let mut tree = Tree::default();
        tree.put(FilePath::from(file.as_str()), self.urdf.as_slice());
        tree.write(folder)?;
        Ok((folder.join(file), folder.join(self.name())))
    }

    /// Scores what a command did with it.
    pub fn score(
        &self,
        ran: Ran,
        out: &Path,
        class: ConformanceClass,
        cancellation: &Cancellation,
    ) -> RefusedScore {
        let is_there = out.symlink_metadata().is_ok();
        let says_why = !ran.stderr.trim().is_empty() || !ran.stdout.trim().is_empty();
        let (mut unreadable, mut found) = (None, Vec::new());
        let outcome = match ran.end {
            End::Status(0) => match repaired(out, class, cancellation) {
                Ok(urdd) if urdd.verdict == Verdict::Pass => RefusedOutcome::Repaired,
                Ok(urdd) => {
                    let mut errors = urdd.findings;
                    errors.retain(|finding| finding.severity == Severity::Error);
                    found = codes(errors.iter());
                    RefusedOutcome::Written
                }
                Err(reason) => {
                    unreadable = reason;
                    RefusedOutcome::Written
                }
            },
            End::Status(_) if ran.looks_crashed() => RefusedOutcome::Crashed,
            End::Status(_) if is_there => RefusedOutcome::LeftOver,
            End::Status(_) if !says_why => RefusedOutcome::Silent,
            End::Status(_) => RefusedOutcome::Refused,
            _ => RefusedOutcome::Crashed,
        };
        let passed = matches!(outcome, RefusedOutcome::Refused | RefusedOutcome::Repaired);
        RefusedScore {
            robot: self.id.clone(),
            status: if passed { ScoreStatus::Passed } else { ScoreStatus::Failed },
            skipped_since: None,
            outcome,
            end: ran.end.to_string(),
            stdout: (!passed).then_some(ran.stdout),
            stderr: (!passed).then_some(ran.stderr),
            unreadable,
            codes: found,
        }
    }
}

/// The validator's result on a URDD that carries its source, or the reason why there is none.
fn repaired(
    out: &Path,
    class: ConformanceClass,
    cancellation: &Cancellation,
) -> Result<Urdd, Option<String>> {
    let urdd = examine(out, class, cancellation)?;
    let text = regular::read(&out.join(ROOT_METADATA), MAX_DOCUMENT_BYTES).unwrap_or_default();
    let metadata = serde_json::from_slice::<RootMetadata>(&text);
    let is_carried = metadata.is_ok_and(|metadata| metadata.source.is_some());
    if urdd.verdict == Verdict::Pass && !is_carried {
        let why = "the URDD carries no source: carry the repaired URDF (SPEC 6.1.8)";
        return Err(Some(why.to_owned()));
    }
    Ok(urdd)
}

/// The validator's result, or the reason why there is none.
pub(crate) fn examine(
    out: &Path,
    class: ConformanceClass,
    cancellation: &Cancellation,
) -> Result<Urdd, Option<String>> {
    if !out.is_dir() {
        return Err(Some("the command created no folder at {out}".to_owned()));
    }
    let settings =
        Settings { class: Some(class), cancellation: cancellation.clone(), ..Settings::default() };
    let run = validate(&[out.to_owned()], &settings).map_err(|error| {
        let text = error.to_string();
        Some(text.replace(&out.display().to_string(), "{out}"))
    })?;
    let mut urdds = run.report.urdds;
    match (urdds.pop(), urdds.is_empty()) {
        (Some(urdd), true) if urdd.verdict == Verdict::Unreadable => Err(urdd.reason),
        (Some(urdd), true) if out.file_name() == Some(OsStr::new(&urdd.path)) => Ok(urdd),
        _ => Err(Some(
            "{out} itself must be the URDD: one URDD, without a folder around it".to_owned(),
        )),
    }
}

/// The codes of findings, sorted.
pub(crate) fn codes<'a>(findings: impl Iterator<Item = &'a Finding>) -> Vec<String> {
    let codes: BTreeSet<&str> = findings.map(|finding| finding.code.as_str()).collect();
    codes.into_iter().map(str::to_owned).collect()
}
