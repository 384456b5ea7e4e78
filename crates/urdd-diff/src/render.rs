//! A comparison as text for people, and as Markdown for a pull request.

use urdd_format::diff_report::{
    DiffBox, DiffReport, DiffSide, DofDifference, FindingDifference, LinkDifference,
    ModuleDifference, PairChange, PairDifference, PartDifference, PoseDifference, Presence,
    ValueChange,
};
use urdd_format::escape;
use urdd_format::readable::{counted, metres, number};
use urdd_format::report::{Kind, Verdict};

/// Maximum length of Markdown in bytes: GitHub takes comments of 65,536 characters.
const MAX_BYTES: usize = 60_000;

/// A comparison as text. Names from the input are escaped.
pub fn text(report: &DiffReport) -> String {
    let line = |spans: &[Span]| line(spans, " -> ", |text| escape::line(text).into_owned());
    let mut out = String::new();
    for (word, of) in [("A", &report.before), ("B", &report.after)] {
        out.push_str(&format!("{word}  {}\n", line(&side(of))));
    }
    for section in sections(report) {
        out.push_str(&format!("\n{}\n", section.title));
        for Line { depth, spans } in &section.lines {
            let margin = "    ".repeat(*depth);
            out.push_str(&format!("  {margin}{}\n", line(spans)));
        }
    }
    out.push_str(&format!("\n{}\n", headline(report)));
    out
}

/// A comparison as Markdown. All text from the input is in code spans: no name becomes a link, a mention or HTML. Long
/// comparisons are cut; the last line says so.
pub fn markdown(report: &DiffReport) -> String {
    let line = |spans: &[Span]| line(spans, " → ", escape::code_span);
    let mut out = format!("### `urdd diff`: {}\n\n", headline(report));
    for (word, of) in [("A", &report.before), ("B", &report.after)] {
        out.push_str(&format!("- {word}: {}\n", line(&side(of))));
    }
    for section in sections(report) {
        let mut heading = format!("\n#### {}\n\n", section.title);
        for Line { depth, spans } in &section.lines {
            let margin = "  ".repeat(*depth);
            let next = format!("{heading}{margin}- {}\n", line(spans));
            if out.len() + next.len() > MAX_BYTES {
                out.push_str(
                    "\n*The rest is left out here. `urdd diff` without `--format markdown` prints all.*\n",
                );
                return out;
            }
            out.push_str(&next);
            heading.clear();
        }
    }
    out
}

fn line(spans: &[Span], arrow: &str, escaped: impl Fn(&str) -> String) -> String {
    let spans = spans.iter().map(|span| match span {
        Span::Words(text) => text.clone(),
        Span::Input(text) => escaped(text),
        Span::Arrow => arrow.to_owned(),
    });
    spans.collect()
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Span {
    /// Our own words.
    Words(String),
    /// A name, a path, a value or a message from the input.
    Input(String),
    /// From the value before to the value after.
    Arrow,
}

/// A line, and how far it is indented.
#[derive(Debug, Clone)]
struct Line {
    depth: usize,
    spans: Vec<Span>,
}

#[derive(Debug)]
struct Section {
    title: &'static str,
    lines: Vec<Line>,
}

fn words(text: impl Into<String>) -> Span {
    Span::Words(text.into())
}

fn input(text: &str) -> Span {
    Span::Input(text.to_owned())
}

/// Number of differences: entries of all lists but the notes.
pub fn count(report: &DiffReport) -> usize {
    let lists = [
        report.robot.len(),
        report.links.len(),
        report.joints.len(),
        report.materials.len(),
        report.other_elements.len(),
        report.loops.len(),
        usize::from(report.poses.is_some()),
        report.dofs.len(),
        report.pairs.as_ref().map_or(0, Vec::len),
        report.srdf.as_ref().map_or(0, Vec::len),
        report.setup.as_ref().map_or(0, Vec::len),
        report.lost.as_ref().map_or(0, Vec::len),
        report.configurations.as_ref().map_or(0, Vec::len),
        report.modules.as_ref().map_or(0, Vec::len),
        report.findings.as_ref().map_or(0, Vec::len),
    ];
    lists.iter().sum()
}

/// The result in a sentence.
fn headline(report: &DiffReport) -> String {
    match count(report) {
        0 => "no difference in meaning".to_owned(),
        count => counted(count, "difference"),
    }
}

/// A robot in a line.
fn side(side: &DiffSide) -> Vec<Span> {
    let kind = match side.kind {
        Kind::Urdd => "URDD",
        Kind::Urdf => "URDF",
    };
    let verdict = match side.verdict {
        None => "",
        Some(Verdict::Pass) => ", valid",
        Some(Verdict::Fail) => ", not valid",
        Some(Verdict::Unreadable | Verdict::Incomplete) => ", not validated",
    };
    let counted = |count: u32, one: &str| match count {
        1 => format!("1 {one}"),
        count => format!("{count} {one}s"),
    };
    vec![
        input(&side.path),
        words(format!(": {kind}, robot ")),
        input(&side.name),
        words(format!(
            ", {}, {}, {}{verdict}",
            counted(side.links.0, "link"),
            counted(side.joints.0, "joint"),
            counted(side.dofs.0, "DOF")
        )),
    ]
}

/// All sections with differences, then the notes.
fn sections(report: &DiffReport) -> Vec<Section> {
    let mut sections = Vec::new();
    let mut add = |title: &'static str, lines: Vec<Line>| {
        if !lines.is_empty() {
            sections.push(Section { title, lines });
        }
    };
    add("Robot", report.robot.iter().map(|it| change(0, it)).collect());
    add("Links", links(&report.links));
    add("Joints", parts(&report.joints));
    add("Materials", parts(&report.materials));
    add("Other elements", parts(&report.other_elements));
    add("Loops", parts(&report.loops));
    add("Poses with all joints at zero", report.poses.iter().map(poses).collect());
    add("DOFs", dofs(&report.dofs));
    add("Pairs of links in collision checks", pairs(report.pairs.as_deref().unwrap_or_default()));
    add("Named configurations", parts(report.configurations.as_deref().unwrap_or_default()));
    add("SRDF", parts(report.srdf.as_deref().unwrap_or_default()));
    add("What exports need", parts(report.setup.as_deref().unwrap_or_default()));
    add("Lost in the imports", parts(report.lost.as_deref().unwrap_or_default()));
    add("Modules", modules(report.modules.as_deref().unwrap_or_default()));
    add("Findings", findings(report.findings.as_deref().unwrap_or_default()));
    let note = |note: &String| Line { depth: 0, spans: vec![input(note)] };
    add("Notes", report.notes.iter().map(note).collect());
    sections
}

