//! Python, JavaScript and docs/export.md have the options of the table: `cargo xtask update` writes them.

use serde_json::Value;
use testkit::page::assert_between;
use urdd_export::{CHOICES, Choice, Choices, Format, Kind, Word};
use urdd_format::readable::grouped;

const HOW: &str = "cargo test --workspace --test export front_ends";

/// What an option does, for a language: `name` is how it writes names of options, `code` how it marks code.
fn about(choice: &Choice, code: &str) -> String {
    let mut text = choice.about(false);
    if let Kind::Word(words) = choice.kind {
        let said = words.iter().filter(|(_, about)| !about.is_empty());
        let said: Vec<String> = said
            .map(|(word, about)| format!("`{word}`: {}", lower(about.trim().trim_end_matches('.'))))
            .collect();
        text += &if said.is_empty() { String::new() } else { format!(" {}.", said.join("; ")) };
    }
    if choice.kind == Kind::Detail {
        text += " `False` leaves it out.";
    }
    let parts = text.split('`').enumerate().map(|(at, part)| match part.strip_prefix("--") {
        Some(option) if at % 2 == 1 => option.replace('-', "_"),
        _ => part.to_owned(),
    });
    parts.collect::<Vec<_>>().join(code)
}

/// What a number may be, in a sentence.
fn its_range(choice: &Choice) -> String {
    match choice.kind {
        Kind::Number(range) => format!(" It is {range}."),
        _ => String::new(),
    }
}

/// In a sentence: names keep their capitals.
fn lower(text: &str) -> String {
    let (word, rest) = text.split_once(' ').unwrap_or((text, ""));
    match word.chars().skip(1).any(char::is_uppercase) {
        true => text.to_owned(),
        false => format!("{} {rest}", word.to_lowercase()),
    }
}

/// Lines of at most 120 letters, with a margin.
fn wrapped(text: &str, first: &str, margin: &str) -> String {
    let (mut lines, mut line) = (String::new(), first.to_owned());
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > 120 {
            lines += &format!("{}\n", line.trim_end());
            line = margin.to_owned();
        } else if !line.ends_with(' ') {
            line.push(' ');
        }
        line += word;
    }
    lines + &line + "\n"
}

fn quoted(words: &[Word], between: &str) -> String {
    words.iter().map(|(word, _)| format!("\"{word}\"")).collect::<Vec<_>>().join(between)
}

/// Options that CHANGELOG.md tells in other words: three are older, and `robot_file` is `--config`.
const TOLD_OTHERWISE: [&str; 4] = ["reasons", "total_spheres", "mesh_folder", "robot_file"];

#[test]
fn users_are_told_of_each_option() {
    let changes = testkit::repository().join("CHANGELOG.md");
    let changes = std::fs::read_to_string(changes).expect("the changes");
    let words: Vec<&str> = changes.split(|c: char| !(c.is_alphanumeric() || c == '-')).collect();
    for choice in CHOICES {
        let flag = format!("--{}", choice.name.replace('_', "-"));
        let is_told = words.contains(&flag.as_str()) || TOLD_OTHERWISE.contains(&choice.name);
        assert!(is_told, "CHANGELOG.md does not say that there is `{flag}`");
    }
}

