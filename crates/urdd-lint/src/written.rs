//! Says of findings where what they are about is written, in a file that a person has.

use std::path::Path;

use urdd_directory::position::Position;
use urdd_findings::check::Check;
use urdd_findings::finding::Finding;
use urdd_findings::places::at;
use urdd_format::index::Count;
use urdd_format::report::{MacroPlace, Place, ProgramResult, WrittenAt};
use urdd_source::Trail;
use urdd_source::written::{Written, WrittenMap, WrittenPlace};

/// What "link `NAME`" is about: `link`, and the name.
pub fn named(subject: &str) -> Option<(&str, &str)> {
    let (tag, quoted) = subject.split_once(' ')?;
    Some((tag, quoted.strip_prefix('`')?.strip_suffix('`')?))
}

/// All places of findings, with those that are related.
pub fn places_mut(checks: &mut [Check]) -> impl Iterator<Item = &mut Place> {
    let findings = checks.iter_mut().flat_map(|check| &mut check.findings);
    findings.flat_map(Finding::places_mut)
}

/// Says of each place in the file `name` where that is written, as `find` knows it; of the others, that it is somewhere in
/// the file. Takes away fixes there, which would change a text that nobody has.
pub fn say_where(
    checks: &mut [Check],
    name: &str,
    mut find: impl FnMut(&Place) -> Option<WrittenAt>,
) {
    let mut say = |place: &mut Place| {
        if place.file.as_deref() == Some(name) {
            place.written_at = Some(find(place).unwrap_or_else(|| in_file(name)));
            place.fixes.clear();
        }
    };
    for place in places_mut(checks) {
        say(place);
        place.related.iter_mut().for_each(&mut say);
    }
}

fn in_file(name: &str) -> WrittenAt {
    WrittenAt { file: name.to_owned(), ..WrittenAt::default() }
}

/// Says of findings and effects in the text that xacro made of the file `name` where in the xacro files they are.
pub fn say_where_expanded(
    (text, trail, path, name): (&str, &Trail, &Path, &str),
    checks: &mut [Check],
    programs: &mut [ProgramResult],
) {
    let mut places: Vec<Position> = Vec::new();
    for place in places_mut(checks) {
        let all = [&*place].into_iter().chain(&place.related);
        places.extend(all.filter(|one| one.file.as_deref() == Some(name)).filter_map(at));
    }
    let effects = || programs.iter().flat_map(|program| &program.effects);
    let position = |(line, column): (Count, Count)| Position { line: line.0, column: column.0 };
    places.extend(effects().filter_map(|effect| effect.line.zip(effect.column)).map(position));
    if places.is_empty() {
        return;
    }
    let found = WrittenMap::new(text, trail, path).find(places);
    let find = |place: &Place| found.get(&at(place)?).map(|written| as_reported(written, name));
    say_where(checks, name, find);
    for effect in programs.iter_mut().flat_map(|program| &mut program.effects) {
        let written = effect.line.zip(effect.column).and_then(|at| found.get(&position(at)));
        // An effect has a line, and no file.
        let places = written
            .into_iter()
            .flat_map(|written| [&written.place].into_iter().chain(&written.used_at));
        let written = places.filter(|place| place.is_main).map(|place| place.at).next();
        effect.line = written.map(|at| Count(at.line));
        effect.column = written.map(|at| Count(at.column));
    }
}

/// A place as reports have it; `name` is that of the file that was expanded, maybe in a folder.
fn as_reported(written: &Written, name: &str) -> WrittenAt {
    let place = |place: &WrittenPlace| MacroPlace {
        file: place.named(name),
        line: Count(place.at.line),
        column: Count(place.at.column),
        macro_name: place.macro_name.clone(),
    };
    let MacroPlace { file, line, column, macro_name } = place(&written.place);
    WrittenAt {
        file,
        line: Some(line),
        column: Some(column),
        macro_name,
        used_at: written.used_at.as_ref().map(place),
        calls: written.calls.iter().map(place).collect(),
    }
}
