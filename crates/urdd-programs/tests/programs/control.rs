//! What ros2_control and gz_ros2_control do. The parser's verdicts are recorded in `tests/figures/programs/control`; what the
//! resource managers do with its hardware follows their sources, which the cases name.

use std::fs;

use urdd_programs::{Deed, Effects, File, Mesh, Program};
use urdd_xml::{Counted, Kind};

use crate::table;

const HUMBLE: Program = Program::Control2;
const JAZZY: Program = Program::Control4;
const GAZEBO: Program = Program::GazeboControl;

fn read(program: Program, text: &str) -> Effects {
    let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
    program.read(&File::new(counted, &|_| Mesh::Missing))
}

/// What a program does: each deed, the text that it points at, what is lost, and why.
fn does(program: Program, text: &str) -> Vec<(Deed, String, String)> {
    let effects = read(program, text).into_kept().into_iter();
    let at = |at: usize| text[at..].split(['>', '\n']).next().unwrap_or_default().to_owned();
    effects.map(|effect| (effect.deed, at(effect.at), effect.part.to_string())).collect()
}

fn base() -> String {
    fs::read_to_string(table::folder().join("control/base.urdf")).unwrap()
}

/// The base, changed.
fn changed(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(base(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    })
}

#[test]
fn the_parser_refuses_what_those_of_humble_and_jazzy_refuse() {
    let cases = fs::read_to_string(table::folder().join("control/cases.txt")).unwrap();
    let mut wrong = Vec::new();
    for case in cases.lines().filter(|line| !line.starts_with('#')) {
        let [verdicts, old, new] = case.split('\t').collect::<Vec<_>>()[..] else { panic!("{case}") };
        let text = changed(&[(old, new)]);
        for (program, verdict) in [HUMBLE, JAZZY].into_iter().zip(verdicts.chars()) {
            let effects = read(program, &text);
            if effects.loads() != (verdict == '+') {
                wrong.push(format!("{} {case}: {:?}", program.id(), effects.kept()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
