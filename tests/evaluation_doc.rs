//! docs/evaluation.md holds the tables that `benches/evaluation/tables.json` declares: the same columns and rows, between
//! their markers, with the line that says where the figures come from. The figures themselves are not judged.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

const RUN_IT: &str = "run its script in benches/evaluation again";

/// The cells of a table's row.
fn cells(line: &str) -> Vec<&str> {
    let inner = line
        .strip_prefix('|')
        .and_then(|line| line.strip_suffix('|'));
    let inner = inner.unwrap_or_else(|| panic!("this is no row of a table: {line}"));
    inner.split('|').map(str::trim).collect()
}

/// What stands between the markers of each table, by name.
fn tables(document: &str) -> BTreeMap<&str, Vec<&str>> {
    let mut found = BTreeMap::new();
    let mut open: Option<(&str, Vec<&str>)> = None;
    for line in document.lines() {
        let marker = |start| {
            let name = line.strip_prefix(start)?;
            name.strip_suffix(" -->")
        };
        if let Some(name) = marker("<!-- table: ") {
            assert!(open.is_none(), "`{name}` begins within another table");
            open = Some((name, Vec::new()));
        } else if let Some(name) = marker("<!-- end: ") {
            let (begun, lines) = open
                .take()
                .unwrap_or_else(|| panic!("`{name}` ends, and never began"));
            assert_eq!(begun, name, "another table ends than the one that began");
            assert!(found.insert(name, lines).is_none(), "`{name}` twice");
        } else if let Some((_, lines)) = &mut open {
            lines.push(line);
        }
    }
    assert!(open.is_none(), "a table without an end: {open:?}");
    found
}

fn words(value: &Value) -> Vec<&str> {
    let list = value.as_array().expect("a list");
    list.iter().map(|one| one.as_str().expect("text")).collect()
}

#[test]
fn the_evaluation_holds_the_tables_that_its_scripts_declare() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |name: &str| fs::read_to_string(root.join(name)).expect("a file");
    let document = read("docs/evaluation.md");
    let declared: Value =
        serde_json::from_str(&read("benches/evaluation/tables.json")).expect("JSON");
    let declared = declared.as_object().expect("tables");
    let found = tables(&document);
    assert_eq!(
        found.keys().copied().collect::<Vec<_>>(),
        {
            let mut names: Vec<&str> = declared.keys().map(String::as_str).collect();
            names.sort_unstable();
            names
        },
        "the tables of docs/evaluation.md are not those of tables.json"
    );
    for (name, lines) in found {
        let rows: Vec<Vec<&str>> = lines
            .iter()
            .take_while(|line| !line.is_empty())
            .map(|line| cells(line))
            .collect();
        assert!(rows.len() > 2, "the table `{name}` is empty: {RUN_IT}");
        let columns = words(&declared[name]["columns"]);
        assert_eq!(rows[0], columns, "columns of `{name}`: {RUN_IT}");
        let first: Vec<&str> = rows[2..].iter().map(|row| row[0]).collect();
        assert_eq!(
            first,
            words(&declared[name]["rows"]),
            "rows of `{name}`: {RUN_IT}"
        );
        for row in &rows {
            assert_eq!(row.len(), columns.len(), "`{name}`: {row:?}");
            assert!(
                row.iter().all(|cell| !cell.is_empty()),
                "`{name}` has an empty cell: {row:?}"
            );
        }
        let after = &lines[rows.len()..];
        let told = matches!(after, ["", line] if line.starts_with("*`python benches/evaluation/") && line.contains("commit "));
        assert!(
            told,
            "`{name}` does not say where it comes from: {RUN_IT}: {after:?}"
        );
    }
}
