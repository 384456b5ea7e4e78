//! The robots of two folders, compared one by one: each of the first with the one of the same label in the second.

use std::path::Path;

use serde_json::{Value, json};
use urdd_directory::cancellation::Cancelled;
use urdd_directory::file_type::FileType;
use urdd_format::diff_report::DiffReport;
use urdd_format::escape;
use urdd_source::robots::{Batch, BatchError, Job, find};
use urdd_source::{Settings, declared_of};

use crate::render::text;
use crate::side::{DiffError, Options, Side};
use crate::{compare, markdown};

/// A robot of two folders, and what became of it.
#[derive(Debug)]
pub struct RobotDifference {
    /// Its declared name, or else its file as seen from the folder, and its arguments for xacro.
    pub label: String,
    /// What became of it.
    pub outcome: Outcome,
}

/// What became of a robot.
#[derive(Debug)]
pub enum Outcome {
    /// Both folders have it: how it differs, if it does.
    Compared(Box<DiffReport>),
    /// Only the second folder has it.
    Added,
    /// Only the first folder has it.
    Removed,
    /// It cannot be read in one of them.
    Unreadable(String),
}

impl Outcome {
    fn word(&self) -> &'static str {
        match self {
            Outcome::Compared(report) if report.same => "same",
            Outcome::Compared(_) => "changed",
            Outcome::Added => "added",
            Outcome::Removed => "removed",
            Outcome::Unreadable(_) => "unreadable",
        }
    }
}

/// The robots of a folder.
pub struct Folder {
    batch: Batch,
    robots: Vec<(String, Job)>,
    settings: Settings,
}

impl Folder {
    /// Finds the robots: those that the settings declare, and the other files. `excludes` says which are left out, by their
    /// paths from the folder.
    ///
    /// # Errors
    /// If the folder cannot be searched, or has no robot.
    pub fn open(
        folder: &Path,
        settings: Settings,
        excludes: impl Fn(&str) -> bool,
    ) -> Result<Folder, BatchError> {
        let mut batch = find(&[folder.to_owned()], &settings)?;
        let jobs = std::mem::take(&mut batch.jobs).into_iter();
        let robots = jobs.filter_map(|job| {
            let inside = job.source.strip_prefix(folder).unwrap_or(&job.source);
            let path = inside.to_string_lossy().replace('\\', "/");
            if excludes(&path) {
                return None;
            }
            let mut declared = declared_of(&job.source, &settings.robots).into_iter();
            let declared = declared.find(|one| one.arguments == job.arguments);
            let mut words = vec![declared.and_then(|one| one.name).unwrap_or(path)];
            words.extend(job.arguments.iter().cloned());
            Some((words.join(" "), job))
        });
        Ok(Folder { robots: robots.collect(), batch, settings })
    }

    /// Opens a robot; `None` if the file turns out to be a part of robots.
    fn side(&self, job: &Job, without_findings: bool) -> Option<Result<Side, String>> {
        let is_xacro = FileType::Xacro.is_of(&job.source);
        if is_xacro && !self.settings.xacro.expand_urdf {
            let shown = job.source.display().to_string();
            let words = "a xacro file, which is a program: --xacro expands those in folders";
            return Some(Err(format!("{}: {words}", escape::line(&shown))));
        }
        let options = Options { urdf: job.settings(&self.settings), without_findings };
        match Side::open(&job.source, &options) {
            Err(DiffError::Urdf(error)) if self.batch.is_part(&job.source, &error) => None,
            opened => Some(opened.map_err(|error| error.to_string())),
        }
    }
}

