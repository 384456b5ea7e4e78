//! Differences of what stands beside a URDF and says what it cannot: its SRDF, what exports need, what an import lost.
//! Whatever these files say is compared, whether a program knows the word or not.

use crate::fields::Fields;
use crate::parts;
use crate::side::Side;
use crate::words;
use urdd_format::diff_report::PartDifference;
use urdd_format::report::Kind;
use urdd_source::beside::Companion;

/// The parts of a file, by name.
type Parts = Vec<(String, Fields)>;
/// The parts of a side, or a note of why they are not compared.
type Read<'a> = dyn Fn(&str, &Side) -> Result<Option<Parts>, String> + 'a;

/// Differences of what stands beside two robots; `None` of what is not known of one.
pub(super) struct Differences {
    pub srdf: Option<Vec<PartDifference>>,
    pub setup: Option<Vec<PartDifference>>,
    pub lost: Option<Vec<PartDifference>>,
}

/// Compares what stands beside two robots, and notes what is not compared.
pub(super) fn differences(
    before: &Side,
    after: &Side,
    tolerance: f64,
    notes: &mut Vec<String>,
) -> Differences {
    let sides = [("A", before), ("B", after)];
    let mut compare = |name: &str, read: &Read<'_>| {
        let mut of = |(word, side): (&str, &Side)| match read(word, side) {
            Ok(parts) => parts,
            Err(note) => {
                notes.push(note);
                None
            }
        };
        let both = sides.map(&mut of);
        if let [Some(a), Some(b)] = &both {
            return Some(parts::differences(a, b, tolerance));
        }
        let some = sides
            .iter()
            .zip(&both)
            .find(|(_, parts)| parts.as_ref().is_some_and(|it| !it.is_empty()));
        notes.extend(some.map(|((word, _), _)| {
            format!("{word}: {name} is not compared: the other robot has none")
        }));
        None
    };
    let srdf = compare("its SRDF", &|word, side| {
        of(word, side, "SRDF", side.beside.srdf.as_ref(), words::of_srdf)
    });
    let setup = compare("its `export.toml`", &|word, side| {
        of(word, side, "`export.toml`", side.beside.setup.as_ref(), words::of_toml)
    });
    for (word, side) in sides {
        notes.extend(lost_note(word, side));
    }
    let parts = |side| lost(side).map(|parts| parts.collect::<Vec<_>>());
    let lost = parts(before).zip(parts(after));
    let lost = lost.map(|(a, b)| parts::differences(&a, &b, 0.0));
    Differences { srdf, setup, lost }
}

/// The parts of a file of a side, if it is there. A URDF without one has none; a URDD may have them in its modules.
fn of(
    word: &str,
    side: &Side,
    name: &str,
    file: Option<&Companion>,
    read: fn(&str) -> Result<Parts, String>,
) -> Result<Option<Parts>, String> {
    let read = file.map(|text| text.clone().and_then(|text| read(&text))).transpose();
    let read =
        read.map_err(|why| format!("{word}: the {name} beside it is not compared: {why}"))?;
    Ok(read.or_else(|| (side.kind == Kind::Urdf).then(Vec::new)))
}

/// What an import lost, each with its number.
fn lost(side: &Side) -> Option<impl Iterator<Item = (String, Fields)>> {
    let lost = &side.beside.import.as_ref()?.lost;
    Some(lost.iter().map(|(what, count)| {
        let mut fields = Fields::default();
        fields.number("count", "", Some(*count as f64));
        (what.clone(), fields)
    }))
}

fn lost_note(word: &str, side: &Side) -> Option<String> {
    let lost = &side.beside.import.as_ref()?.lost;
    let all: Vec<String> = lost.iter().map(|(what, count)| format!("{what} ({count})")).collect();
    (!all.is_empty()).then(|| {
        format!("{word}: of what the import loses, only the number is compared: {}", all.join(", "))
    })
}
