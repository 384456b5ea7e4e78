//! A description is read once: how often a file is parsed, by each kind of parser.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use rayon::ThreadPoolBuilder;
use urdd_lint::{LintSettings, lint, lint_text};
use urdd_xml::tally;

/// A robot in which no rule and no program finds a fault.
const CLEAN: &str = include_str!("../cases/LNT001/near_miss_slides.urdf");

/// Its SRDF, without a fault.
const SRDF: &str = r#"<robot name="arm"><group name="all"><chain base_link="world" tip_link="upper"/></group></robot>"#;

/// What each kind of parser read while `work` ran.
fn parses(work: impl FnOnce() + Send) -> BTreeMap<&'static str, usize> {
    // Parses are counted by thread.
    let threads = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    threads.install(|| {
        tally::take();
        work();
        tally::take()
    })
}

/// Each kind of parser, so many times.
fn each(count: usize) -> BTreeMap<&'static str, usize> {
    ["TinyXML", "rapidxml", "roxmltree", "tinyxml2"].map(|parser| (parser, count)).into()
}

#[test]
fn a_clean_file_is_parsed_once_by_each_kind_of_parser() {
    let (folder, file) = super::written(CLEAN);
    let linted = |path: PathBuf| {
        move || {
            let run = lint(&[path], &LintSettings::default()).expect("a report");
            assert_eq!(super::codes(&run), Vec::<String>::new());
        }
    };
    assert_eq!(parses(linted(file.clone())), each(1));
    // In a folder, it might be a part of robots.
    assert_eq!(parses(linted(folder.path().to_owned())), each(1));
    // So is its SRDF, which four rules read.
    fs::write(folder.path().join("slide.srdf"), SRDF).expect("written");
    let with_srdf = BTreeMap::from_iter(each(1).into_iter().map(|(parser, count)| match parser {
        "roxmltree" => (parser, count + 1),
        _ => (parser, count),
    }));
    assert_eq!(parses(linted(file)), with_srdf);
    let text = || drop(lint_text(CLEAN, "r.urdf", folder.path(), &LintSettings::default()));
    assert_eq!(parses(text), each(1));
}

/// A misspelling is mended, and the rules look at the mended text to find what goes away with it.
#[test]
fn a_misspelt_file_is_parsed_once_more() {
    let misspelt = CLEAN.replace("<visual>", "<visuel>").replace("</visual>", "</visuel>");
    assert_ne!(misspelt, CLEAN);
    let (_folder, file) = super::written(&misspelt);
    let linted = || drop(super::linted(&file, &LintSettings::default()));
    assert_eq!(parses(linted), each(2));
}
