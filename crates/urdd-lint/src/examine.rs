//! Runs the rules on a text: those of the validator that need only the source, and the family LNT.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use urdd_directory::position::LineIndex;
use urdd_findings::check::Examined;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::finding::{Finding, Findings};
use urdd_findings::part::SkipReason;
use urdd_findings::selection::Codes;
use urdd_format::index::Count;
use urdd_format::report::{Place, StaleIgnore};
use urdd_programs::Fault;
use urdd_source::{Original, Repaired, SourceMeshes, mend_xml};
use urdd_validate::examine_urdf;
use urdd_xml::Xml;

use crate::beside::SrdfFile;
use crate::programs::Asked;
use crate::programs::attach::{attach, attach_to};
use crate::rules::prelude::LintRule;
use crate::settings::{LintSettings, NOT_EXPANDED, refusal};
use crate::subject::Subject;
use crate::written::say_where_expanded;
use crate::{fixes, rounding, rules, told};

const FAMILY: &str = "LNT";
/// The rules that say what other rules do not see of what programs do.
const OF_PROGRAMS: [Code; 2] = [Code::LNT060, Code::LNT061];

/// A text as the rules see it.
#[derive(Clone, Copy)]
struct Job<'a> {
    xml: &'a Xml<'a>,
    /// The file, if its bytes are not those of the text.
    original: Option<&'a Original>,
    name: &'a str,
    folder: &'a Path,
    settings: &'a LintSettings,
    /// The SRDFs around the file, which are the same for all texts of it.
    srdfs: &'a OnceLock<Vec<SrdfFile>>,
}

/// What comes of a text.
pub struct Examination {
    /// The result.
    pub examined: Examined,
    /// The comments that allow what was not found.
    pub stale: Vec<StaleIgnore>,
    /// The SRDFs of the robot.
    pub srdfs: Vec<PathBuf>,
}

impl Examination {
    /// A result of nothing but itself.
    pub fn alone(examined: Examined) -> Self {
        Examination { examined, stale: Vec::new(), srdfs: Vec::new() }
    }
}

/// Examines a text. `original` is the file, if its bytes are not those of the
/// text; `name` is the file's in the report; relative mesh names refer to `folder`.
pub fn examined(
    xml: &Xml<'_>,
    original: Option<&Original>,
    name: &str,
    folder: &Path,
    settings: &LintSettings,
) -> Examination {
    let srdfs = OnceLock::new();
    let job = Job { xml, original, name, folder, settings, srdfs: &srdfs };
    let mut examined = examine_urdf(xml, name);
    // URD011 says what is wrong; the rest can be looked at nevertheless.
    let mended = match xml.document() {
        Ok(_) => Repaired::default(),
        Err(_) => mend_xml(xml),
    };
    let of_mended = mended.text.as_deref().map(Xml::new);
    let Ok(document) = of_mended.as_ref().unwrap_or(xml).document() else {
        let found = job.ask().map_or_else(Vec::new, |mut asked| {
            let is_xml = |fault: &Fault| matches!(fault, Fault::Xml(_));
            let lines = LineIndex::new(xml.text());
            let at = |offset: usize, message| {
                Finding::in_file(name, message).position(Some(lines.position(offset)))
            };
            let left = attach_to(Code::URD011, &mut asked, &mut examined.checks, is_xml, at);
            examined.report.programs = asked.results;
            left
        });
        // What only programs name is known of a text that cannot be mended.
        let checked = rules_to_run(settings).map(|LintRule { description: rule, .. }| {
            let its = found.iter().filter(|(code, _)| *code == rule.code);
            let its: Vec<Finding> = its.map(|(_, finding)| finding.clone()).collect();
            match its.is_empty() {
                true => Check::skipped(rule, SkipReason::Failed(Code::URD011)),
                false => Check::new(rule, Outcome::Failed, its),
            }
        });
        examined.checks.extend(checked);
        return Examination::alone(examined);
    };
    let taken = match &of_mended {
        Some(mended) => complete(&mut examined, examine_urdf(mended, name)),
        None => Vec::new(),
    };
    let source = job.source(&examined.checks);
    let subject = Subject::new(name, folder, document, source.as_ref(), settings, &srdfs);
    rounding::leave_out(&subject, &mut examined.checks);
    let is_mended = of_mended.is_some();
    job.run(&subject, &mut examined.checks, |checks| {
        let Some(mut asked) = job.ask() else { return Vec::new() };
        let left = match subject.macros() {
            Some(_) => {
                let at = |offset, message| subject.at_offset(offset, message);
                attach_to(Code::LNT051, &mut asked, checks, |_| true, at)
            }
            None => attach(&subject, &mut asked, checks, &mended.edits),
        };
        examined.report.programs = asked.results;
        left
    });
    let is_of_mended = |check: &&mut Check| {
        let code = check.rule.code;
        code.family() == FAMILY || taken.contains(&code)
    };
    for check in examined.checks.iter_mut().filter(is_of_mended) {
        for place in check.findings.iter_mut().flat_map(Finding::places_mut) {
            as_reported(place, mended.first_line, is_mended);
        }
        for effect in &mut check.effects {
            effect.at.line += mended.first_line;
            effect.cause.1.line += mended.first_line;
        }
    }
    for srdf in subject.srdfs.get().into_iter().flatten() {
        let file = srdf.file;
        if let Some(trail) = &file.trail {
            let expansion = (file.text.as_str(), trail, file.path.as_path(), file.shown.as_str());
            say_where_expanded(expansion, &mut examined.checks, &mut []);
        }
    }
    if is_mended {
        fixes::declare(xml, name, &mut examined.checks);
    }
    told::mark(&mut examined.checks);
    if !is_mended {
        told::mark_misspelt(&subject, &mut examined.checks, |text, with_programs| {
            job.again(text, with_programs)
        });
    }
    let stale = told::allow(document, name, &mut examined.checks);
    let of_robot = subject.srdfs.get().into_iter().flatten();
    Examination { examined, stale, srdfs: of_robot.map(|srdf| srdf.file.path.clone()).collect() }
}

