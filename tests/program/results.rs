//! The pages show the results: each table, text and origin between the markers of a page is the one in
//! `benches/results/<part>.json`, which a script wrote (see `benches/results.py`). The pages that state measurements
//! have no figures outside markers, and facts of a robot (links, triangles, pairs) are the same in every table.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

const WRITE_IT: &str = "run `python3 benches/results.py`, or the script that measures it";
const BEGIN: &str = "<!-- results: ";
const END: &str = "<!-- end of results -->";
/// Values that do not depend on the machine: columns of tables whose first column is the robot.
const FACTS: [&str; 5] = ["links", "DOFs", "triangles", "pieces", "pairs"];
/// Folders with pages, as in `benches/results.py`.
const FOLDERS: [&str; 6] = ["", "docs", "conformance", "python", "wasm", "benches/evaluation/lint"];
/// Pages that state measurements.
const MEASURED: [&str; 2] = ["README.md", "docs/evaluation.md"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every part, by name.
fn parts() -> BTreeMap<String, Value> {
    let files = fs::read_dir(root().join("benches/results")).expect("benches/results");
    let files = files.map(|file| file.expect("an entry").path());
    let parts: BTreeMap<String, Value> = files
        .filter(|path| path.extension().is_some_and(|end| end == "json"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy();
            let text = fs::read_to_string(&path).expect("text");
            let value = serde_json::from_str(&text);
            let value = value.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            (name.into_owned(), value)
        })
        .collect();
    assert!(!parts.is_empty(), "benches/results is empty");
    parts
}

/// The pages that may hold results, as `benches/results.py` finds them: path and text.
fn pages() -> Vec<(String, String)> {
    let mut paths: Vec<PathBuf> =
        FOLDERS.iter().flat_map(|folder| markdown_in(&root().join(folder))).collect();
    let mut folders = vec![root().join("tests/figures")];
    while let Some(folder) = folders.pop() {
        paths.extend(markdown_in(&folder));
        let entries = fs::read_dir(folder).expect("a folder");
        let entries = entries.map(|entry| entry.expect("an entry").path());
        folders.extend(entries.filter(|path| path.is_dir()));
    }
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root()).expect("a page of this repository");
        let name = name.to_string_lossy().replace('\\', "/");
        (name, fs::read_to_string(path).expect("text"))
    };
    paths.into_iter().map(read).collect()
}

fn markdown_in(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.filter(|path| path.extension().is_some_and(|end| end == "md")).collect()
}

/// The content between markers, by the name of the item.
type Shown<'a> = Vec<(&'a str, &'a str)>;

/// The content between markers, and the page without it.
fn marked(text: &str) -> Result<(Shown<'_>, String), String> {
    let (mut found, mut rest, mut without) = (Vec::new(), text, String::new());
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (name, after) = after.split_once(" -->").ok_or("a marker that does not end")?;
        let (shown, after) =
            after.split_once(END).ok_or_else(|| format!("{name}: {END} is missing"))?;
        if shown.contains("<!--") {
            return Err(format!("{name}: another marker begins before {END}"));
        }
        // A line that begins with a comment is HTML to its end: Markdown would not read the rest.
        if !shown.contains('\n') && before.ends_with('\n') {
            return Err(format!("{name}: a text may not begin a line"));
        }
        found.push((name, shown));
        without += before;
        rest = after;
    }
    if rest.contains(END) {
        return Err(format!("{END} without a beginning"));
    }
    Ok((found, without + rest))
}

fn word<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("`{key}` is not text: {value}"))
}

fn words(value: &Value) -> Vec<&str> {
    let list = value.as_array().expect("a list");
    list.iter().map(|one| one.as_str().expect("text")).collect()
}

/// The line that says where a part comes from.
fn origin(made: &Value) -> String {
    let commit = format!("commit {}", word(made, "commit"));
    let others = ["programs", "how", "machine", "load"].map(|key| word(made, key));
    let said: Vec<&str> = std::iter::once(commit.as_str())
        .chain(others.into_iter().filter(|text| !text.is_empty()))
        .collect();
    let (command, date) = (word(made, "command"), word(made, "date"));
    format!("*`{command}`, {date}: {}.*", said.join("; "))
}

