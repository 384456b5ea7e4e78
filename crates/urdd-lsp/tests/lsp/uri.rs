//! Paths of documents. Editors name documents by URIs, and spell the same path in several ways.

use std::path::Path;

use urdd_lsp::uri::*;

#[cfg(unix)]
#[test]
fn paths_survive() {
    for path in ["/a b/ü#%20.urdf", "/x/y+z/[1].urdf", "/\u{1F916}/a&b;c=d.urdf"] {
        let uri = of_path(Path::new(path)).expect("a URI");
        assert_eq!(urdd_lsp::uri::path(uri.as_str()).as_deref(), Some(Path::new(path)), "{uri:?}");
    }
}

#[cfg(unix)]
#[test]
fn spellings_of_editors_are_read() {
    for (uri, expected) in [
        ("file:///a%20b/c.urdf", Some("/a b/c.urdf")),
        ("file://localhost/a/c.urdf", Some("/a/c.urdf")),
        ("FILE:/a/c.urdf", Some("/a/c.urdf")),
        ("file:///a/c.urdf?x=1#y", Some("/a/c.urdf")),
        ("file://other/a/c.urdf", None),
        ("file://host", None),
        ("file:///a%ff", None),
        ("file:///a%00", None),
        ("untitled:Untitled-1", None),
        ("x", None),
    ] {
        assert_eq!(path(uri).as_deref(), expected.map(Path::new), "{uri}");
    }
    assert_eq!(file_name("untitled:Untitled-1"), "Untitled-1");
    assert_eq!(file_name("file:///a/b%20c.urdf"), "b c.urdf");
}
