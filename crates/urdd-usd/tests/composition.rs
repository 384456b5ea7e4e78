//! What layers compose. The strengths are those of USD: usd-core composes the same of each.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

mod common;

use common::{composed, find, stage, take};
use urdd_directory::account::Account;
use urdd_usd::{Authored, Stage, Value};

fn number(stage: &Stage, path: &str) -> f64 {
    let (_, property) = path.rsplit_once('.').unwrap();
    let prim = &stage.prims[find(stage, path).unwrap_or_else(|| panic!("{path}"))];
    prim.value(property).and_then(Authored::number).unwrap_or_else(|| panic!("{path}"))
}

fn targets(stage: &Stage, path: &str) -> Vec<String> {
    let (_, property) = path.rsplit_once('.').unwrap();
    let prim = &stage.prims[find(stage, path).unwrap()];
    prim.targets(property)
        .walk(&Account::default())
        .unwrap()
        .map(|target| target.to_string())
        .collect()
}

#[test]
fn local_is_stronger_than_variants_references_and_payloads() {
    let stage = stage(&[
        (
            "root.usda",
            r#"#usda 1.0
            def "a" (
                references = @sub/r.usda@
                payload = @sub/p.usda@</p>
                inherits = </_class>
                variantSets = "v"
                variants = { string v = "x" }
            ) {
                double local = 1
                variantSet "v" = {
                    "x" { double local = 2
                          double variant = 2 }
                    "y" { double variant = 9 }
                }
            }
            class "_class" {
                double local = 3
                double variant = 3
                double inherited = 3
            }
            "#,
        ),
        (
            "sub/r.usda",
            r#"#usda 1.0
            ( defaultPrim = "r" )
            def Xform "r" {
                double local = 4
                double inherited = 4
                double variant = 4
                double referenced = 4
                rel to = [</r/child>, </r/child.local>]
                def "child" { double local.connect = </r.local>
                              asset mesh = @../m.stl@ }
            }
            def "outside" {}
            "#,
        ),
        (
            "sub/p.usda",
            r#"#usda 1.0
            def "p" {
                double referenced = 5
                double paid = 5
                prepend rel to = [</p/own>]
            }
            "#,
        ),
    ])
    .unwrap();
    for (name, value) in
        [("local", 1.0), ("variant", 3.0), ("inherited", 3.0), ("referenced", 4.0), ("paid", 5.0)]
    {
        assert_eq!(number(&stage, &format!("/a.{name}")), value, "{name}");
    }
    assert_eq!(&*stage.prims[0].type_name, "Xform");
    // An explicit list hides those of weaker opinions.
    assert_eq!(targets(&stage, "/a.to"), ["/a/child", "/a/child.local"]);
    assert_eq!(targets(&stage, "/a/child.local"), ["/a.local"]);
    let child = &stage.prims[find(&stage, "/a/child").unwrap()];
    assert_eq!(take(child.value("mesh")), &Value::Asset("m.stl".into()));
    assert_eq!(stage.prims.len(), 2);
    assert_eq!(stage.layers.len(), 3);
}

#[test]
fn sublayers_are_weaker_in_their_order() {
    let stage = stage(&[
        ("root.usda", "#usda 1.0\n(subLayers = [@one.usda@, @two.usda@])\nover \"a\" { double root = 0 }"),
        ("one.usda", "#usda 1.0\n(subLayers = [@three.usda@])\nover \"a\" { double x = 1\n double root = 1 }"),
        ("two.usda", "#usda 1.0\ndef \"a\" { double x = 2\n double y = 2\n def \"second\" {} }"),
        ("three.usda", "#usda 1.0\nover \"a\" { double x = 3\n double y = 3\n double z = 3\n def \"first\" {} }"),
    ])
    .unwrap();
    for (path, value) in [("/a.root", 0.0), ("/a.x", 1.0), ("/a.y", 3.0), ("/a.z", 3.0)] {
        assert_eq!(number(&stage, path), value, "{path}");
    }
    // Those of weaker layers come first.
    let names: Vec<_> = stage.prims.iter().map(|prim| &*prim.name).collect();
    assert_eq!(names, ["a", "second", "first"]);
}

/// The prim that is referenced gets what the prims above it are composed of.
#[test]
fn a_prim_inside_of_what_is_referenced() {
    let stage = composed(
        r#"
        def "robot" ( references = </parts/arm> ) { over "hand" { double mine = 1 } }
        def "used" ( references = </robot/hand> ) {}
        def "parts" { def "arm" { def "hand" { double weight = 2
            rel other = </parts/arm> } } }
        "#,
    );
    assert_eq!(number(&stage, "/robot/hand.weight"), 2.0);
    assert_eq!(number(&stage, "/used.weight"), 2.0);
    assert_eq!(number(&stage, "/used.mine"), 1.0);
    assert_eq!(targets(&stage, "/robot/hand.other"), ["/robot"]);
}

#[test]
fn a_class_of_what_is_referenced_counts_here() {
    let stage = stage(&[
        ("root.usda", "#usda 1.0\nclass \"_c\" { double x = 1 }\ndef \"a\" (references = @r.usda@</r>) {}"),
        ("r.usda", "#usda 1.0\nclass \"_c\" { double x = 2\n double y = 2 }\ndef \"r\" (inherits = </_c>) {}"),
    ])
    .unwrap();
    assert_eq!((number(&stage, "/a.x"), number(&stage, "/a.y")), (1.0, 2.0));
}