/// Compares all robots of two folders, in the order of the first, then of the second. The tolerance is within its range.
///
/// # Errors
/// If it is cancelled.
pub fn compare_folders(
    before: &Folder,
    after: &Folder,
    without_findings: bool,
    tolerance: f64,
) -> Result<Vec<RobotDifference>, Cancelled> {
    let mut new: Vec<&(String, Job)> = after.robots.iter().collect();
    let mut found = Vec::new();
    for (label, job) in &before.robots {
        before.settings.cancellation.check()?;
        let at = new.iter().position(|(other, _)| other == label);
        let other = at.map(|at| &new.remove(at).1);
        let side = before.side(job, without_findings);
        let other = other.and_then(|other| after.side(other, without_findings));
        let outcome = match (side, other) {
            (None, None) => continue,
            (Some(Ok(a)), Some(Ok(b))) => match compare(&a, &b, tolerance) {
                Ok(report) => Outcome::Compared(Box::new(report)),
                Err(error) => Outcome::Unreadable(error.to_string()),
            },
            (Some(Err(a)), Some(Err(b))) if a != b => Outcome::Unreadable(format!("{a}\n{b}")),
            (Some(Err(error)), _) | (_, Some(Err(error))) => Outcome::Unreadable(error),
            (Some(Ok(_)), None) => Outcome::Removed,
            (None, Some(Ok(_))) => Outcome::Added,
        };
        found.push(RobotDifference { label: label.clone(), outcome });
    }
    for (label, job) in new {
        after.settings.cancellation.check()?;
        let outcome = match after.side(job, true) {
            None => continue,
            Some(Ok(_)) => Outcome::Added,
            Some(Err(error)) => Outcome::Unreadable(error),
        };
        found.push(RobotDifference { label: label.clone(), outcome });
    }
    before.settings.cancellation.check()?;
    Ok(found)
}

/// The exit status: 2 if a robot could not be read, 1 if one differs.
pub fn status(all: &[RobotDifference]) -> u8 {
    let of = |word: &str| all.iter().any(|one| one.outcome.word() == word);
    match of("unreadable") {
        true => 2,
        false => u8::from(of("changed") || of("added") || of("removed")),
    }
}

/// All robots as text, each under its label; those without a difference on one line.
pub fn folders_text(all: &[RobotDifference]) -> String {
    rendered(all, |label, word| format!("== {label}: {word}\n"), text)
}

/// All robots as Markdown, likewise.
pub fn folders_markdown(all: &[RobotDifference]) -> String {
    let head = |label: &str, word: &str| format!("## {}: {word}\n\n", escape::code_span(label));
    rendered(all, head, markdown)
}

fn rendered(
    all: &[RobotDifference],
    head: impl Fn(&str, &str) -> String,
    body: impl Fn(&DiffReport) -> String,
) -> String {
    let mut whole = String::new();
    for RobotDifference { label, outcome } in all {
        whole += &head(&escape::line(label), outcome.word());
        match outcome {
            Outcome::Compared(report) if !report.same => whole += &format!("{}\n", body(report)),
            Outcome::Unreadable(reason) => whole += &format!("{reason}\n\n"),
            _ => {}
        }
    }
    let count = |word: &str| all.iter().filter(|one| one.outcome.word() == word).count();
    let words = ["same", "changed", "added", "removed", "unreadable"];
    let counts: Vec<String> = words.iter().map(|word| format!("{} {word}", count(word))).collect();
    let robots = urdd_format::readable::counted(all.len(), "robot");
    whole + &format!("{robots}: {}\n", counts.join(", "))
}

/// All robots as a JSON list: `label`, `presence`, the `report` of one that both folders have, and the `reason` of one that
/// cannot be read.
///
/// # Errors
/// If a number cannot be written.
pub fn folders_json(all: &[RobotDifference]) -> serde_json::Result<Value> {
    let one = |RobotDifference { label, outcome }: &RobotDifference| {
        let (report, reason) = match outcome {
            Outcome::Compared(report) => (serde_json::to_value(report)?, None),
            Outcome::Unreadable(reason) => (Value::Null, Some(reason)),
            Outcome::Added | Outcome::Removed => (Value::Null, None),
        };
        Ok(
            json!({ "label": label, "presence": outcome.word(), "report": report, "reason": reason }),
        )
    };
    all.iter().map(one).collect()
}
