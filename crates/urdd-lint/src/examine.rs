//! Runs the rules on a text: those of the validator that need only the source, and the family LNT.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use roxmltree::Document;

use super::refusal::refusal;
use super::rule::{Description, LintRule};
use super::settings::LintSettings;
use super::subject::Subject;
use super::{allow, consequences, rules};
use urdd_directory::read_error::ReadError;
use urdd_directory::root::Root;
use urdd_directory::source::Memory;
use urdd_format::index::Count;
use urdd_format::report::{Kind, Place, StaleIgnore};
use urdd_generate::{SourceMeshes, open_source_text, well_formed};
use urdd_validate::Examined;
use urdd_validate::code::Code;
use urdd_validate::engine::{Check, Outcome, caught};
use urdd_validate::finding::{Finding, Findings};
use urdd_validate::selection::Codes;
use urdd_validate::skip::SkipReason;

/// The family of this crate's rules.
const FAMILY: &str = "LNT";

/// A text as the rules see it.
#[derive(Clone, Copy)]
struct Job<'a> {
    text: &'a str,
    name: &'a str,
    folder: &'a Path,
    settings: &'a LintSettings,
}

/// The result, and the comments that allow what was not found. `name` is the file's in the report; relative mesh names
/// refer to `folder`.
pub fn examined(
    text: &str,
    name: &str,
    folder: &Path,
    settings: &LintSettings,
) -> (Examined, Vec<StaleIgnore>) {
    let job = Job { text, name, folder, settings };
    let mut examined = by_validator(text, name);
    // URD011 says what is wrong; the rest can be looked at nevertheless.
    let (mended, lines) = match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Ok(_) => (Cow::Borrowed(text), 0),
        Err(_) => {
            let (mended, lines) = well_formed(text);
            (Cow::Owned(mended), lines)
        }
    };
    let Ok(document) = urdd_xml::parse(&mended, urdd_xml::Kind::Robot) else {
        let skipped = rules_to_run(settings)
            .map(|rule| skipped(&rule.description, SkipReason::Failed(Code::URD011)));
        examined.checks.extend(skipped);
        return (examined, Vec::new());
    };
    let of_mended = match &mended {
        Cow::Owned(mended) => complete(&mut examined, by_validator(mended, name)),
        Cow::Borrowed(_) => Vec::new(),
    };
    let source = job.source(&examined.checks);
    let subject = job.subject(&document, &source);
    job.run(&subject, &mut examined.checks);
    let is_mended = matches!(mended, Cow::Owned(_));
    let is_of_mended = |check: &&mut Check| {
        let code = check.rule.code;
        code.family() == FAMILY || of_mended.contains(&code)
    };
    for check in examined.checks.iter_mut().filter(is_of_mended) {
        for place in check.findings.iter_mut().flat_map(places) {
            as_reported(place, lines, is_mended);
        }
    }
    consequences::mark(&mut examined.checks);
    if !is_mended {
        consequences::mark_misspelt(&subject, &mut examined.checks, |text| job.again(text));
    }
    let stale = allow::apply(&document, name, &mut examined.checks);
    (examined, stale)
}

impl<'a> Job<'a> {
    /// The robot with its mesh files, or why there is none. `checks` are those of the validator.
    fn source(self, checks: &[Check]) -> Result<SourceMeshes, SkipReason> {
        let source = open_source_text(self.text, self.name, self.folder, &self.settings.source);
        source.map_err(|error| refusal(&error, checks))
    }

