//! The output of `urdd generate`: results, notes, and progress on a terminal.

use std::collections::BTreeMap;
use std::io::IsTerminal;

use clap::ValueEnum;
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use parking_lot::Mutex;
use serde_json::{Value, json};

use super::output::{self, Failure};
use urdd_format::escape;
use urdd_format::readable::counted;
use urdd_format::registry::ModuleKind;
use urdd_generate::batch::Observer;
use urdd_generate::combine::{CombineError, Combined};
use urdd_generate::note::{Note, NoteKind};
use urdd_generate::{GenerateError, Generated, MeshCount, Progress, SourceError};
use urdd_source::robots::Job;

/// Exit status: a robot could not be made.
pub(super) const FAILED: u8 = 1;

/// Maximum number of notes of a kind that are printed individually.
const MAX_NOTES: usize = 3;

/// How results are written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ResultFormat {
    /// Text for people.
    Human,
    /// JSON lines: one object per robot, and after a batch one with the totals.
    Json,
}

pub(super) struct Printer {
    format: ResultFormat,
    is_batch: bool,
    /// Progress on a terminal: one bar for the batch, one for each robot in progress.
    bars: MultiProgress,
    batch: ProgressBar,
    unprinted: Mutex<Option<String>>,
    totals: Mutex<Totals>,
}

#[derive(Default)]
struct Totals {
    unchanged: usize,
    meshes: MeshCount,
}

impl Printer {
    pub(super) fn new(format: ResultFormat, is_batch: bool) -> Self {
        let target = match std::io::stderr().is_terminal() && !output::is_dumb() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let (bars, batch) = (MultiProgress::with_draw_target(target), ProgressBar::hidden());
        let (unprinted, totals) = (Mutex::new(None), Mutex::default());
        Printer { format, is_batch, bars, batch, unprinted, totals }
    }

    /// Begins a batch of `total` robots.
    pub(super) fn begin_batch(&self, total: usize) {
        let bar = self.bars.add(self.batch.clone());
        bar.set_length(total as u64);
        bar.set_style(style("{bar:30} {pos}/{len} robots, {elapsed}"));
    }

    pub(super) fn end(&self, total: usize, failed: usize) {
        self.batch.finish_and_clear();
        let totals = self.totals.lock();
        let unchanged = totals.unchanged;
        let generated = total - failed - unchanged;
        self.print(&match self.format {
            ResultFormat::Json => line(&json!({"summary": {
                "robots": total, "generated": generated, "unchanged": unchanged, "failed": failed,
                "meshes": { "named": totals.meshes.named, "not_found": totals.meshes.not_found },
            }})),
            ResultFormat::Human => {
                let robots = counted(total, "robot");
                let meshes = not_found(totals.meshes);
                format!(
                    "{robots}: {generated} generated, {unchanged} unchanged, {failed} failed{meshes}\n"
                )
            }
        });
    }

    /// Prints the result of a combination, or its error.
    pub(super) fn combined(&self, job: &Job, outcome: &Result<Combined, CombineError>) {
        match (self.format, outcome) {
            (ResultFormat::Json, Ok(made)) => self.print(&line(&combined_as_json(job, made))),
            (ResultFormat::Json, Err(error)) => {
                self.print(&line(&failure(job, error.code(), error)))
            }
            (ResultFormat::Human, Ok(made)) => {
                self.print(&summary(job, &made.generated));
                let notes = made.notes.iter().map(|note| format!("note: {note}"));
                for text in notes.chain(note_lines(&made.generated.notes, false)) {
                    self.error(&text);
                }
            }
            (ResultFormat::Human, Err(CombineError::Generate { id: None, error })) => {
                self.error(&message(error));
            }
            (ResultFormat::Human, Err(error)) => self.error(&error.to_string()),
        }
    }

    /// Prints to standard output, with the bars hidden meanwhile.
    fn print(&self, text: &str) {
        if let Err(message) = self.bars.suspend(|| output::print(text)) {
            self.unprinted.lock().get_or_insert(message);
        }
    }

    /// The exit status, or the first error of printing a result.
    pub(super) fn status(&self, has_failed: bool) -> Result<u8, Failure> {
        match self.unprinted.lock().take() {
            Some(message) => Err(message.into()),
            None => Ok(if has_failed { FAILED } else { 0 }),
        }
    }

    fn error(&self, text: &str) {
        self.bars.suspend(|| output::error(text));
    }
}

impl Observer for Printer {
    fn begin(&self, job: &Job) -> Box<dyn Progress> {
        let bar = self.bars.add(ProgressBar::new(1));
        bar.set_style(style("  {spinner} {prefix} {bar:20} {msg}"));
        bar.set_prefix(escape::line(&job.name).into_owned());
        Box::new(RobotBar(bar))
    }

    fn done(&self, job: &Job, outcome: &Result<Generated, GenerateError>) {
        self.batch.inc(1);
        if let Ok(made) = outcome {
            let mut totals = self.totals.lock();
            totals.unchanged += usize::from(!made.changed);
            totals.meshes.named += made.meshes.named;
            totals.meshes.not_found += made.meshes.not_found;
            totals.meshes.not_a_mesh += made.meshes.not_a_mesh;
        }
        match (self.format, outcome) {
            (ResultFormat::Json, Ok(made)) => self.print(&line(&as_json(job, made))),
            (ResultFormat::Json, Err(error)) => {
                let mut failed = failure(job, error.code(), error);
                failed["error"]["faults"] = faults(error).into();
                self.print(&line(&failed));
            }
            (ResultFormat::Human, Ok(made)) => {
                self.print(&summary(job, made));
                for text in note_lines(&made.notes, self.is_batch) {
                    self.error(&text);
                }
            }
            (ResultFormat::Human, Err(error)) => self.error(&message(error)),
        }
    }
}

