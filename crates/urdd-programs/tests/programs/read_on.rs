//! Readers go on behind what their program refuses, as if it were mended, and say nothing that follows from it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use urdd_programs::{Deed, Effects, Fault, File, Mesh, Program};
use urdd_xml::{Counted, Kind};

use crate::parts::kind_of;
use crate::table::{self, Row};
use crate::{read, read_bytes};

/// Each program with the rows of a sample of the table that it was not refused for their base; `rest` of `every` rows.
fn sample(every: usize, rest: usize) -> (BTreeMap<String, Row>, Vec<Row>) {
    let (_, rows) = table::read(&table::folder().join("table.txt"));
    let (unchanged, changed): (Vec<Row>, Vec<Row>) =
        rows.into_iter().partition(|row| row.id.ends_with("/unchanged"));
    let bases = unchanged.into_iter().map(|row| (row.base.clone(), row)).collect();
    let is_fine = |row: &Row| Counted::new(&row.bytes, Kind::Robot).is_ok();
    let rows = changed.into_iter().enumerate().filter(|(index, _)| index % every == rest);
    (bases, rows.map(|(_, row)| row).filter(is_fine).collect())
}

/// A mesh that is not there says that, and hides nothing.
#[test]
fn a_mesh_that_is_refused_hides_nothing() {
    let (_, rows) = sample(7, 0);
    let mut compared = 0;
    for program in Program::ALL {
        for row in rows.iter().filter(|row| row.bytes.windows(5).any(|five| five == b"<mesh")) {
            let of = |mesh: Mesh| {
                let counted = Counted::new(&row.bytes, Kind::Robot).unwrap();
                let find = |_: &str| mesh.clone();
                let mut effects = program.read(&File::new(counted, &find)).into_kept();
                let is_of_mesh = |fault: &Fault| {
                    matches!(fault, Fault::NotFound(_) | Fault::ForOthers(_) | Fault::Mesh(_))
                };
                effects.retain(|effect| !is_of_mesh(&effect.fault));
                let all = effects.iter();
                all.map(|one| format!("{:?} {} {:?}", one.deed, one.at, one.fault)).collect()
            };
            let (there, missing): (Vec<_>, Vec<_>) = (of(Mesh::Unknown), of(Mesh::Missing));
            assert_eq!(there, missing, "{}: {}", program.id(), row.id);
            compared += 1;
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// One fault is refused once.
#[test]
fn nothing_is_said_that_follows_from_what_is_refused() {
    let (bases, mut rows) = sample(3, 1);
    rows.retain(|row| !row.id.contains("/pair_"));
    let mut failed = Vec::new();
    for program in Program::ALL {
        let known: BTreeSet<String> = bases
            .values()
            .flat_map(|row| read(program, row).into_kept())
            .map(|effect| kind_of(&effect))
            .collect();
        let (mut refused, mut more) = (0, Vec::new());
        for row in &rows {
            if !read(program, &bases[&row.base]).loads() {
                continue;
            }
            let effects = read(program, row);
            if effects.loads() {
                continue;
            }
            refused += 1;
            let others = effects.kept().iter().filter(|effect| effect.is_supposed);
            let others = others.map(kind_of).filter(|kind| !known.contains(kind));
            let others: Vec<String> = others.collect();
            if !others.is_empty() {
                let first = effects.kept().iter().find(|effect| effect.deed >= Deed::Refuses);
                more.push(format!("{}: {:?}, and {others:?}", row.id, first.unwrap().fault));
            }
        }
        println!("{}: {} of {refused} say more", program.id(), more.len());
        if std::env::var("URDD_PROGRAM").is_ok_and(|chosen| chosen == program.id()) {
            more.iter().for_each(|line| println!("  {line}"));
        }
        // A change may make two faults.
        if more.len() > 2 {
            failed.push(program.id());
        }
    }
    assert!(failed.is_empty(), "{failed:?}: URDD_PROGRAM=NAME lists each with --nocapture");
}

/// What is refused of a file with two faults is what is refused of each.
#[test]
fn two_faults_are_both_refused() {
    let (bases, rows) = sample(5, 2);
    let mut by_base: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in &rows {
        by_base.entry(&row.base).or_default().push(row);
    }
    let mut counts = BTreeMap::new();
    for (base, rows) in by_base {
        let unchanged = fs::read(table::folder().join("base").join(base)).unwrap();
        let half = rows.len() / 2;
        for (one, other) in rows.iter().zip(rows.iter().skip(half)) {
            let mut edits = [one.edits.clone(), other.edits.clone()].concat();
            edits.sort_by_key(|edit| std::cmp::Reverse(edit.0));
            if edits.windows(2).any(|pair| pair[1].1 + 100 > pair[0].0) {
                continue;
            }
            let both = table::changed(&unchanged, &edits);
            for program in Program::ALL {
                let each = [one, other].map(|row| refused(&read(program, row)));
                let is_fine = read(program, &bases[base]).loads();
                let Some(both) = read_bytes(program, base, &both).filter(|_| is_fine) else {
                    continue;
                };
                if each.iter().any(|faults| faults.len() != 1 || faults[0].starts_with("Xml")) {
                    continue;
                }
                let both = refused(&both);
                let count: &mut [usize; 2] = counts.entry(program.id()).or_default();
                count[usize::from(each.iter().all(|faults| both.contains(&faults[0])))] += 1;
            }
        }
    }
    println!("{counts:?}");
    for (program, [first, both]) in counts {
        assert!(both * 10 > (first + both) * LEAST, "{program}: {first} {both}");
    }
}

/// Of ten pairs of faults, so many are both refused: the others are of the tree and of what it is made of.
const LEAST: usize = 4;

fn refused(effects: &Effects) -> Vec<String> {
    let refusals = effects.kept().iter().filter(|effect| effect.deed >= Deed::Refuses);
    refusals.map(|effect| format!("{:?}", effect.fault)).collect()
}
