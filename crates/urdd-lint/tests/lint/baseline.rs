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
fn other_files_are_no_baselines() {
    let folder = std::path::Path::new(".");
    for text in
        ["", "{}", "{\"urdd_baseline\": 2, \"files\": {}}", "{\"urdd_baseline\": 1, \"files\": []}"]
    {
        assert!(Baseline::from_json(text, folder).is_err(), "{text}");
    }
}