fn change(depth: usize, change: &ValueChange) -> Line {
    let one = |side: &Option<String>| match side {
        Some(text) if text.is_empty() => words("empty"),
        Some(text) => input(text),
        None => words("absent"),
    };
    let unit = || match change.unit.as_str() {
        "" => words(""),
        unit => words(format!(" {unit}")),
    };
    let mut spans = vec![input(&change.field), words(": "), one(&change.before)];
    if change.after.is_none() {
        spans.push(unit());
    }
    spans.extend([Span::Arrow, one(&change.after)]);
    if change.after.is_some() {
        spans.push(unit());
    }
    Line { depth, spans }
}

/// The parts that only one of the robots has: a line of those removed, a line of those added.
fn in_one<'a>(parts: impl Iterator<Item = (Presence, &'a str)> + Clone) -> Vec<Line> {
    let list = |word: &str, presence: Presence| {
        let mut spans = Vec::new();
        for (_, text) in parts.clone().filter(|part| part.0 == presence) {
            spans.push(words(if spans.is_empty() { format!("{word}: ") } else { ", ".to_owned() }));
            spans.push(input(text));
        }
        (!spans.is_empty()).then_some(Line { depth: 0, spans })
    };
    let lines = [list("removed", Presence::Removed), list("added", Presence::Added)];
    lines.into_iter().flatten().collect()
}

/// The name of a part that both robots have, and the values that differ.
fn in_both<'a>(part: &str, changes: &'a [ValueChange]) -> impl Iterator<Item = Line> + use<'a> {
    let spans = vec![input(part)];
    let changes = changes.iter().map(|it| change(1, it));
    std::iter::once(Line { depth: 0, spans }).chain(changes)
}

fn links(links: &[LinkDifference]) -> Vec<Line> {
    let mut lines = in_one(links.iter().map(|it| (it.presence, it.name.as_str())));
    for link in links.iter().filter(|link| link.presence == Presence::Changed) {
        lines.extend(in_both(&link.name, &link.changes));
        for geometry in &link.geometry {
            lines.extend(geometry.changes.iter().map(|it| change(1, it)));
            let kind = geometry.geometry.as_str().to_lowercase();
            let is_mesh = |change: &ValueChange| change.field.ends_with(".mesh");
            let is_mesh_changed = geometry.changes.iter().any(is_mesh);
            let boxes @ [a, b] = [&geometry.bounds_before, &geometry.bounds_after];
            let mut spans = vec![words(format!("bounding box of the {kind} geometry: "))];
            if a != b {
                let [a, b] = boxes.map(|of| words(bounds(of.as_ref())));
                spans.extend([a, Span::Arrow, b]);
            } else if a.is_some() && is_mesh_changed {
                spans.push(words("unchanged"));
            } else {
                continue;
            }
            lines.push(Line { depth: 1, spans });
        }
    }
    lines
}

