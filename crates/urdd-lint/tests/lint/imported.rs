//! Findings of an MJCF are where the MJCF has what they are about: nobody has the URDF that the import makes.

use std::fs;
use std::path::Path;

use urdd_findings::report::{github, human, place::places, sarif, style::Style};
use urdd_format::report::{Place, Urdd};
use urdd_lint::{LintSettings, lint_with_text};

const ARM: &str = "<mujoco model=\"arm\">
  <worldbody>
    <body name=\"base\"><geom size=\"0.1\"/>
      <body name=\"near\"><joint name=\"ball\" type=\"ball\"/><geom size=\"0.1\"/>
        <include file=\"parts/hand.xml\"/>
      </body>
    </body>
  </worldbody>
</mujoco>\n";
const HAND: &str = "<mujoco>\n\n\n\n\n\n\n\n\n\n\n\n\n
  <body name=\"hand\" pos=\"0 0 1000\">
    <joint name=\"wrist\" type=\"ball\"/><geom size=\"0.1\"/></body>
</mujoco>\n";

/// The name in "link `NAME`".
fn name(subject: &str) -> Option<&str> {
    subject.split('`').nth(1)
}

/// Checks that a place is one in the files of `folder`, and adds the files with a line.
fn check(place: &Place, folder: &Path, with_line: &mut Vec<String>) {
    let file = place.file.as_deref().expect("a file");
    let text = fs::read_to_string(folder.join(file)).expect("a file that is there");
    if let Some(line) = place.line {
        let line = text.lines().nth(line.get() - 1).expect("a line of it");
        let name = place.subject.as_deref().and_then(name).expect("a name");
        assert!(line.contains(&format!("name=\"{name}\"")), "{name}: {line}");
        with_line.push(file.to_owned());
    }
    assert_eq!(place.written_at, None);
    place.related.iter().for_each(|related| check(related, folder, with_line));
}

/// Each line of what programs do is one of the MJCF with that part; those of included files have none.
fn check_programs(urdf: &Urdd) {
    let lines: Vec<&str> = ARM.lines().collect();
    let mut count = [0; 2];
    for effect in urdf.programs.iter().flat_map(|program| &program.effects) {
        let name = effect.part.as_deref().and_then(|part| part.split('/').nth(1));
        let name = name.unwrap_or_default();
        let line = effect.line.map(|line| lines[line.get() - 1]);
        assert!(line.is_none_or(|line| line.contains(&format!("name=\"{name}\""))), "{effect:?}");
        count[usize::from(line.is_some())] += 1;
    }
    assert!(count.iter().all(|count| *count > 0), "{count:?}");
}

#[test]
fn places_are_those_of_the_original() {
    let folder = tempfile::tempdir().expect("a folder");
    let arm = folder.path().join("arm.xml");
    fs::create_dir(folder.path().join("parts")).expect("a folder");
    fs::write(&arm, ARM).expect("written");
    fs::write(folder.path().join("parts/hand.xml"), HAND).expect("written");
    let (run, text) = lint_with_text(&arm, &[], None, &LintSettings::default()).expect("a report");
    assert_eq!(text.as_deref(), Some(ARM));
    let mut with_line = Vec::new();
    for finding in &run.report.urdds[0].findings {
        assert_eq!((finding.file.as_ref(), finding.line), {
            let first = &finding.places[0];
            (first.file.as_ref(), first.line)
        });
        finding.places.iter().for_each(|place| check(place, folder.path(), &mut with_line));
    }
    for file in ["arm.xml", "parts/hand.xml"] {
        assert!(with_line.iter().any(|with| with == file), "{file}: {with_line:?}");
    }
    check_programs(&run.report.urdds[0]);
    let at = places(&run, folder.path());
    let mut texts = [String::new(), String::new(), sarif(&run, &at, 0).expect("SARIF")];
    human::write(&run.report, Style::default(), &mut texts[0]).expect("text");
    github(&run.report, &at, &mut texts[1]).expect("text");
    for text in texts {
        assert!(!text.contains(".urdf\"") && !text.contains(".urdf:"), "{text}");
        assert!(text.contains("parts/hand.xml"), "{text}");
    }
}
