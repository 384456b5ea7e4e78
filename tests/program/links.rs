//! Relative links of the pages lead to existing files and headings.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders whose pages are checked.
const FOLDERS: [&str; 8] = [
    "",
    "docs",
    "conformance",
    "conformance/vectors",
    "python",
    "tests/figures",
    "wasm",
    "wasm/npm",
];

/// The lines of a page outside of code blocks.
fn prose(text: &str) -> Vec<&str> {
    let mut in_code = false;
    let outside = |line: &&str| {
        let is_fence = line.trim_start().starts_with("```");
        in_code ^= is_fence;
        !is_fence && !in_code
    };
    text.lines().filter(outside).collect()
}

/// The targets of a page's relative links.
fn links(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for line in prose(text) {
        let without_code: String = line.split('`').step_by(2).collect();
        let targets = without_code.split("](").skip(1);
        let targets = targets.filter_map(|rest| rest.split_once(')'));
        found.extend(targets.map(|(target, _)| target.to_owned()));
    }
    found.retain(|target| !target.contains("://") && !target.starts_with("mailto:"));
    found
}

/// The anchors of a page's headings, as GitHub makes them.
fn anchors(text: &str) -> Vec<String> {
    let headings = prose(text).into_iter().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| -> String {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
        let kept: String = words.chars().filter(kept).collect();
        kept.replace(' ', "-")
    };
    headings.map(anchor).collect()
}

/// The faults in the links of a page in a folder.
fn faults(folder: &Path, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    for link in links(text) {
        let (file, heading) = link.split_once('#').unwrap_or((&link, ""));
        let path = folder.join(file);
        if !path.exists() {
            faults.push(format!("{link}: {file} is missing"));
        } else if !heading.is_empty() {
            let target = match file {
                "" => text.to_owned(),
                _ => fs::read_to_string(&path).unwrap_or_default(),
            };
            if !anchors(&target).iter().any(|one| one == heading) {
                faults.push(format!("{link}: the page has no such heading"));
            }
        }
    }
    faults
}

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = Vec::new();
    for folder in FOLDERS {
        let folder = root.join(folder);
        let entries = fs::read_dir(&folder).expect("a folder of pages");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        pages.extend(paths.filter(|path| path.extension().is_some_and(|end| end == "md")));
    }
    pages
}

#[test]
fn links_lead_somewhere() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    for page in pages() {
        let text = fs::read_to_string(&page).expect("a page");
        let folder = page.parent().expect("a folder");
        count += links(&text).len();
        let found = faults(folder, &text);
        wrong.extend(found.iter().map(|it| format!("{}: {it}", page.display())));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 50, "only {count} links were checked");
}

#[test]
fn a_link_to_nothing_is_a_fault() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let good = "# One `two` three\n[a](../README.md), [`b`](../README.md#a-tour), [c](#one-two-three), [d](https://x.org)\n\
                ```\n[e](no.md)\n```\n`[f](no.md)`\n";
    assert_eq!(faults(&folder, good), Vec::<String>::new());
    for bad in ["[a](no.md)", "[a](../README.md#no)", "[a](#no)"] {
        assert_eq!(faults(&folder, bad).len(), 1, "{bad}");
    }
}

#[test]
fn the_site_has_every_page_of_docs_in_its_menu() {
    let docs = testkit::repository().join("docs");
    let settings = fs::read_to_string(docs.join("site/mkdocs.yml")).unwrap();
    let pages = fs::read_dir(&docs).unwrap().map(|entry| entry.unwrap());
    let pages = pages.map(|entry| entry.file_name().into_string().unwrap());
    let pages: Vec<String> = pages.filter(|name| name.ends_with(".md")).collect();
    assert!(pages.len() > 10, "{pages:?}");
    for page in pages {
        assert!(
            settings.contains(&format!(": docs/{page}\n")),
            "docs/{page} is not in the site's menu: add it to `nav` in docs/site/mkdocs.yml"
        );
    }
}
