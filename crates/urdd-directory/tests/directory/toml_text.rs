//! TOML that is written has no hidden characters.

use urdd_directory::export_toml::unplaced;
use urdd_directory::loops_toml::{CouplingTable, File};

#[test]
fn hidden_characters_are_escapes_and_names_stay_the_same() {
    let names = [
        "a\u{9b}b",
        "\u{202e}x",
        "n\u{85}'q'",
        "\"\u{202e}\"",
        "b\\\u{9b}",
        "'\u{202e}\"",
        "l\n\u{9b}\n'''",
        "é",
    ];
    for name in names {
        let terms = [(unplaced(format!("j{name}").into()), [1.0].into())].into();
        let coupling = CouplingTable { name: name.to_owned(), constant: 0.0, terms };
        let file = File { couplings: vec![unplaced(coupling)], ..File::default() };
        let text = file.to_text().expect("a text");
        assert!(!text.contains(['\u{9b}', '\u{202e}', '\u{85}']), "{text:?}");
        let again: File = toml::from_str(&text).expect(&text);
        let [coupling] = &again.couplings[..] else { panic!("{text}") };
        assert_eq!(coupling.get_ref().name, name);
        let terms: Vec<String> =
            coupling.get_ref().terms.keys().map(|name| name.get_ref().to_string()).collect();
        assert_eq!(terms, [format!("j{name}")]);
    }
}
