//! docs/scripts.md: each key that it names is in what the program answers.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use testkit::robots::made_named;

/// A row of the table of commands.
struct Row {
    command: String,
    answer: String,
    keys: Vec<String>,
}

/// The words of a text between backticks.
fn code(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn rows(page: &str) -> Vec<Row> {
    let table = page.lines().skip_while(|line| !line.starts_with("| command | answer |"));
    let table = table.skip(2).take_while(|line| line.starts_with('|'));
    let mut command = String::new();
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [of, answer, keys] = cells[..] else {
            panic!("three cells: {line}");
        };
        if let Some(word) = code(of).into_iter().next() {
            command = word;
        }
        Row { command: command.clone(), answer: answer.to_owned(), keys: code(keys) }
    };
    table.map(row).collect()
}

/// Whether a value has a key, written as a path: `urdds[].findings[].code`. Lists have at least one element.
fn has(value: &Value, path: &str) -> bool {
    let (first, rest) = path.split_once('.').map_or((path, None), |(one, rest)| (one, Some(rest)));
    let (name, is_list) = first.strip_suffix("[]").map_or((first, false), |name| (name, true));
    let Some(value) = (if name.is_empty() { Some(value) } else { value.get(name) }) else {
        return false;
    };
    let within = |value: &Value| rest.is_none_or(|rest| has(value, rest));
    match is_list {
        true => value.as_array().is_some_and(|all| all.iter().any(within)),
        false => within(value),
    }
}

struct Answers<'a> {
    folder: &'a Path,
}

impl Answers<'_> {
    fn run(&self, words: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.args(words).current_dir(self.folder).output().expect("it runs")
    }

    /// The first document that a command prints.
    fn printed(&self, words: &[&str]) -> Value {
        let done = self.run(words);
        let text = String::from_utf8(done.stdout).expect("text");
        let mut documents = serde_json::Deserializer::from_str(&text).into_iter::<Value>();
        documents.next().and_then(Result::ok).unwrap_or_else(|| panic!("{words:?}: {text}"))
    }

    /// The report that a command writes into this file.
    fn reported(&self, words: &[&str], file: &str) -> Value {
        let done = self.run(&[words, &["--report", file]].concat());
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let text = fs::read_to_string(self.folder.join(file)).expect("a report");
        serde_json::from_str(&text).expect("JSON")
    }

    /// What a row speaks of; `None` of a row that this test does not know.
    fn of(&self, row: &Row) -> Option<Value> {
        let json = ["--format", "json"];
        let printed = |words: &[&str]| Some(self.printed(&[words, &json].concat()));
        let is_about = |words: &str| row.answer.starts_with(words);
        match &*row.command {
            "lint --format json" => printed(&["lint", "faults.urdf"]),
            "validate --format json" => printed(&["validate", "arm"]),
            "explain CODE --format json" => printed(&["explain", "LNT017"]),
            "generate --format json" if is_about("one that could not") => {
                printed(&["generate", "broken.urdf", "-o", "none"])
            }
            "generate --format json" => printed(&["generate", "without_mesh.urdf", "-o", "made"]),
            "combine --format json" => {
                printed(&["combine", "arm", "gripper", "--at", "torch", "-o", "cell"])
            }
            "info --format json" => printed(&["info", "arm"]),
            "diff A B --format json" => printed(&["diff", "arm", "gripper"]),
            "check-collisions URDD --format json" => printed(&["check-collisions", "arm"]),
            "export FORMAT … --report FILE" => {
                Some(self.reported(&["export", "mjcf", "arm", "-o", "arm.xml"], "export.json"))
            }
            "import … --report FILE" => {
                let arm = testkit::repository().join("examples/mjcf/arm.xml");
                let arm = arm.to_str().expect("text");
                Some(self.reported(&["import", arm, "-o", "imported"], "import.json"))
            }
            _ => None,
        }
    }
}

#[test]
fn each_key_of_the_page_for_scripts_is_in_the_answer() {
    let root = testkit::repository();
    let (_arm, arm) = made_named("welding_arm");
    let (_gripper, gripper) = made_named("gripper");
    let folder = testkit::temporary::folder();
    let at = |name: &str| folder.path().join(name);
    fs::rename(arm, at("arm")).expect("moved");
    fs::rename(gripper, at("gripper")).expect("moved");
    fs::copy(root.join("examples/robots/arm_with_faults.urdf"), at("faults.urdf")).expect("it");
    fs::write(at("broken.urdf"), "<robot").expect("written");
    let mesh = r#"<robot name="a"><link name="a"><visual><geometry><mesh filename="a.stl"/></geometry></visual></link></robot>"#;
    fs::write(at("without_mesh.urdf"), mesh).expect("written");

    let page = fs::read_to_string(root.join("docs/scripts.md")).expect("the page");
    let answers = Answers { folder: folder.path() };
    let rows = rows(&page);
    assert!(rows.len() > 10, "{} rows", rows.len());
    let mut wrong = Vec::new();
    for row in &rows {
        let Row { command, answer, keys } = row;
        let value = answers.of(row).unwrap_or_else(|| {
            panic!("docs/scripts.md has a row `{command}`, which this test does not run: add it")
        });
        assert!(!keys.is_empty(), "`{command}`, {answer}: no keys");
        let missing = keys.iter().filter(|key| !has(&value, key));
        wrong.extend(missing.map(|key| format!("`{command}`, {answer}: without `{key}`")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_key_is_found_where_it_is() {
    let value = serde_json::json!([{ "a": [{ "b": null }, {}], "c": [] }]);
    for there in ["[]", "[].a", "[].a[].b", "[].c"] {
        assert!(has(&value, there), "{there}");
    }
    for absent in ["a", "[].b", "[].c[]", "[].a[].c", "[].a.b"] {
        assert!(!has(&value, absent), "{absent}");
    }
}