impl Job<'_> {
    /// The robot with its mesh files, or why there is none. `checks` are those of the validator.
    fn source(self, checks: &[Check]) -> Result<SourceMeshes, SkipReason> {
        let settings = &self.settings.source;
        let source = SourceMeshes::of_xml(self.xml, self.name, self.folder, settings);
        source.map_err(|error| refusal(&error, checks))
    }

    /// Asks the programs; not about files beyond the limits of XML.
    fn ask(self) -> Option<Asked> {
        let text = self.xml.text();
        let bytes = self.original.map_or(text.as_bytes(), |original| &original.bytes);
        let counted = self.xml.counted(bytes).ok()?;
        let offsets = self.original.map(Original::offsets).unwrap_or_default();
        Some(Asked::about(counted, text, &offsets, self.folder, self.settings))
    }

    /// Runs the rules of the family LNT after those of the validator. `programs` gives the faults that only programs name,
    /// when the other rules have run.
    fn run(
        self,
        subject: &Subject,
        checks: &mut Vec<Check>,
        programs: impl FnOnce(&mut Vec<Check>) -> Vec<(Code, Finding)>,
    ) {
        let is_macro = subject.macros().is_some();
        if is_macro {
            // LNT051 says it all: what others find is about the text of macros.
            let ran = |check: &&mut Check| !matches!(check.outcome, Outcome::Crashed(_));
            for check in checks.iter_mut().filter(ran) {
                *check = Check::skipped(check.rule, NOT_EXPANDED);
            }
        }
        let is_of_programs = |rule: &&LintRule| OF_PROGRAMS.contains(&rule.description.code);
        let (last, first): (Vec<&LintRule>, Vec<_>) =
            rules_to_run(self.settings).partition(is_of_programs);
        let run = |rules: Vec<&'static LintRule>, checks: &mut Vec<Check>| {
            for rule in rules {
                if self.settings.source.cancellation.is_cancelled() {
                    break;
                }
                let description = &rule.description;
                checks.push(match is_macro && description.code != Code::LNT051 {
                    true => Check::skipped(description, NOT_EXPANDED),
                    false => Check::caught(description, &mut Findings::default(), |findings| {
                        (rule.check)(subject, findings)
                    }),
                });
            }
        };
        run(first, checks);
        // It is set once.
        let _ = subject.programs.set(programs(checks));
        run(last, checks);
        checks.sort_by_key(|check| check.rule.code);
    }

    /// What all rules find in another text, with what programs do because of it or without; `None` if it is no XML.
    fn again(self, text: &str, with_programs: bool) -> Option<Vec<Check>> {
        let xml = &Xml::new(text);
        let job = Job { xml, original: None, ..self };
        let document = xml.document().ok()?;
        let mut checks = examine_urdf(xml, self.name).checks;
        let source = job.source(&checks);
        let (folder, settings) = (self.folder, self.settings);
        let source = source.as_ref();
        let subject = Subject::new(self.name, folder, document, source, settings, self.srdfs);
        job.run(&subject, &mut checks, |checks| {
            let own: Vec<_> = checks.iter().map(|check| check.findings.clone()).collect();
            let Some(mut asked) = job.ask() else { return Vec::new() };
            let left = attach(&subject, &mut asked, checks, &[]);
            if !with_programs {
                let all = checks.iter_mut().zip(own);
                all.for_each(|(check, own)| check.findings = own);
            }
            left
        });
        Some(checks)
    }
}

/// The rules of the family that the settings ask for.
pub(crate) fn rules_to_run(settings: &LintSettings) -> impl Iterator<Item = &'static LintRule> {
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
