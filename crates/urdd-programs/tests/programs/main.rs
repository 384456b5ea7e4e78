//! Readers held to the table of what programs did.
#![allow(clippy::restriction)]

mod meshes;
mod table;

use std::collections::{BTreeMap, BTreeSet};

use urdd_programs::{Deed, Effects, File, Program};

/// Of a hundred changes, so many verdicts are the same.
const VERDICTS: f64 = 99.5;
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
    parts: usize,
}

#[test]
fn readers_do_what_their_programs_do() {
    let (letters, rows) = table::read(&table::folder().join("table.txt"));
    let chosen = std::env::var("URDD_PROGRAM").ok();
    let mut failed = Vec::new();
    for program in Program::ALL {
        if chosen.as_ref().is_some_and(|chosen| chosen != program.id()) {
            continue;
        }
        let letter = letters[program.id()];
        let score = score(program, letter, &rows);
        let verdicts = share(score.rows - score.wrong.len(), score.rows);
        let drops = share(score.lossy - score.unnamed.len(), score.lossy);
        println!(
            "{}: {verdicts:.2} % of {} verdicts, {drops:.2} % of {} losses named, {} of {} claims not so",
            program.id(),
            score.rows,
            score.lossy,
            score.invented.len(),
            score.parts
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
        if verdicts < VERDICTS || drops < DROPS {
            failed.push(program.id());
        }
    }
    assert!(failed.is_empty(), "{failed:?}: URDD_PROGRAM=NAME lists each with --nocapture");
}

fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 100.0 } else { 100.0 * part as f64 / whole as f64 }
}

fn score(program: Program, letter: char, rows: &[table::Row]) -> Score {
    let mut score = Score::default();
    let mut of_bases: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for row in rows {
        let Some(&verdict) = row.verdicts.get(&letter) else { continue };
        let effects = read(program, &row.bytes);
        let ours = match effects.worst() {
            Some(Deed::Crashes) => '!',
            Some(Deed::Refuses) => '-',
            _ => '+',
        };
        score.rows += 1;
        // A program that crashes or hangs refuses, for whoever wants a robot.
        if (ours == '+') != (verdict == '+') {
            let first = effects.0.iter().max_by_key(|effect| effect.deed);
            let why = first.map(|effect| effect.fault.to_string()).unwrap_or_default();
            score.wrong.push(format!("{}: {verdict}, and ours {ours} ({why})", row.id));
            continue;
        }
        if verdict != '+' {
            continue;
        }
        let base = of_bases.entry(&row.base).or_insert_with(|| {
            let unchanged = std::fs::read(table::folder().join("base").join(&row.base)).unwrap();
            parts(&read(program, &unchanged))
        });
        let claims = parts(&effects);
        let found = row.differences.get(&letter);
        let (mut lost, mut otherwise) = (BTreeSet::new(), BTreeSet::new());
        for fact in found.into_iter().flatten() {
            let Some(part) = part(fact).filter(|part| is_written(part, &row.bytes)) else {
                continue;
            };
            otherwise.insert(part.clone());
            if fact.starts_with('-') {
                lost.insert(part);
            }
        }
        let missing: Vec<&String> = lost.iter().filter(|one| !covers(&claims, one)).collect();
        score.lossy += usize::from(!lost.is_empty());
        if !missing.is_empty() {
            score.unnamed.push(format!("{}: {missing:?}, claimed {claims:?}", row.id));
        }
        let new = claims.difference(base);
        let invented: Vec<&String> = new
            .clone()
            .filter(|claim| !otherwise.iter().any(|one| is_in(one, claim) || is_in(claim, one)))
            .collect();
        score.parts += new.count();
        if !invented.is_empty() {
            score.invented.push(format!("{}: {invented:?}, otherwise {otherwise:?}", row.id));
        }
    }
    score
}

fn read(program: Program, bytes: &[u8]) -> Effects {
    program.read(&File { bytes, meshes: &meshes::find })
}

/// The parts that a reader says are lost or otherwise.
fn parts(effects: &Effects) -> BTreeSet<String> {
    effects
        .0
        .iter()
        .filter(|effect| effect.deed < Deed::Refuses)
        .map(|effect| effect.part.clone())
        .collect()
}

/// Whether one of the claims is about a part, or about what it is in.
fn covers(claims: &BTreeSet<String>, part: &str) -> bool {
    claims.iter().any(|claim| is_in(part, claim) || is_in(claim, part))
}

/// Whether a part is in another, or the same. `joint/elbow/?` is something in the joint that no program knows.
fn is_in(part: &str, whole: &str) -> bool {
    let whole = whole.strip_suffix("/?").unwrap_or(whole);
    part == whole || part.strip_prefix(whole).is_some_and(|rest| rest.starts_with('/'))
}

/// Whether the link or joint that a part is of is in a file by its name: one that is renamed is not lost.
fn is_written(part: &str, bytes: &[u8]) -> bool {
    let Some((_, name)) = part.split_once('/') else { return false };
    let text = String::from_utf8_lossy(bytes);
    let mut owners = name.match_indices('/').map(|(end, _)| &name[..end]).chain([name]);
    owners.any(|owner| text.contains(&format!("\"{owner}\"")))
}

/// The element that a fact of the table is about: `-joint/elbow/upper` is about `joint/elbow/limit`.
fn part(fact: &str) -> Option<String> {
    let fact = fact.strip_prefix('-').unwrap_or(fact).split('=').next()?;
    let fact = fact.strip_suffix('/').unwrap_or(fact);
    if !fact.starts_with("link/") && !fact.starts_with("joint/") {
        return None;
    }
    let (above, last) = fact.rsplit_once('/')?;
    let element = match last {
        _ if !above.contains('/') => return Some(fact.to_owned()),
        "lower" | "upper" | "velocity" | "effort" | "acceleration" | "deceleration" | "jerk" => {
            "limit"
        }
        "damping" | "friction" => "dynamics",
        "safety" => "safety_controller",
        "mass" | "com" | "inertia" => return Some(above.to_owned()),
        "color" | "texture" => "material",
        "geometry" | "name" | "origin" if !above.starts_with("joint") => {
            return Some(above.to_owned());
        }
        _ => return Some(fact.to_owned()),
    };
    Some(format!("{above}/{element}"))
}