fn row(cells: &[&str]) -> String {
    format!("| {} |", cells.join(" | "))
}

fn markdown(table: &Value) -> String {
    let columns = words(&table["columns"]);
    let rows: Vec<Vec<&str>> = table["rows"].as_array().expect("rows").iter().map(words).collect();
    for row in &rows {
        assert_eq!(row.len(), columns.len(), "cells of {row:?}");
        assert!(row.iter().all(|cell| !cell.is_empty()), "an empty cell: {row:?}");
    }
    let right = |column: usize| {
        let digits =
            rows.iter().filter(|row| row[column].starts_with(|c: char| c.is_ascii_digit()));
        column > 0 && digits.count() * 2 > rows.len()
    };
    let rule: Vec<&str> =
        (0..columns.len()).map(|column| if right(column) { "---:" } else { "---" }).collect();
    let lines = [row(&columns), row(&rule)].into_iter();
    let lines: Vec<String> = lines.chain(rows.iter().map(|cells| row(cells))).collect();
    lines.join("\n")
}

/// The required content of a page for a name.
fn expected(parts: &BTreeMap<String, Value>, name: &str) -> Result<String, String> {
    let (part, item) = name.split_once('/').ok_or("a marker names part/item")?;
    let results = parts.get(part).ok_or(format!("benches/results/{part}.json is missing"))?;
    Ok(match (item, &results["items"][item]) {
        ("made", _) => format!("\n{}\n", origin(&results["made"])),
        (_, Value::String(text)) => text.clone(),
        (_, table @ Value::Object(_)) => format!("\n{}\n", markdown(table)),
        _ => {
            return Err(format!("benches/results/{part}.json does not have `{item}`"));
        }
    })
}

/// The faults of a page.
fn faults(parts: &BTreeMap<String, Value>, text: &str) -> Vec<String> {
    let shown = match marked(text) {
        Ok((shown, _)) => shown,
        Err(fault) => return vec![fault],
    };
    let mut faults = Vec::new();
    for (name, shown_text) in &shown {
        match expected(parts, name) {
            Ok(expected) if expected == *shown_text => {}
            Ok(expected) => faults
                .push(format!("{name}: results:\n{expected}\npage:\n{shown_text}\n{WRITE_IT}")),
            Err(fault) => faults.push(format!("{name}: {fault}")),
        }
        let part = name.split('/').next().expect("a part");
        if !shown.iter().any(|(other, _)| *other == format!("{part}/made")) {
            faults.push(format!(
                "{name}: {part}/made is not on the page, so nothing says where it comes from"
            ));
        }
    }
    faults
}

#[test]
fn pages_show_what_the_results_hold() {
    let parts = parts();
    let pages = pages();
    let mut shown: Vec<String> = Vec::new();
    for (page, text) in &pages {
        let found = faults(&parts, text);
        assert!(found.is_empty(), "{page}: {}", found.join("\n"));
        let names = marked(text).expect("markers").0;
        shown.extend(names.iter().map(|(name, _)| (*name).to_owned()));
    }
    for (part, results) in &parts {
        for item in results["items"].as_object().expect("items").keys() {
            let name = format!("{part}/{item}");
            assert!(
                shown.contains(&name),
                "no page shows {name}: take it out of its script, or show it"
            );
        }
    }
}

/// Facts of a table: (robot and shapes, column) and the value.
fn facts(table: &Value) -> Vec<((String, String), String)> {
    let columns = words(&table["columns"]);
    if columns.first() != Some(&"robot") {
        return Vec::new();
    }
    let shapes = columns.iter().position(|column| *column == "shapes");
    let rows = table["rows"].as_array().expect("rows");
    let of_row = |row: &Value| {
        let row: Vec<String> = words(row).into_iter().map(str::to_owned).collect();
        let cells = columns.iter().zip(row.clone());
        let facts = cells.filter(|(column, _)| FACTS.contains(column));
        let of = |column: &str| match shapes {
            Some(at) if column == "pairs" => format!("{}, {}", row[0], row[at]),
            _ => row[0].clone(),
        };
        facts.map(|(column, value)| ((of(column), (*column).to_owned()), value)).collect::<Vec<_>>()
    };
    rows.iter().flat_map(of_row).collect()
}

