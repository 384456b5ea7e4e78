//! What says the loops of a robot: URDF+, `NAME.loops.toml`, and the YAML of Extended URDF.

use std::path::Path;
use std::sync::Arc;

use urdd_generate::{Selection, Settings, generate_in_memory};
use urdd_source::{Files, Settings as SourceSettings};

/// The robot whose loops a file beside it says.
const ROBOT: &str = include_str!("../../data/fuzz/loops/four_bar.urdf");

/// A text with tags is a URDF; one with a list of closed loops is Extended URDF's; others are TOML. What is refused has a
/// reason. What is accepted is a robot, with its loops or a note.
pub fn loops(bytes: &[u8]) {
    let has = |word: &[u8]| bytes.windows(word.len()).any(|part| part == word);
    let files = match () {
        () if has(b"<robot") => vec![("robot.urdf", bytes)],
        () if has(b"closed_loop") => vec![("robot.urdf", ROBOT.as_bytes()), ("robot.yaml", bytes)],
        () => vec![("robot.urdf", ROBOT.as_bytes()), ("robot.loops.toml", bytes)],
    };
    let files = files.into_iter().map(|(name, bytes)| (name.to_owned(), Arc::from(bytes)));
    let files = Files::in_memory(files).expect("two files");
    let source = SourceSettings { files, ..SourceSettings::default() };
    let path = Path::new("/robot.urdf");
    let said = match urdd_source::load(path, &source) {
        Ok(read) => read.loops.is_some_and(|said| !said.file.is_empty()),
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let selection = Selection::parse(["core"]).expect("a selection");
    let settings = Settings { source, selection, ..Settings::default() };
    match generate_in_memory(path, &settings, &()) {
        Ok((made, files)) => {
            let has_module = files.keys().any(|path| path.contains("loops_module"));
            assert!(has_module || !said || !made.notes.is_empty(), "loops are lost in silence");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
