//! What an import carried, otherwise, and lost.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::features::{ALL, Feature, Remark};
use super::model::Model;
use super::place::Place;
use super::refusal::Positions;
use urdd_format::carried::{self, How, Part, table};
use urdd_source::Format;
use urdd_source::note::{Note, NoteKind, SourcePlace};

/// What became of a description.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The name of the robot.
    pub robot: String,
    /// The format.
    pub format: Format,
    /// What it has: what, how many, and how it is carried.
    pub parts: Vec<Part>,
    /// What else a person has to know.
    pub remarks: Vec<Note>,
}

impl Report {
    /// The report on a model. `elsewhere` names the files that were read from outside of the description's folder.
    pub fn of(
        model: &Model,
        format: Format,
        positions: &Positions<'_>,
        elsewhere: &BTreeMap<PathBuf, String>,
    ) -> Self {
        let counted = ALL.iter().map(|feature| {
            let count = model.tally.number_of(*feature);
            (feature.name.to_owned(), count, how(*feature, format))
        });
        let mut parts: Vec<Part> =
            counted.filter(|(_, count, how)| *count > 0 && *how != How::Elsewhere).collect();
        let unread = model.tally.all_unread().iter();
        parts.extend(unread.map(|(name, count)| (name.clone(), *count, How::No)));
        let note = |remark: &Remark| {
            let (file, line, column) = positions.at(remark.place).unwrap_or_default();
            let place = SourcePlace { file: file.to_owned(), line, column };
            Note::at(place, NoteKind::Otherwise, &*remark.text, "")
        };
        let first = positions.at(Place::default()).map_or("", |(file, ..)| file);
        let outside = elsewhere.iter().map(|(path, why)| {
            let path = path.display();
            let problem = format!("{path} is outside of the description's folder and project");
            Note::of_file(first, NoteKind::Outside, problem, format!("read, {why}"))
        });
        let remarks = model.tally.remarks.iter().map(note).chain(outside).collect();
        Report { robot: model.name.clone(), format, parts, remarks }
    }

    /// What is lost: what, and how many.
    pub fn lost(&self) -> impl Iterator<Item = (&str, usize)> {
        let lost = self.parts.iter().filter(|(_, _, how)| *how == How::No);
        lost.map(|(name, count, _)| (name.as_str(), *count))
    }

    /// What is carried in another way: what, how many, and how.
    pub fn otherwise(&self) -> impl Iterator<Item = (&str, usize, &'static str)> {
        self.parts.iter().filter_map(|(name, count, how)| match how {
            How::Otherwise(how) => Some((name.as_str(), *count, *how)),
            _ => None,
        })
    }

    /// All that is lost or carried otherwise, as notes; `file` is the description.
    pub fn notes(&self, file: &str) -> Vec<Note> {
        let note = |kind, (what, count, how): (&str, usize, &str)| {
            Note::of_file(file, kind, format!("{what} ({count})"), how)
        };
        let lost = self.lost().map(|(what, count)| (what, count, "lost; a URDF cannot say it"));
        let lost = lost.map(|part| note(NoteKind::Lost, part));
        let otherwise = self.otherwise().map(|part| note(NoteKind::Otherwise, part));
        lost.chain(otherwise).chain(self.remarks.iter().cloned()).collect()
    }

    /// As JSON, with the keys of the report of an export.
    #[must_use]
    pub fn to_json(&self) -> String {
        let notes: Vec<String> = self.remarks.iter().map(ToString::to_string).collect();
        carried::report(&self.robot, self.format.name(), &self.parts, &notes)
    }
}

fn how(feature: Feature, format: Format) -> How {
    match format {
        Format::Mjcf => feature.mjcf,
        Format::Sdf => feature.sdf,
        Format::Usd => feature.usd,
    }
}

/// The table of docs/import.md, in Markdown.
#[must_use]
pub fn imported_table() -> String {
    let formats = Format::ALL.map(Format::name);
    let row = |feature: &'static Feature| (feature.name, Format::ALL.map(|of| how(*feature, of)));
    table(&formats, ALL.iter().map(row))
}