fn bounds(of: Option<&DiffBox>) -> String {
    let Some(of) = of else { return "not known".to_owned() };
    let axis = |axis: usize| format!("{}..{}", number(of.min[axis], 5), number(of.max[axis], 5));
    format!("x {}, y {}, z {} m", axis(0), axis(1), axis(2))
}

fn parts(parts: &[PartDifference]) -> Vec<Line> {
    let mut lines = in_one(parts.iter().map(|it| (it.presence, it.name.as_str())));
    for part in parts.iter().filter(|part| part.presence == Presence::Changed) {
        lines.extend(in_both(&part.name, &part.changes));
    }
    lines
}

fn poses(poses: &PoseDifference) -> Line {
    let angle = match poses.angle {
        angle if angle > 1e-9 => format!(", turned by at most {} rad", number(angle, 3)),
        _ => String::new(),
    };
    let count = match poses.links.len() {
        1 => "1 link is elsewhere: ".to_owned(),
        count => format!("{count} links are elsewhere, the farthest of them "),
    };
    let place = words(format!(", by {}{angle}", metres(poses.distance)));
    Line { depth: 0, spans: vec![words(count), input(&poses.farthest), place] }
}

fn dofs(dofs: &[DofDifference]) -> Vec<Line> {
    let mut lines = in_one(dofs.iter().map(|it| (it.presence, it.name.as_str())));
    let both = || dofs.iter().filter(|dof| dof.presence == Presence::Changed);
    let mut moved = Vec::new();
    for dof in both().filter(|dof| dof.index_before != dof.index_after) {
        if let (Some(a), Some(b)) = (dof.index_before, dof.index_after) {
            moved.push(words(if moved.is_empty() { "index: " } else { ", " }));
            moved.push(input(&dof.name));
            moved.push(words(format!(" {}", a.0)));
            moved.push(Span::Arrow);
            moved.push(words(b.0.to_string()));
        }
    }
    if !moved.is_empty() {
        lines.push(Line { depth: 0, spans: moved });
    }
    for dof in both().filter(|dof| !dof.changes.is_empty()) {
        lines.extend(in_both(&dof.name, &dof.changes));
    }
    lines
}

fn pairs(pairs: &[PairDifference]) -> Vec<Line> {
    let lines = pairs.iter().map(|pair| {
        let word = match pair.change {
            PairChange::Gained => "checked now: ",
            PairChange::Lost => "skipped now: ",
            PairChange::Pieces => "other pieces are checked: ",
        };
        let kinds = match pair.shapes.len() {
            6 => "all kinds of shapes".to_owned(),
            _ => pair.shapes.join(", "),
        };
        let [a, b] = &pair.links;
        let kinds = words(format!(" ({kinds})"));
        Line { depth: 0, spans: vec![words(word), input(a), words(" - "), input(b), kinds] }
    });
    lines.collect()
}

fn modules(modules: &[ModuleDifference]) -> Vec<Line> {
    let lines = modules.iter().map(|module| {
        let mut spans = vec![input(&module.name)];
        match module.presence {
            Presence::Removed => spans.push(words(": removed")),
            Presence::Added => spans.push(words(": added")),
            Presence::Changed => {
                let mut what = Vec::new();
                if module.version_before != module.version_after {
                    let version = |version: &Option<String>| match version {
                        Some(version) => input(version),
                        None => words("none"),
                    };
                    spans.push(words(": version "));
                    spans.push(version(&module.version_before));
                    spans.push(Span::Arrow);
                    spans.push(version(&module.version_after));
                }
                if module.document {
                    what.push("document");
                }
                if module.files {
                    what.push("files");
                }
                if !what.is_empty() {
                    spans.push(words(format!(": other {}", what.join(" and "))));
                }
            }
        }
        Line { depth: 0, spans }
    });
    lines.collect()
}

fn findings(findings: &[FindingDifference]) -> Vec<Line> {
    let lines = findings.iter().map(|finding| {
        let word = match finding.presence {
            Presence::Removed => "gone",
            _ => "new",
        };
        let count = match finding.count.0 {
            1 => String::new(),
            count => format!(" ({count} places)"),
        };
        let mut spans =
            vec![words(format!("{word}: {} {}{count}", finding.severity, finding.code))];
        if let Some(subject) = &finding.subject {
            spans.extend([words(", "), input(subject)]);
        }
        spans.extend([words(": "), input(&finding.message)]);
        Line { depth: 0, spans }
    });
    lines.collect()
}