#[test]
fn instances_are_what_they_bring_in() {
    let stage = composed(
        r#"
        def "a" ( instanceable = true
            references = </proto> ) { double own = 1
            over "shape" { double size = 5 } }
        def "proto" { double own = 2
            def Cube "shape" { double size = 2 } }
        "#,
    );
    assert_eq!((number(&stage, "/a.own"), number(&stage, "/a/shape.size")), (1.0, 2.0));
    assert!(stage.prims[0].is_instance);
}

#[test]
fn prims_that_are_not_there() {
    let stage = composed(
        r#"
        def "a" { def "off" ( active = false ) { def "below" {} }
                  over "only" { def "inside" {} } }
        class "c" { def "inside" {} }
        "#,
    );
    assert_eq!(stage.prims.len(), 1);
}

#[test]
fn lists_edit_those_of_weaker_layers() {
    let stage = stage(&[
        (
            "root.usda",
            "#usda 1.0\n(subLayers = [@weak.usda@])\nover \"a\" (\n prepend apiSchemas = [\"One\", \"Three\"]\n delete apiSchemas = [\"Gone\"]\n append apiSchemas = [\"Two\"]\n customData = {double x = 1\n dictionary in = {int a = 1}}) {}",
        ),
        (
            "weak.usda",
            "#usda 1.0\ndef \"a\" (apiSchemas = [\"Gone\", \"Two\", \"Three\", \"Old\"]\n customData = {double x = 2\n double y = 2\n dictionary in = {int a = 2; int b = 2}}) {}",
        ),
    ])
    .unwrap();
    let prim = &stage.prims[0];
    let schemas: Vec<&str> = prim.schemas.iter().map(|name| &**name).collect();
    assert_eq!(schemas, ["One", "Three", "Old", "Two"]);
    let data = take(prim.field("customData"));
    assert_eq!(
        (data.get("x"), data.get("y")),
        (Some(&Value::Number(1.0)), Some(&Value::Number(2.0)))
    );
    let inside = data.get("in").unwrap();
    assert_eq!(
        (inside.get("a"), inside.get("b")),
        (Some(&Value::Number(1.0)), Some(&Value::Number(2.0)))
    );
}

#[test]
fn words_of_text() {
    let stage = composed(
        r##"( "a comment" )
        /* over lines
        */ def Xform "a" ( "said" ) { // and so
            custom string s = 'one \x41 \101 \n' ( doc = """of
                three "lines" """ )
            float[] none = []
            token[] t = ["a", "b",]
            float3 v = (1, -.5, 1e-3); double d = -inf
            double moves.timeSamples = { 2: 5, 1: 4, }
            uniform matrix4d m = ((1,0,0,0),(0,1,0,0),(0,0,1,0),(1,2,3,1))
            asset far = @@@a@b\@@@c@@@
            rel r
            prepend rel r = <../a/b>
            append rel r = [<.v>]
            reorder properties = ["s"]
            def "b" {}
        }
        "##,
    );
    let a = &stage.prims[0];
    let text = |name: &str| take(a.value(name)).text().unwrap().to_string();
    assert_eq!(text("s"), "one A A \n");
    assert_eq!(text("far"), "a@b@@@c");
    assert_eq!(a.value("v").unwrap().tuple(), Some([1.0, -0.5, f64::from(1e-3f32)]));
    assert_eq!(a.value("d").unwrap().number(), Some(f64::NEG_INFINITY));
    assert_eq!(a.value("moves").unwrap().number(), Some(4.0));
    assert_eq!(take(a.value("m")).numbers().unwrap()[12..], [1.0, 2.0, 3.0, 1.0]);
    assert_eq!(take(a.value("t")).texts().unwrap().len(), 2);
    assert_eq!(take(a.value("none")), &Value::Numbers { width: 1, values: [].into() });
    assert_eq!(targets(&stage, "/a.r"), ["/a/b", "/a.v"]);
    assert_eq!(a.place.1, 4);
}

/// A layer that is named again and again: its first place says the values, its last one the order. usd-core composes the same.
#[test]
fn a_layer_that_is_named_twice() {
    let layer = |name: &str, value: u32| {
        let schemas = format!("prepend apiSchemas = [\"{name}\"]");
        format!(
            "#usda 1.0\ndef \"p\" ({schemas}) {{\ndouble z = {value}\nadd rel r = </{name}>\ndef \"{name}\" {{}}\n}}"
        )
    };
    for (layers, order) in [("bc", ["c", "b"]), ("bcb", ["b", "c"]), ("bcbcb", ["b", "c"])] {
        let named: Vec<String> = layers.chars().map(|name| format!("@{name}.usda@")).collect();
        let root = format!("#usda 1.0\n(subLayers = [{}])", named.join(", "));
        let files =
            [("root.usda", root.as_str()), ("b.usda", &layer("b", 1)), ("c.usda", &layer("c", 2))];
        let stage = stage(&files).unwrap();
        assert_eq!(number(&stage, "/p.z"), 1.0, "{layers}");
        let children: Vec<&str> = stage.prims[1..].iter().map(|prim| &*prim.name).collect();
        assert_eq!(children, order, "{layers}");
        assert_eq!(targets(&stage, "/p.r"), order.map(|name| format!("/{name}")), "{layers}");
        let schemas: Vec<&str> = stage.prims[0].schemas.iter().map(|name| &**name).collect();
        assert_eq!(schemas, ["b", "c"], "{layers}");
    }
}