#[test]
fn python() {
    let file = "python/lib/urdd/_export.py";
    let alias = |name: &str| match name {
        "shapes" => Some("ExportShapes"),
        "actuators" => Some("Actuators"),
        "ros" => Some("Ros"),
        _ => None,
    };
    let (mut signature, mut docs) = (String::new(), String::new());
    for choice in CHOICES {
        let of = match choice.kind {
            Kind::Flag => "bool".to_owned(),
            Kind::Number(range) if range.unit.is_none() => "int".to_owned(),
            Kind::Number(_) => "float".to_owned(),
            Kind::Word(words) => {
                let literal = format!("Literal[{}]", quoted(words, ", "));
                alias(choice.name).map_or(literal, str::to_owned)
            }
            Kind::Words(words) => format!("Iterable[Literal[{}]]", quoted(words, ", ")),
            Kind::Text => "str".to_owned(),
            Kind::Fit => "tuple[float, float]".to_owned(),
            Kind::Detail => "bool | float".to_owned(),
        };
        let default = match (choice.default)() {
            Value::Null => None,
            Value::Bool(is) => Some(if is { "True".to_owned() } else { "False".to_owned() }),
            Value::Number(number) => {
                Some(grouped(number.as_f64().unwrap_or_default()).replace(',', "_"))
            }
            other => Some(other.to_string()),
        };
        let (or, default) = default.map_or((" | None", "None".to_owned()), |default| ("", default));
        signature += &format!("    {}: {of}{or} = {default},\n", choice.name);
        let text = lower(&about(choice, "``")) + &its_range(choice);
        docs += &wrapped(&text, &format!("        {}:", choice.name), &" ".repeat(12));
    }
    let marks = [
        "    # The options of crates/urdd-export/src/choices.rs: `cargo xtask update` writes them, and what they do below.\n",
        "    # End of the options.\n",
    ];
    assert_between(file, marks, &signature, HOW);
    assert_between(file, ["        output: a file to write.\n", "        setup: what"], &docs, HOW);
}

#[test]
fn javascript() {
    let mut text = String::new();
    for choice in CHOICES {
        let of = match choice.kind {
            Kind::Flag => "boolean".to_owned(),
            Kind::Number(_) => "number".to_owned(),
            Kind::Word(_) if choice.name == "shapes" => "ShapeKind | \"source\"".to_owned(),
            Kind::Word(words) => quoted(words, " | "),
            Kind::Words(words) => format!("({})[]", quoted(words, " | ")),
            Kind::Text => "string".to_owned(),
            Kind::Fit => "[number, number]".to_owned(),
            Kind::Detail => "boolean | number".to_owned(),
        };
        text += "  /**\n";
        let about = about(choice, "`").replace("`False`", "`false`");
        text += &wrapped(&(about + &its_range(choice)), "   *", "   * ");
        text += &format!("   */\n  {}?: {of};\n", choice.name);
    }
    let marks = ["  // `cargo xtask update` writes these.\n", "  // These are written by hand.\n"];
    assert_between("wasm/npm/index.d.ts", marks, &text, HOW);
}

#[test]
fn the_page() {
    let mut text = String::from("| option | takes | formats | what it does |\n|---|---|---|---|\n");
    for choice in CHOICES {
        let words = |words: &[Word]| {
            words.iter().map(|(word, _)| format!("`{word}`")).collect::<Vec<_>>().join(", ")
        };
        let takes = match choice.kind {
            Kind::Flag => String::new(),
            Kind::Number(range) => range.to_string(),
            Kind::Word(all) => words(all),
            Kind::Words(all) => format!("a list of {}", words(all)),
            Kind::Text | Kind::Fit | Kind::Detail => choice.shown.replace('|', " or "),
        };
        let formats = match choice.of.len() == Format::ALL.len() {
            true => "all".to_owned(),
            false => choice.of.iter().map(|of| of.word()).collect::<Vec<_>>().join(", "),
        };
        text += &format!("| `{}` | {takes} | {formats} | {} |\n", choice.name, choice.about(true));
    }
    let marks = ["<!-- table: options -->\n", "<!-- end of options -->"];
    assert_between("docs/export.md", marks, &text, HOW);
}

/// What a front end can say is what the library takes.
#[test]
fn every_word_is_taken() {
    for choice in CHOICES {
        let mut choices = Choices::default();
        let mut set = |value: Value| choice.set(&mut choices, &value);
        let default = (choice.default)();
        assert_eq!(set(default), Ok(()), "{}", choice.name);
        assert!(set(Value::Object(Default::default())).is_err(), "{}", choice.name);
        match choice.kind {
            Kind::Word(words) => {
                words.iter().for_each(|(word, _)| assert_eq!(set((*word).into()), Ok(())));
            }
            Kind::Words(words) => {
                assert_eq!(set(words.iter().map(|(word, _)| *word).collect()), Ok(()));
            }
            Kind::Number(range) => {
                assert_eq!(set(range.least.into()), Ok(()));
                assert_eq!(set(range.most.into()), Ok(()));
                assert!(set((range.least - 1.0).into()).is_err());
            }
            _ => {}
        }
    }
}
