//! Finds many positions of a JSON text in one pass.

use urdd_directory::json_scan::*;

#[test]
fn broken_text_ends_the_search() {
    for text in crate::json_scan::BROKEN {
        assert_eq!(find_values(text, &["/a/0"]), [None], "{text}");
    }
}

#[test]
fn many_are_found_as_one_is() {
    let text = r#" {"a~/": [1, {"b": [2, 3]}, []], "c": {"d": 4, "d": {"e": 5}}, "f": "]}\"", "c": {"d": [6]}} "#;
    let pointers = [
        "",
        "/a~0~1",
        "/a~0~1/0",
        "/a~0~1/1/b/1",
        "/a~0~1/2/0",
        "/a~0~1/01",
        "/c",
        "/c/d",
        "/c/d/e",
        "/c/d/0",
        "/f",
        "/g",
        "/f/0",
        "x",
        "/~2",
        "/c/d/0",
    ];
    let many = find_values(text, &pointers);
    let each: Vec<Option<usize>> = pointers.iter().map(|p| find_values(text, &[p])[0]).collect();
    assert_eq!(many, each);
    assert_eq!(many.iter().flatten().count(), 9);
}
