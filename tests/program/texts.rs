//! The hostile texts of `export/texts.json` in the places of a URDF and a URDD, through the reports (JSON, SARIF, JUnit,
//! workflow commands of GitHub Actions, Markdown) and the page. By each format's own rules a text stays a text.
#![cfg(unix)]

use serde_json::Value;
use urdd_directory::cancellation::Cancellation;
use urdd_view::{Collection, export, page_with};

use crate::export::texts::{Table, texts};
use crate::printing::acts;
use crate::program::urdd;
use testkit::trials::sample;
use testkit::xml::parsed;

/// What is outside of code spans, by CommonMark's rule: a span ends at a run of as many backticks as begin it.
fn outside_of_code(line: &str) -> String {
    let mut out = String::new();
    let mut rest = line;
    while let Some(at) = rest.find('`') {
        out += &rest[..at];
        let from = &rest[at..];
        let after = from.trim_start_matches('`');
        let fence = &from[..from.len() - after.len()];
        let is_end = |(end, _): &(usize, &str)| {
            !after[..*end].ends_with('`') && !after[end + fence.len()..].starts_with('`')
        };
        match after.match_indices(fence).find(is_end) {
            Some((end, _)) => rest = &after[end + fence.len()..],
            None => panic!("a code span does not end: {line}"),
        }
    }
    out + rest
}

fn check(format: &str, text: &str) {
    let act = text.chars().find(|c| acts(*c));
    assert_eq!(act, None, "{format}: {text}");
    match format {
        "json" => _ = serde_json::from_str::<Value>(text).expect("JSON"),
        "sarif" => {
            let log: Value = serde_json::from_str(text).expect("JSON");
            for result in log["runs"][0]["results"].as_array().expect("results") {
                let message = result["message"]["text"].as_str().expect("a message");
                assert!(!message.contains("]("), "{message}");
                let uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
                    .as_str()
                    .expect("a URI");
                assert!(!uri.starts_with('/') && !uri.contains(".."), "{uri}");
            }
        }
        "junit" => {
            for node in parsed(text).descendants().filter(|node| node.is_element()) {
                let known = [
                    "testsuites",
                    "testsuite",
                    "testcase",
                    "failure",
                    "error",
                    "skipped",
                    "system-out",
                ];
                assert!(known.contains(&node.tag_name().name()), "{text}");
            }
        }
        "github" => {
            for line in text.lines() {
                let kinds = ["::error file=", "::warning file=", "::notice file="];
                let Some(rest) = kinds.iter().find_map(|kind| line.strip_prefix(kind)) else {
                    assert!(
                        !line.trim_start().starts_with("::") && !line.contains("##["),
                        "{line}"
                    );
                    continue;
                };
                let (properties, data) = rest.split_once("::").expect(line);
                assert!(!properties.contains('\r') && !data.contains("\r"), "{line}");
                for (at, _) in line.match_indices('%') {
                    let code = &line[at..at + 3];
                    assert!(["%25", "%3A", "%2C"].contains(&code), "{line}");
                }
            }
        }
        "markdown" | "human" => {
            for line in text.lines() {
                assert!(!line.trim_start().starts_with("::") && !line.contains("##["), "{line}");
                let words = if format == "human" { String::new() } else { outside_of_code(line) };
                let marks = words.trim_start_matches('#').find(|c| "<>[]*_|@!#&\\".contains(c));
                assert_eq!(marks, None, "{line}");
            }
        }
        other => panic!("{other}: say by which rule it is read"),
    }
}

#[test]
fn every_text_in_every_place_stays_a_text_in_every_report() {
    let table = Table::new();
    let before = table.copy();
    let places = table.places();
    let places = places.iter().filter(|place| place.starts_with("Place"));
    let cases = places.flat_map(|place| texts().into_iter().map(move |text| (place, text)));
    let mut findings = 0;
    for (place, text) in sample(cases, 97) {
        // A robot that cannot be opened is one of which the reports say why.
        let _ = table.with(place, &text);
        let path = table.path.to_str().expect("a path");
        for format in ["human", "json", "sarif", "junit", "github"] {
            let (status, out, said) = urdd(
                &["validate", path, "--format", format],
                table.path.parent().expect("a folder"),
            );
            assert!(status < 2, "{place}, {text:?}: {said}");
            check(format, &out);
            findings += usize::from(format == "github") * out.lines().count();
        }
        for format in ["markdown", "json"] {
            let before = before.path().to_str().expect("a path");
            let (_, out, _) =
                urdd(&["diff", "--no-findings", "--format", format, before, path], before.as_ref());
            if !out.is_empty() {
                check(format, &out);
            }
        }
    }
    assert!(findings > 20, "{findings}");
}

/// What a page has beside the data that it carries, which is base64.
fn beside_data(page: &str) -> String {
    let mut parts = page.split("<script type=\"text/plain\" id=\"");
    let mut beside = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (id, rest) = part.split_once("\">").expect("an id");
        let (data, rest) = rest.split_once("</script>").expect("an end");
        let is_base64 = data.bytes().all(|b| b.is_ascii_alphanumeric() || b"+/=".contains(&b));
        assert!(is_base64, "{id}");
        beside += id;
        beside += rest;
    }
    // The last line is a hash of all.
    beside.trim_end().rsplit_once('\n').expect("lines").0.to_owned()
}

/// The page of a site, without the hashes that name its files; its file names are of ours.
fn page_of_site(site: &std::path::Path) -> String {
    let files = testkit::files::below(site);
    for file in files.keys() {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
        assert!(file.chars().all(is_plain) && !file.contains(".."), "{file}");
    }
    let (_, page) = files.into_iter().find(|(file, _)| file == "index.html").expect("a page");
    let page = String::from_utf8(page).expect("UTF-8");
    let (start, rest) = page.split_once("name=\"urdd-files\" content=\"").expect("names");
    format!("{start}{}", rest.split_once('"').expect("an end").1)
}

/// In one file and as a site, whatever a robot says.
#[test]
fn the_page_of_a_robot_is_our_page() {
    let table = Table::new();
    let made = || {
        let collection = Collection::default();
        collection.add(&table.path).ok()?;
        let page = page_with(&collection.robots()[0], None).ok()?;
        let site = testkit::temporary::folder();
        export(&collection, site.path(), None, &Cancellation::default(), &mut |_| {}).ok()?;
        Some((beside_data(&page), page_of_site(site.path())))
    };
    let ours = made().expect("a page");
    let places = table.places();
    let cases = places.iter().flat_map(|place| texts().into_iter().map(move |text| (place, text)));
    let mut shown = 0;
    for (place, text) in sample(cases, 2003) {
        let _ = table.with(place, &text);
        if let Some(page) = made() {
            assert!(page == ours, "{place}, {text:?}");
            shown += 1;
        }
    }
    assert!(shown > 1, "{shown}");
}
