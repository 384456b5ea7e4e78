//! What the user sets, in the editor.

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::json;
use urdd_lsp::options::*;

#[test]
fn what_is_not_named_or_of_another_type_stays() {
    let mut options = Options::default();
    options.update(
        &json!({"xacro": true, "packagePaths": ["/a b", "c", 7], "baseline": "b.json"}),
        Some(Path::new("/w")),
    );
    assert!(options.xacro);
    assert_eq!(options.package_paths, [PathBuf::from("/a b"), PathBuf::from("/w/c")]);
    options.update(&json!({"urdd": {"xacro": "yes", "baseline": null, "debounce": 99_999}}), None);
    assert!(options.xacro);
    assert_eq!(options.baseline, Some(PathBuf::from("/w/b.json")));
    assert_eq!(options.debounce, Duration::from_secs(10));
    options.update(&json!(null), None);
    let none = json!({"xacro": false, "packagePaths": [], "baseline": "", "debounce": 150});
    options.update(&json!({"urdd": none}), None);
    assert_eq!(options, Options::default());
}