#[test]
fn facts_of_a_robot_are_the_same_in_every_table() {
    let mut known: BTreeMap<(String, String), (String, String)> = BTreeMap::new();
    for (part, results) in parts() {
        for (item, table) in results["items"].as_object().expect("items") {
            if !table.is_object() {
                continue;
            }
            for (fact, value) in facts(table) {
                let here = format!("{part}/{item}");
                let (place, other) =
                    known.entry(fact.clone()).or_insert((here.clone(), value.clone()));
                assert_eq!(
                    *other, value,
                    "{} of {}: {place} and {here} differ; measure again",
                    fact.1, fact.0
                );
            }
        }
    }
    assert!(known.len() > 20, "hardly any facts were compared: {known:?}");
}

/// A number with a unit of measurement beside it, outside code.
fn measured_number(line: &str) -> Option<String> {
    const UNITS: [&str; 12] =
        ["s", "ms", "us", "µs", "microseconds", "seconds", "minutes", "MB", "GB", "kB", "%", "mm"];
    let prose: String = line.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    let clean =
        |word: &str| word.trim_matches(|c: char| !c.is_alphanumeric() && c != '%').to_owned();
    let words: Vec<String> = prose.split_whitespace().map(clean).collect();
    let number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    let found = words.windows(2).find(|pair| number(&pair[0]) && UNITS.contains(&pair[1].as_str()));
    found.map(|pair| pair.join(" "))
}

#[test]
fn pages_of_measurements_state_no_figure_of_their_own() {
    let pages = pages();
    for page in MEASURED {
        let (_, text) = pages.iter().find(|(name, _)| name == page).expect("a page");
        let (_, prose) = marked(text).unwrap_or_else(|fault| panic!("{page}: {fault}"));
        for line in prose.lines() {
            if let Some(found) = measured_number(line) {
                panic!(
                    "{page}: `{found}` is not between markers: a script writes it into benches/results ({line})"
                );
            }
        }
    }
}

#[test]
fn a_page_that_differs_is_noticed() {
    let part = serde_json::json!({
        "made": {"command": "python x.py", "date": "2026-11-22", "commit": "abc", "programs": "urdd 1", "how": "", "machine": "M", "load": "idle"},
        "items": {"text": "0.3 s", "table": {"columns": ["robot", "s"], "rows": [["A", "1.0"], ["B", "2.0"]]}},
    });
    let parts = BTreeMap::from([("p".to_owned(), part)]);
    let good = "It takes <!-- results: p/text -->0.3 s<!-- end of results --> here.\n\n<!-- results: p/table -->\n| robot | s |\n| --- | ---: |\n| A | 1.0 |\n| B | 2.0 |\n<!-- end of results -->\n\
                <!-- results: p/made -->\n*`python x.py`, 2026-11-22: commit abc; urdd 1; M; idle.*\n<!-- end of results -->\n";
    assert_eq!(faults(&parts, good), Vec::<String>::new());
    for (from, to, fault) in [
        ("-->0.3 s<", "-->0.4 s<", "page:\n0.4 s"),
        ("| B | 2.0 |", "| B | 2.1 |", "| B | 2.1 |"),
        ("| B | 2.0 |\n", "", "p/table"),
        ("2026-11-22", "2026-11-23", "p/made"),
        ("p/table", "p/other", "does not have `other`"),
        ("p/text", "q/text", "q.json is missing"),
        ("<!-- end of results --> here", "here", "another marker begins"),
        ("It takes <!--", "It takes\n<!--", "may not begin a line"),
        (
            "<!-- results: p/made -->\n*`python x.py`, 2026-11-22: commit abc; urdd 1; M; idle.*\n<!-- end of results -->\n",
            "",
            "not on the page",
        ),
    ] {
        let bad = good.replace(from, to);
        assert_ne!(bad, good, "{from} is not in the page");
        let found = faults(&parts, &bad).join("\n");
        assert!(found.contains(fault), "{to}: {found:?}");
    }
    assert_eq!(measured_number("it takes 0.4 s here").as_deref(), Some("0.4 s"));
    assert_eq!(measured_number("up to 300 links, `5 s`, 2 s.").as_deref(), Some("2 s"));
    assert_eq!(measured_number("up to 300 links, `5 s`"), None);
}
