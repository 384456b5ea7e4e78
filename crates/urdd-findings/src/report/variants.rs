//! Findings of one text at one place that several robots have: variants of a file, or robots that call one macro.

use std::collections::HashMap;

use urdd_format::index::Count;
use urdd_format::report::{Finding, Place, Report, Urdd};

use crate::run::{file_in, is_inside};

/// Maximum number of variants that are named.
const NAMED: usize = 3;

/// A file, a line and a column.
type FoundAt = (Option<String>, Option<Count>, Option<Count>);

/// The findings of a report that are one for people, by the numbers of their robots and their own.
pub(super) struct Variants<'a> {
    report: &'a Report,
    /// The robots with each text, by its first finding.
    first: HashMap<(usize, usize), Vec<usize>>,
    /// The first finding of each text that another finding repeats.
    repeated: HashMap<(usize, usize), (usize, usize)>,
}

impl<'a> Variants<'a> {
    /// Those of a report. `places` are the folders of its robots, if they are known; without them, only variants of one path
    /// are compared.
    pub(super) fn new(report: &'a Report, places: Option<&[String]>) -> Self {
        let at = |place: &Place| (place.file.clone(), place.line, place.column);
        Self::alike(report, places, |finding| finding.places.iter().map(at).collect())
    }

    /// As [`Variants::new`], where people see the first place of a finding alone.
    pub(super) fn by_first_place(report: &'a Report, places: &[String]) -> Self {
        Self::alike(report, Some(places), |_| Vec::new())
    }

    fn alike(
        report: &'a Report,
        places: Option<&[String]>,
        more: impl Fn(&Finding) -> Vec<FoundAt>,
    ) -> Self {
        let mut first: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
        let (mut repeated, mut known) = (HashMap::new(), HashMap::new());
        for (number, urdd) in report.urdds.iter().enumerate() {
            let mut times: HashMap<_, usize> = HashMap::new();
            for (own, finding) in urdd.findings.iter().enumerate() {
                let Some(file) = file(urdd, finding, places.map(|places| &places[number])) else {
                    continue;
                };
                let Finding { code, severity, line, column, message, .. } = finding;
                let key = (code, severity, file, line, column, message, more(finding));
                // A robot may have the same twice, from two calls of a macro.
                let nth = times.entry(key.clone()).or_default();
                *nth += 1;
                let begun = *known.entry((key, *nth)).or_insert((number, own));
                if begun != (number, own) {
                    repeated.insert((number, own), begun);
                    first.entry(begun).or_insert_with(|| vec![begun.0]).push(number);
                }
            }
        }
        Variants { report, first, repeated }
    }

    pub(super) fn robot(&self, robot: usize) -> &'a Urdd {
        &self.report.urdds[robot]
    }

    /// Whether an earlier robot has the same finding.
    pub(super) fn is_repeated(&self, robot: usize, finding: usize) -> bool {
        self.repeated.contains_key(&(robot, finding))
    }

    /// The robots that have a finding, in words; `None` if it is only its own. A repeated one has none.
    pub(super) fn words(&self, robot: usize, finding: usize) -> Option<String> {
        let robots = self.first.get(&(robot, finding))?;
        let own = &self.report.urdds[robot];
        let all = || robots.iter().map(|robot| &self.report.urdds[*robot]);
        let is_one_file = all().all(|one| one.path == own.path);
        let name = |one: &Urdd| match is_one_file {
            true => one.xacro_arguments.join(" "),
            false => one.label(),
        };
        let mut names: Vec<String> = all().take(NAMED).map(name).collect();
        if robots.len() > NAMED {
            names.push("…".to_owned());
        }
        let kind = if is_one_file { "variants" } else { "robots" };
        Some(format!("{} {kind}: {}", robots.len(), names.join(", ")))
    }

    /// The findings of a robot that earlier robots have: how many, and the first of these robots.
    pub(super) fn repeats(&self, robot: usize) -> Option<(usize, &'a Urdd)> {
        let findings = 0..self.report.urdds[robot].findings.len();
        let begun: Vec<usize> = findings
            .filter_map(|finding| self.repeated.get(&(robot, finding)))
            .map(|(robot, _)| *robot)
            .collect();
        Some((begun.len(), &self.report.urdds[*begun.iter().min()?]))
    }

    /// How many findings one stands for.
    pub(super) fn count(&self, robot: usize, finding: usize) -> usize {
        let own = self.report.urdds[robot].findings[finding].count.get();
        own * self.first.get(&(robot, finding)).map_or(1, Vec::len)
    }
}

/// What tells the file of a finding from others; `None` if it has no line, or is in no file.
fn file(urdd: &Urdd, finding: &Finding, place: Option<&String>) -> Option<String> {
    let file = finding.file.as_deref().filter(|_| finding.line.is_some())?;
    Some(match place {
        Some(place) if is_inside(place, Some(file)) => file_in(place, Some(file)),
        Some(place) => format!("{place}\n{file}"),
        None => format!("{}\n{file}", urdd.path),
    })
}