    fn subject<'d>(
        self,
        document: &'d Document<'d>,
        source: &'d Result<SourceMeshes, SkipReason>,
    ) -> Subject<'d>
    where
        'a: 'd,
    {
        let subject = Subject::new(self.name, self.folder, document, source.as_ref());
        subject.without_meshes(self.settings.without_meshes)
    }

    /// Runs the rules of the family LNT after those of the validator.
    fn run(self, subject: &Subject, checks: &mut Vec<Check>) {
        let is_macro = subject.macros().is_some();
        if is_macro {
            // LNT051 says it all: what others find is about the text of macros.
            let ran = |check: &&mut Check| !matches!(check.outcome, Outcome::Crashed(_));
            for check in checks.iter_mut().filter(ran) {
                *check = skipped(check.rule, SkipReason::NotExpanded);
            }
        }
        for rule in rules_to_run(self.settings) {
            if self.settings.report.cancellation.is_cancelled() {
                break;
            }
            let description = &rule.description;
            checks.push(match is_macro && description.code != Code::LNT051 {
                true => skipped(description, SkipReason::NotExpanded),
                false => caught(description, &mut Findings::default(), |findings| {
                    (rule.check)(subject, findings)
                }),
            });
        }
    }

    /// What all rules find in another text; `None` if it is no XML.
    fn again(self, text: &str) -> Option<Vec<Check>> {
        let job = Job { text, ..self };
        let document = urdd_xml::parse(text, urdd_xml::Kind::Robot).ok()?;
        let mut checks = by_validator(text, self.name).checks;
        let source = job.source(&checks);
        job.run(&job.subject(&document, &source), &mut checks);
        Some(checks)
    }
}

/// The rules of the family that the settings ask for.
fn rules_to_run(settings: &LintSettings) -> impl Iterator<Item = &'static LintRule> {
    let report = &settings.report;
    let runs = |rule: &&LintRule| {
        let code = rule.description.code;
        let select = &report.selection.select;
        let is_selected = select.is_empty() || select.iter().any(|codes| codes.holds(code));
        let is_named = select.contains(&Codes::One(code)) || report.severities.contains_key(&code);
        is_selected && (rule.on_by_default || is_named)
    };
    rules::all().into_iter().filter(runs)
}

/// A rule that does not run.
fn skipped(rule: &'static Description, reason: SkipReason) -> Check {
    caught(rule, &mut Findings::default(), |findings| findings.skip(reason))
}

/// Takes over what rules say of the mended text that could not look at the text itself. Returns these rules.
fn complete(examined: &mut Examined, of_mended: Examined) -> Vec<Code> {
    let is_skipped = |check: &Check| matches!(check.outcome, Outcome::Skipped(_));
    let mut taken = Vec::new();
    for check in of_mended.checks.into_iter().filter(|check| !is_skipped(check)) {
        let mut known = examined.checks.iter_mut();
        let known = known.find(|known| known.rule.code == check.rule.code && is_skipped(known));
        if let Some(known) = known {
            taken.push(check.rule.code);
            *known = check;
        }
    }
    (examined.report.name, examined.report.size) = (of_mended.report.name, of_mended.report.size);
    taken
}

/// All places of a finding.
fn places(finding: &mut Finding) -> impl Iterator<Item = &mut Place> {
    std::iter::once(&mut finding.place).chain(&mut finding.more)
}

/// The pointers that findings are folded by are no pointers into a document. In a text that was mended, lines at the
/// beginning are missing, and fixes would not fit.
fn as_reported(place: &mut Place, lines: u32, is_mended: bool) {
    place.pointer = None;
    place.line = place.line.map(|line| Count(line.0 + lines));
    if is_mended {
        place.fixes.clear();
    }
    for related in &mut place.related {
        as_reported(related, lines, is_mended);
    }
}

/// What the validator says of the URDF alone.
fn by_validator(text: &str, name: &str) -> Examined {
    urdd_validate::caught(Kind::Urdf, name, || {
        let bytes: Arc<[u8]> = Arc::from(text.as_bytes());
        // Its own name could be one that no URDD may hold.
        const FILE: &str = "robot.urdf";
        let memory = Memory::new(name, BTreeMap::from([(FILE.to_owned(), bytes)]));
        let memory = memory.map_err(|_| ReadError::Missing)?;
        let mut examined = urdd_validate::bare_urdf::examine_file(
            Root::of(memory),
            FILE,
            &urdd_validate::rules::all(),
        )?;
        examined.report.path = name.to_owned();
        for finding in examined.checks.iter_mut().flat_map(|check| &mut check.findings) {
            renamed(finding, name);
        }
        Ok(examined)
    })
}

fn renamed(finding: &mut Finding, name: &str) {
    for place in places(finding) {
        let related = place.related.iter_mut().map(|place| &mut place.file);
        let edits = place.fixes.iter_mut().flat_map(|fix| &mut fix.edits);
        edits.for_each(|edit| edit.file = name.to_owned());
        for file in related.chain([&mut place.file]).flatten() {
            *file = name.to_owned();
        }
    }
}
