//! What is refused, by name and place, and what is large.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

mod common;

use std::fmt::Write;

use common::{composed, memory, refused, stage};
use urdd_usd::{MAX_LEVELS, beside, open};

#[test]
fn text_that_is_not_usd() {
    for (text, error) in [
        ("def \"a\" {", "root.usda:2:10: the file ends inside of a prim"),
        ("def Xform {}", "root.usda:2:11: expected the name of a prim, found `{`"),
        ("def \"a\" { float x = (1, \"b\") }", "expected a number or `)`, found \"b\""),
        ("def \"a\" { float[] x = [(1, 2), (1, 2, 3)] }", "expected entries of one type"),
        (
            "def \"a\" { string s = \"open\n }",
            "root.usda:2:22: the file ends inside of a text in quotes",
        ),
        ("def \"a\" { rel r = </a\n }", "the file ends inside of a path"),
        ("def \"a\" { float x.spline = {} }", "`spline`, which is not read"),
        ("}", "root.usda:2:1: expected a prim, a property or `}`, found `}`"),
        ("/* ", "inside of a comment"),
    ] {
        let found = refused(text);
        assert!(found.contains(error), "{text}: {found}");
    }
    let kind = stage(&[("a.usd", "<robot/>")]).unwrap_err().to_string();
    assert_eq!(kind, "a.usd: not a USD layer: expected `#usda 1.0`, a crate file or a zip archive");
}

/// As usd-core has it: `;` or a line break ends a statement, in prims, metadata and dictionaries.
#[test]
fn statements_in_one_line() {
    let prim = |inside: &str| format!("def \"a\" {{ {inside} }}");
    let metadata = |inside: &str| format!("def \"a\" ( {inside} ) {{}}");
    for text in [
        prim("int x = 1 int y = 2"),
        prim("int x int y"),
        prim("rel x = </a> rel y = </a>"),
        prim("int x = 1 def \"b\" {}"),
        prim("def \"b\" {} int x = 1"),
        prim("int x = 1 ( doc = \"one\" ) int y = 2"),
        prim("int x.timeSamples = {0: 1} int y = 1"),
        prim("reorder properties = [\"a\"] int y = 1"),
        prim("int x = 1 /* one */ int y = 2"),
        prim("variantSet \"v\" = { \"x\" {} \"y\" {} }"),
        prim("variantSet \"v\" = { \"x\" {} } int x = 1"),
        "def \"a\" {} def \"b\" {}".to_owned(),
        "( upAxis = \"Z\" metersPerUnit = 1 )".to_owned(),
        metadata("active = true hidden = true"),
        metadata("\"said\" active = true"),
        metadata("references = </b> inherits = </c>"),
        metadata("customData = {int a = 1 int b = 2}"),
        metadata("customData = {dictionary a = {} int b = 2}"),
    ] {
        let found = refused(&text);
        assert!(
            found.contains("expected `;` or a line break after a statement"),
            "{text}: {found}"
        );
    }
    for text in [
        prim("int x = 1; int y = 2;"),
        prim("int x = 1 # one\n int y = 2"),
        prim("int x = 1\n\n int y = 2"),
        metadata("active = true; hidden = true"),
        metadata("\"said\"; active = true"),
        metadata("customData = {int a = 1; int b = 2}\n active = true"),
    ] {
        composed(&text);
    }
}

#[test]
fn composition_that_is_not_read() {
    for (text, error) in [
        ("def \"a\" (references = @`${X}.usd`@) {}", "is an expression"),
        ("( relocates = {</a>: </b>} )", "relocates are not read"),
        ("( subLayers = [@root.usda@] )", "sublayers go round in a circle at `root.usda`"),
        ("( subLayers = [@gone.usd@] )", "root.usda: cannot read `gone.usd`: no such file"),
        ("( subLayers = [@https://a.b/c.usd@] )", "layers from the network are not read"),
    ] {
        let found = refused(text);
        assert!(found.contains(error), "{text}: {found}");
    }
    // A sublayer of what is referenced.
    let files = [
        ("a.usda", "#usda 1.0\ndef \"a\" (references = @b.usda@) {}"),
        ("b.usda", "#usda 1.0\n( subLayers = [@c.usda@] )"),
    ];
    let found = stage(&files).unwrap_err().to_string();
    assert_eq!(found, "b.usda: cannot read `c.usda`: no such file");
}

#[test]
fn references_that_are_not_there() {
    for (text, error) in [
        (
            "def \"a\" (references = @https://a.b/c.usd@) {}",
            "root.usda:2:1: `https://a.b/c.usd` is not a file",
        ),
        ("def \"a\" (payload = @omniverse://a/c.usd@) {}", "layers from the network are not read"),
        (
            "def \"a\" (references = @gone.usd@) {}",
            "root.usda:2:1: cannot read `gone.usd`: no such file",
        ),
        ("def \"a\" (references = @../up.usd@) {}", "cannot read `../up.usd`"),
        ("def \"a\" (references = </gone>) {}", "prim `/gone` is not in `root.usda`"),
        ("def \"a\" (references = @root.usda@) {}", "`root.usda` has no default prim"),
    ] {
        let stage = composed(text);
        let [(Some(0), found)] = &stage.missing[..] else { panic!("{:?}", stage.missing) };
        assert!(found.to_string().contains(error), "{text}: {found}");
    }
    // What is not a prim without it: the prim above has it.
    let stage = composed(
        "def \"a\" { over \"b\" (references = @gone.usd@) {} }\nover \"c\" (references = @gone.usd@) {}",
    );
    let holders: Vec<_> = stage.missing.iter().map(|(holder, _)| *holder).collect();
    assert_eq!((stage.prims.len(), holders), (1, vec![Some(0), None]));
}