/// The error message on one line, except for errors that have several lines.
fn message(error: &GenerateError) -> String {
    let text = error.to_string();
    match error {
        GenerateError::Source(SourceError::Refused { .. } | SourceError::Xacro { .. })
        | GenerateError::Outside { .. }
        | GenerateError::Strict { .. } => text,
        _ => escape::line(&text).into_owned(),
    }
}

/// The bar of a robot, removed when the robot is finished.
struct RobotBar(ProgressBar);

impl Progress for RobotBar {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        self.0.set_length(total as u64);
        self.0.set_position(done as u64);
        self.0.set_message(kind.name());
    }

    fn part(&self, kind: ModuleKind, done: usize, total: usize) {
        self.0.set_message(format!("{}, step {done} of {total}", kind.name()));
    }
}

impl Drop for RobotBar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn line(value: &Value) -> String {
    escape::json(&value.to_string()).into_owned() + "\n"
}

/// The part of a summary about missing meshes. `not_a_mesh` of those `not_found` are there.
fn not_found(MeshCount { named, not_found, not_a_mesh, .. }: MeshCount) -> String {
    let part = |count: usize, one: &str, more: &str| match count {
        0 => String::new(),
        1 => format!("; 1 of {named} meshes {one}"),
        _ => format!("; {count} of {named} meshes {more}"),
    };
    let missing = part(not_found - not_a_mesh, "was not found", "were not found");
    missing + &part(not_a_mesh, "is empty or not a mesh", "are empty or not meshes")
}

fn summary(job: &Job, made: &Generated) -> String {
    let kept = made.modules.iter().filter(|module| module.kept).count();
    let mut text = format!(
        "{}: {}, {}, {}; {}",
        escape::line(&job.name),
        counted(made.num_links, "link"),
        counted(made.num_joints, "joint"),
        counted(made.num_dofs, "DOF"),
        counted(made.modules.len(), "module"),
    );
    if !made.changed {
        text += ", unchanged";
    } else if kept > 0 {
        text += &format!(", {kept} of them kept");
    }
    text += &not_found(made.meshes);
    if made.meshes.not_usable > 0 {
        let (count, named) = (made.meshes.not_usable, made.meshes.named);
        text += &format!("; {count} of {named} meshes cannot be used");
    }
    text + "\n"
}

/// Notes as lines. Folds many notes of a kind into one line; in a batch, all notes of a kind.
fn note_lines(notes: &[Note], is_batch: bool) -> Vec<String> {
    let mut by_kind: BTreeMap<NoteKind, Vec<&Note>> = BTreeMap::new();
    for note in notes {
        by_kind.entry(note.kind).or_default().push(note);
    }
    let most = if is_batch { 1 } else { MAX_NOTES };
    let mut lines = Vec::new();
    for (kind, notes) in by_kind {
        // Folding a single remaining note would not save a line.
        let shown = if notes.len() <= most + 1 { notes.len() } else { most };
        lines.extend(notes[..shown].iter().map(|note| format!("note: {note}")));
        if shown < notes.len() {
            let more = notes.len() - shown;
            lines.push(format!(
                "note: and {more} more of this kind ({}); --format json lists them all",
                kind.as_str()
            ));
        }
    }
    lines
}

fn as_json(job: &Job, made: &Generated) -> Value {
    json!({
        "source": job.source.display().to_string(),
        "output": job.name,
        "status": if made.changed { "generated" } else { "unchanged" },
        "robot": made.robot_name,
        "links": made.num_links,
        "joints": made.num_joints,
        "dofs": made.num_dofs,
        "class": made.class,
        "modules": made.modules.iter().map(|module| json!({
            "name": module.kind.name(), "kept": module.kept,
        })).collect::<Vec<_>>(),
        "meshes": {
            "named": made.meshes.named,
            "not_found": made.meshes.not_found,
            "not_usable": made.meshes.not_usable,
        },
        "notes": made.notes.iter().map(note_as_json).collect::<Vec<_>>(),
    })
}

fn failure(job: &Job, code: &str, error: &impl ToString) -> Value {
    json!({
        "source": job.source.display().to_string(),
        "output": job.name,
        "status": "failed",
        "error": { "code": code, "message": error.to_string() },
    })
}

fn combined_as_json(job: &Job, made: &Combined) -> Value {
    let mut object = as_json(job, &made.generated);
    let parts = made.composition.parts.iter();
    object["parts"] = parts
        .map(|part| json!({ "id": part.id, "name": part.name, "links": part.links.len() }))
        .collect();
    let notes = made.notes.iter();
    object["combine_notes"] =
        notes.map(|note| json!({ "kind": note.kind, "message": note.to_string() })).collect();
    object
}

fn note_as_json(note: &Note) -> Value {
    json!({
        "kind": note.kind.as_str(),
        "file": note.file,
        "line": note.line,
        "column": note.column,
        "problem": note.problem,
        "assumed": note.assumed,
    })
}

fn faults(error: &GenerateError) -> Vec<Value> {
    let faults = match error {
        GenerateError::Source(SourceError::Refused { faults, .. }) => faults.as_slice(),
        _ => &[],
    };
    faults
        .iter()
        .map(|placed| {
            let message = placed.fault.to_string();
            let mut fault =
                json!({ "line": placed.line, "column": placed.column, "message": message });
            // Another than that of the robot.
            if let Some(file) = &placed.file {
                fault["file"] = json!(file);
            }
            fault
        })
        .collect()
}
