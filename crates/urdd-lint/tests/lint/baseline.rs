//! A baseline leaves out what was there.

use std::fs;

use super::{SLIDE, codes, linted, written};
use urdd_findings::baseline::Baseline;
use urdd_lint::LintSettings;

#[test]
fn what_was_there_is_left_out_wherever_it_moves_and_what_is_new_is_not() {
    let (folder, file) = written(SLIDE);
    let first = linted(&file, &LintSettings::default());
    let baseline = Baseline::of(&first, folder.path());
    assert_eq!(baseline.count(), 1);
    let again = Baseline::from_json(&baseline.to_json(), folder.path());
    assert_eq!(again.as_ref(), Ok(&baseline));
    let settings = LintSettings { baseline: Some(baseline.into()), ..LintSettings::default() };
    let found = |text: &str| {
        fs::write(&file, text).expect("written");
        let run = linted(&file, &settings);
        (codes(&run), run.report.stale_ignores.len())
    };
    assert_eq!(found(SLIDE), (vec![], 0));
    assert_eq!(found(&SLIDE.replace("<joint", "\n\n  <joint")), (vec![], 0));
    // Another joint with the same fault.
    let end = SLIDE.find("</joint>").expect("it") + "</joint>".len();
    let joint = &SLIDE[SLIDE.find("<joint").expect("it")..end];
    let joint = joint.replace("along", "across").replace("carriage", "tool");
    let two = SLIDE.replace("</robot>", &format!("{joint}<link name=\"tool\"/></robot>"));
    let (codes, stale) = found(&two);
    assert!(codes.contains(&"LNT012".to_owned()), "{codes:?}");
    assert_eq!(stale, 0);
    // Mended: the baseline has one too many.
    assert_eq!(found(&SLIDE.replace("1.01", "1")), (vec![], 1));
}

#[test]
fn a_new_argument_in_urdd_toml_leaves_what_is_known_known() {
    let (folder, file) = written(SLIDE);
    let name = file.file_name().expect("a name").to_string_lossy().into_owned();
    let known = Baseline::of(&linted(&file, &LintSettings::default()), folder.path()).to_json();
    let key = format!("\"{name}\": {{");
    assert!(known.contains(&key), "{known}");
    let left = |robot: &str, arguments: &[&str]| {
        let others = format!("\"{name}x\": {{}}, \"{name} type:=b\": {{}}, \"{name}{robot}\": {{");
        let text = known.replace(&key, &others);
        let baseline = Baseline::from_json(&text, folder.path()).expect("a baseline");
        let mut examined =
            urdd_lint::lint_text(SLIDE, &name, folder.path(), &LintSettings::default());
        examined.report.xacro_arguments = arguments.iter().map(ToString::to_string).collect();
        baseline.apply(&file, &mut examined);
        examined.checks.iter().map(|check| check.findings.len()).sum::<usize>()
    };
    assert_eq!(left(" type:=a", &["type:=a"]), 0);
    // One more, in front of it or behind, and one less.
    assert_eq!(left(" type:=a", &["side:=left", "type:=a"]), 0);
    assert_eq!(left(" type:=a", &["type:=a", "z:=1"]), 0);
    assert_eq!(left(" side:=left type:=a", &["type:=a"]), 0);
    // Another value is another robot.
    assert_eq!(left(" type:=a", &["type:=c"]), 1);
    assert_eq!(left(" type:=a", &["type:=b", "z:=1"]), 1);
}

#[test]
fn other_files_are_no_baselines() {
    let folder = std::path::Path::new(".");
    for text in
        ["", "{}", "{\"urdd_baseline\": 2, \"files\": {}}", "{\"urdd_baseline\": 1, \"files\": []}"]
    {
        assert!(Baseline::from_json(text, folder).is_err(), "{text}");
    }
}
