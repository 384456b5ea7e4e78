//! Readers held to the table of what programs did.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod control;
mod gazebo;
mod meshes;
mod parts;
mod read_on;
mod table;
mod three;
mod usd;

use std::collections::{BTreeMap, BTreeSet};

use parts::{Claim, are_near, claims, covers};
use urdd_programs::{Deed, Effects, File, KEPT, Program};
use urdd_xml::{Counted, Kind};

/// Of a hundred changes, so many verdicts are the same.
const VERDICTS: f64 = 99.9;
/// Of a hundred changes with parts lost, so many name each of them.
const DROPS: f64 = 95.0;

/// What became of the changes with one program.
#[derive(Default)]
struct Score {
    rows: usize,
    wrong: Vec<String>,
    lossy: usize,
    unnamed: Vec<String>,
    /// Claims that a part is lost or otherwise where it is not.
    invented: Vec<String>,
    claims: usize,
}

#[test]
fn readers_do_what_their_programs_do() {
    let (letters, mut rows) = table::read(&table::folder().join("table.txt"));
    // What is beyond the limits of XML, as two files that declare entities are, no program is asked about.
    rows.retain(|row| Counted::new(&row.bytes, Kind::Robot).is_ok());
    let chosen = std::env::var("URDD_PROGRAM").ok();
    // A plain `cargo test` takes a fifth of the table, and all of it with URDD_TRIALS=5.
    let trials: usize = std::env::var("URDD_TRIALS").map_or(1, |text| text.parse().unwrap());
    if chosen.is_none() {
        let mut index = 0;
        rows.retain(|row| {
            index += 1;
            index % 5 < trials || row.id.ends_with("/unchanged")
        });
    }
    let mut failed = Vec::new();
    for program in Program::ALL {
        if chosen.as_ref().is_some_and(|chosen| chosen != program.id()) {
            continue;
        }
        // A table may have some programs only.
        let Some(&letter) = letters.get(program.id()) else { continue };
        let score = score(program, letter, &rows);
        let verdicts = share(score.rows - score.wrong.len(), score.rows);
        let drops = share(score.lossy - score.unnamed.len(), score.lossy);
        println!(
            "{}: {verdicts:.2} % of {} verdicts, {drops:.2} % of {} losses named, {} of {} claims not so",
            program.id(),
            score.rows,
            score.lossy,
            score.invented.len(),
            score.claims
        );
        if chosen.is_some() {
            for (what, lines) in [
                ("verdict", &score.wrong),
                ("unnamed", &score.unnamed),
                ("invented", &score.invented),
            ] {
                lines.iter().for_each(|line| println!("  {what} {line}"));
            }
        }
        // Of a sample, a few more may be wrong, and a few losses unnamed.
        let is_sample = trials < 5 && chosen.is_none();
        let (least, few) = if is_sample { (VERDICTS - 0.4, 5) } else { (VERDICTS, 0) };
        if verdicts < least || drops < DROPS && score.unnamed.len() > few {
            failed.push(program.id());
        }
    }
    assert!(failed.is_empty(), "{failed:?}: URDD_PROGRAM=NAME lists each with --nocapture");
}

/// Damaged files: a few bytes are replaced, removed or repeated.
#[test]
fn any_bytes_are_read_without_a_panic_and_with_places_inside_of_the_file() {
    let trials: u64 = std::env::var("URDD_TRIALS").map_or(1, |text| text.parse().unwrap());
    let (_, rows) = table::read(&table::folder().join("table.txt"));
    let mut state = 0_u64;
    let mut random = |below: usize| {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        ((mixed ^ (mixed >> 27)) >> 11) as usize % below
    };
    for _ in 0..200 * trials {
        let row = &rows[random(rows.len())];
        let mut bytes = row.bytes.clone();
        for _ in 0..=random(4) {
            let at = random(bytes.len() + 1);
            let end = (at + random(9)).min(bytes.len());
            let others = [&b"<"[..], b">", b"\"", b"&#", b"/>", b"\0", b"\xff", b" ", b""];
            let put = match random(2) {
                0 => bytes[at..end].repeat(2),
                _ => others[random(others.len())].to_vec(),
            };
            bytes.splice(at..end, put);
        }
        for program in Program::ALL {
            let Some(effects) = read_bytes(program, &row.base, &bytes) else { continue };
            for effect in effects.into_kept() {
                let text = String::from_utf8_lossy(&bytes);
                assert!(effect.at <= bytes.len(), "{}: {effect:?} of {text}", program.id());
            }
        }
    }
}

#[test]
fn programs_have_names() {
    for program in Program::ALL {
        for name in program.settings().chain([program.id()]) {
            assert!(Program::of_name(name).any(|one| one == program), "{name}");
        }
    }
    let named = |name| Program::of_name(name).collect::<Vec<_>>();
    assert_eq!(named("humble"), [Program::Urdfdom3, Program::Control2]);
    assert_eq!(named("noetic"), [Program::Urdfdom3]);
    assert_eq!(named("ros"), [Program::Urdfdom6, Program::Control4]);
    assert_eq!(named("ros2_control"), [Program::Control4, Program::Control2]);
    assert_eq!(named("gazebo"), [Program::Fortress, Program::Harmonic, Program::Jetty]);
    assert_eq!(named("jetty"), [Program::Jetty]);
    assert_eq!(named("webots"), []);
    assert!(Program::Urdfdom4.is_asked() && !Program::MuJoCo33.is_asked());
}

fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 100.0 } else { 100.0 * part as f64 / whole as f64 }
}

