//! A virtual tree of folders, files and links.

use urdd_directory::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use urdd_directory::listing::ReadError;
use urdd_directory::source::{Item, Node, Tree};

fn tree(paths: &[&str]) -> Result<Tree<()>, String> {
    let item = |path: &&str| {
        let node = match path.strip_suffix('/') {
            Some(_) => Node::Folder,
            None => Node::File { size: 1, data: () },
        };
        let path = path.trim_end_matches('/').to_owned();
        let utf8 = true;
        Item { path, utf8, node }
    };
    Tree::new(paths.iter().map(item).collect())
}

#[test]
fn folders_follow_from_paths() {
    let tree = tree(&["a/b/c", "a.b", "a/b.c", "a-/x", "d/", "d/"]).expect("a tree");
    let listing = tree.listing();
    let paths: Vec<&str> = listing.entries.iter().map(|entry| &*entry.path).collect();
    let expected = ["a", "a-", "a-/x", "a.b", "a/b", "a/b.c", "a/b/c", "d"];
    assert_eq!(paths, expected);
    for path in ["a", "a-", "a/b", "d"] {
        assert!(listing.has_folder(path), "{path}");
        assert_eq!(tree.file(path), Err(ReadError::NotAFile));
    }
    for path in ["a.b", "a/b.c", "a/b/c", "a-/x"] {
        assert!(listing.has_file(path), "{path}");
        assert!(tree.file(path).is_ok(), "{path}");
    }
    for path in ["b", "a/c", "a/b/c/d", "a/b/", "a/b/cc"] {
        assert!(tree.file(path).is_err(), "{path}");
    }
}

#[test]
fn a_path_has_one_meaning() {
    for (paths, clash) in [
        (&["a", "a"][..], "a"),
        (&["a", "a.b", "a/b"], "a/b"),
        (&["a", "a/"], "a"),
        (&["x/a/b/c", "x/a"], "x/a/b/c"),
    ] {
        assert_eq!(tree(paths).err().as_deref(), Some(clash), "{paths:?}");
    }
    assert!(tree(&["a/", "a/b", "a.b", "ab"]).is_ok());
}

#[test]
fn levels_beyond_the_limit_are_not_listed() {
    let deep = vec!["d"; 40].join("/");
    let listing = tree(&["d/x", &deep]).expect("a tree").listing();
    assert!(listing.cut);
    let folders = listing.entries.iter().filter(|e| e.path.ends_with('d'));
    assert_eq!(folders.count(), MAX_FOLDER_DEPTH);
    assert!(tree(&[&deep]).expect("a tree").file(&deep).is_ok());
}

#[test]
fn files_beyond_the_limit_are_not_listed() {
    let paths: Vec<String> = (0..=MAX_FILES).map(|at| at.to_string()).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    assert_eq!(tree(&paths).expect("a tree").listing().entries.len(), MAX_FILES);
}

/// Each link is followed by a link to the one before.
#[test]
fn links_that_lead_to_links_are_followed_so_often() {
    let node = |at: usize| match at {
        0 => Node::File { size: 1, data: () },
        _ => Node::Link((at - 1).to_string()),
    };
    let items = (0..50).map(|at| Item { path: at.to_string(), utf8: true, node: node(at) });
    let tree = Tree::new(items.collect()).expect("a tree");
    assert!(tree.file("40").is_ok());
    assert!(matches!(tree.file("41"), Err(ReadError::Io(_))));
}