#[test]
fn circles() {
    for text in [
        "def \"a\" (references = </a>) {}",
        "def \"a\" (references = </b>) {}\ndef \"b\" (references = </a>) {}",
        "def \"a\" { def \"b\" (references = </a>) {} }",
        "def \"a\" (inherits = </a>) {}",
        "def \"a\" (references = </b/x>) {}\ndef \"b\" (references = </a>) { def \"x\" {} }",
        "def \"a\" (variantSets = \"v\"\n variants = {string v = \"x\"}) { variantSet \"v\" = { \"x\" (references = </a>) {} } }",
    ] {
        let found = refused(text);
        assert!(found.contains("in a circle"), "{text}: {found}");
    }
    let files = [
        ("a.usda", "#usda 1.0\ndef \"a\" (references = @b.usda@</b>) {}"),
        ("b.usda", "#usda 1.0\ndef \"b\" { def \"c\" (payload = @./x/../a.usda@</a>) {} }"),
    ];
    let found = stage(&files).unwrap_err().to_string();
    assert!(found.contains("in a circle at `/a`"), "{found}");
}

/// Each prim brings in two others, which doubles the sites of each.
#[test]
fn sources_that_double() {
    let mut text = String::new();
    for at in 0..40 {
        let next = at + 1;
        writeln!(text, "def \"p{at}\" (references = [</p{next}>, </q{next}>]) {{}}").unwrap();
        writeln!(text, "def \"q{at}\" (references = [</p{next}>, </q{next}>]) {{}}").unwrap();
    }
    text += "def \"p40\" {}\ndef \"q40\" {}";
    let found = refused(&text);
    assert!(found.contains("more than 1000 sources"), "{found}");
    // The same by prims inside of others.
    let mut text = String::new();
    for at in 0..200 {
        writeln!(text, "def \"p{at}\" (references = </p{}/x>) {{ def \"x\" {{}} }}", at + 1)
            .unwrap();
    }
    text += "def \"p200\" { def \"x\" {} }";
    let found = refused(&text);
    assert!(found.contains("in a circle"), "{found}");
}

#[test]
fn prims_in_each_other() {
    let nested = |levels: usize| {
        let mut text: String = (0..levels).map(|_| "def \"a\" {\n").collect();
        text.extend(std::iter::repeat_n('}', levels));
        text
    };
    let stage = composed(&nested(MAX_LEVELS));
    assert_eq!(stage.prims.len(), MAX_LEVELS);
    let found = refused(&nested(100_000));
    assert!(found.contains(&format!("nested more than {MAX_LEVELS} levels deep")), "{found}");
    let deep =
        format!("( customData = {}{} )", "{dictionary a = ".repeat(100_000), "}".repeat(100_000));
    assert!(refused(&deep).contains("values are nested more than"), "{}", refused(&deep));
    let deep = format!("def \"a\" {{ float x = {}1{} }}", "(".repeat(100_000), ")".repeat(100_000));
    assert!(refused(&deep).contains("values are nested more than"));
}

#[test]
fn many_fields() {
    let fields: String = (0..2000).map(|at| format!("f{at} = 1\n")).collect();
    let found = refused(&format!("def \"a\" ( {fields} ) {{}}"));
    assert!(found.ends_with("a prim or property has more than 1000 fields"), "{found}");
}

#[test]
fn many_prims() {
    let mut text = String::from("#usda 1.0\n");
    for at in 0..100_000 {
        writeln!(text, "def \"p{at}\" {{ double x = {at} }}").unwrap();
    }
    let mut files = memory(&[("root.usda", &text)]);
    let stage = open("root.usda", &mut files).unwrap();
    assert_eq!(stage.prims.len(), 100_000);
    let used = (1 << 30) - files.left.get();
    // What is charged is a small multiple of what was read.
    assert!(used < 100 * text.len() + (16 << 20), "{used} for {}", text.len());
    let mut files = memory(&[("root.usda", &text)]);
    files.left.set(100 << 20);
    let found = open("root.usda", &mut files).unwrap_err().to_string();
    assert!(found.contains("needs more memory or work"), "{found}");
}

#[test]
fn paths_of_files() {
    for (layer, asset, path) in [
        ("a.usda", "./b.usda", "b.usda"),
        ("x/a.usda", "../b.usda", "b.usda"),
        ("x/a.usda", "../../b.usda", "../b.usda"),
        ("x/a.usda", "y/./z//b.usda", "x/y/z/b.usda"),
        ("x/a.usda", "/b.usda", "/b.usda"),
        ("/x/a.usda", "../b.usda", "/b.usda"),
        ("p.usdz[x/a.usda]", "../b.usda", "p.usdz[b.usda]"),
        ("p.usdz[q.usdz[x/a.usda]]", "../b.usda", "p.usdz[q.usdz[b.usda]]"),
        ("a.usda", r"x\b.usda", "x/b.usda"),
    ] {
        assert_eq!(beside(layer, asset), path, "{layer} {asset}");
    }
}