/// What counts.
///
/// - A *verdict* is whether there is a robot in the end. A program that crashes or hangs refuses, for whoever wants a robot.
/// - A *loss* is a change after which the program lacks a fact of a part, an element of a link or joint, that the changed
///   file still has: not a link or joint that is renamed, and not a part of which the change itself takes facts away. It is
///   named if a claim is about the part, what it is in, or something in it.
/// - A *claim* counts if it is not made of an unchanged file, whatever the link or joint: the table has only what is
///   otherwise than in the unchanged ones, so that it cannot say whether such a claim is so. It is not so if the program
///   reads all that is near that part as it is meant. Claims about text that is no number by any reading are so, also where
///   the program reads the number that was there before; and those about materials that nothing has, or about parts of
///   which the change takes facts away, cannot be judged.
fn score(program: Program, letter: char, rows: &[table::Row]) -> Score {
    let mut score = Score::default();
    let unchanged: BTreeMap<&str, &table::Row> = rows
        .iter()
        .filter(|row| row.id.ends_with("/unchanged"))
        .map(|row| (row.base.as_str(), row))
        .collect();
    let known: BTreeSet<String> = unchanged
        .values()
        .flat_map(|row| claims(&read(program, row)))
        .map(|claim| claim.kind)
        .collect();
    for row in rows {
        let Some(&verdict) = row.verdicts.get(&letter) else { continue };
        let effects = read(program, row);
        let ours = match effects.worst() {
            Some(Deed::Crashes) => '!',
            Some(Deed::Refuses) => '-',
            _ => '+',
        };
        score.rows += 1;
        if (ours == '+') != (verdict == '+') {
            let first = effects.kept().iter().max_by_key(|effect| effect.deed);
            let why = first.map(|effect| effect.fault.to_string()).unwrap_or_default();
            score.wrong.push(format!("{}: {verdict}, and ours {ours} ({why})", row.id));
            continue;
        }
        // There are no differences where the unchanged file is refused, and none can be told of names that Python cannot
        // have.
        let base = unchanged[&*row.base];
        let is_text = std::str::from_utf8(&row.bytes).is_ok() && !row.id.contains("surrogate");
        if verdict == '+' && is_text && base.verdicts.get(&letter) == Some(&'+') {
            judge((row, base), (program, letter), &claims(&effects), &known, &mut score);
        }
    }
    score
}

/// The losses and claims of a change that the program loads.
fn judge(
    (row, base): (&table::Row, &table::Row),
    (program, letter): (Program, char),
    claims: &BTreeSet<Claim>,
    known: &BTreeSet<String>,
    score: &mut Score,
) {
    let (written, unchanged) = (parts::written(&row.bytes), parts::written(&base.bytes));
    let is_written = |part: &str| parts::is_written(part, &written, &unchanged);
    let gone: BTreeSet<String> = row.gone.iter().filter_map(|fact| parts::of_fact(fact)).collect();
    let text = String::from_utf8_lossy(&row.bytes);
    let is_planar = text.contains("\"planar\"");
    let (mut lost, mut otherwise) = (BTreeSet::new(), BTreeSet::new());
    for fact in row.differences.get(&letter).into_iter().flatten() {
        let Some(part) = parts::of_fact(fact) else { continue };
        // The driver of the converter shows the axes of joints that turn or slide alone.
        let is_shown = program != Program::Isaac || !is_planar || !part.ends_with("/axis");
        if fact.starts_with('-') && is_shown && is_written(&part) && !gone.contains(&part) {
            lost.insert(part.clone());
        }
        otherwise.insert(part);
    }
    let missing: Vec<&String> = lost.iter().filter(|one| !covers(claims, one)).collect();
    score.lossy += usize::from(!lost.is_empty());
    if !missing.is_empty() {
        let claimed: Vec<&String> = claims.iter().map(|claim| &claim.part).collect();
        score.unnamed.push(format!("{}: {missing:?}, claimed {claimed:?}", row.id));
    }
    let is_judged = |claim: &&Claim| {
        let material = claim.part.strip_prefix("material/");
        let is_used = material.is_none_or(|name| text.matches(&format!("\"{name}\"")).count() > 1);
        is_used
            && !known.contains(&claim.kind)
            && !gone.iter().any(|one| are_near(&claim.part, one))
    };
    let judged: Vec<&Claim> = claims.iter().filter(is_judged).collect();
    let is_so = |claim: &Claim| otherwise.iter().any(|one| are_near(&claim.part, one));
    let invented: Vec<&String> = judged
        .iter()
        .filter(|claim| claim.is_doubtful && !is_so(claim))
        .map(|claim| &claim.part)
        .collect();
    score.claims += judged.len();
    if !invented.is_empty() {
        score.invented.push(format!("{}: {invented:?}, otherwise {otherwise:?}", row.id));
    }
}

fn read(program: Program, row: &table::Row) -> Effects {
    read_bytes(program, &row.base, &row.bytes).expect("within the limits of XML")
}

/// Nothing of a file beyond the limits of XML: programs are not asked about it.
fn read_bytes(program: Program, base: &str, bytes: &[u8]) -> Option<Effects> {
    let counted = Counted::new(bytes, Kind::Robot).ok()?;
    Some(program.read(&File::new(counted, &|name| meshes::find(program, base, name))))
}

#[test]
fn of_very_many_effects_a_few_are_kept_and_all_are_counted() {
    let many = 30_000;
    let text = format!("<robot name=\"r\"><link name=\"a\"/>{}</robot>", "<lnk/>".repeat(many));
    let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
    let file = File::new(counted, &|_| urdd_programs::Mesh::Missing);
    for program in Program::ALL {
        let effects = program.read(&file);
        if effects.loads() {
            assert!(effects.kept().len() <= KEPT, "{}", program.id());
            assert!(effects.kept().len() + effects.cut() >= many, "{}", program.id());
            assert_eq!(effects.worst(), Some(Deed::Drops), "{}", program.id());
        }
    }
}
