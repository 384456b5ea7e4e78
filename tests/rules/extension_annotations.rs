//! Cases of extensions whose schemas have annotations (SPEC 11.3 to 11.5). How many links, pieces and so on the toy has
//! is counted here from its documents as JSON.

use serde_json::{Value, json};
use urdd_validate::code::Code::{self, *};

use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::Fixture;

const FOLDER: &str = "x_acme_gripper_module";

fn extend(f: &mut Fixture, schema: &Value, document: Value) {
    f.put_file(&format!("{FOLDER}/schema.json"), schema.to_string());
    f.add_module(FOLDER, document);
}

/// A case of a schema alone.
fn schema(code: Code, name: &'static str, caught: bool, schema: Value) -> Case {
    let change = move |f: &mut Fixture| extend(f, &schema, json!({"grip": 1}));
    changed(code, name, caught, Fixture::toy, change)
}

/// A case of a value under `/grip`, with this schema of it.
fn caught(
    code: Code,
    name: &'static str,
    schema: Value,
    value: impl Fn(&Fixture) -> Value + 'static,
) -> Case {
    invalid(code, name, move |f| put(f, &schema, value(f)))
}

fn passes(
    code: Code,
    name: &'static str,
    schema: Value,
    value: impl Fn(&Fixture) -> Value + 'static,
) -> Case {
    near_miss(code, name, move |f| put(f, &schema, value(f)))
}

fn put(f: &mut Fixture, schema: &Value, value: Value) {
    extend(f, &json!({"properties": {"grip": schema}}), json!({"grip": value}));
}

fn count(f: &Fixture, module: &str, pointer: &str) -> usize {
    f.get(module, pointer).as_array().expect("a list").len()
}

fn links(f: &Fixture) -> usize {
    count(f, "urdf_module", "/links")
}

fn joints(f: &Fixture) -> usize {
    count(f, "urdf_module", "/joints")
}

fn dofs(f: &Fixture) -> usize {
    count(f, "dof_module", "/dofs")
}

/// The pieces of each link.
fn pieces(f: &Fixture) -> Vec<usize> {
    let lists = f.get("convex_decomposition_meshes_module", "/link_pieces");
    let lists = lists.as_array().expect("a list").iter();
    lists.map(|list| list.as_array().expect("a list").len()).collect()
}

fn full_shapes(f: &Fixture) -> usize {
    let hulls = f.get("convex_hull_meshes_module", "/link_hulls");
    let hulls = hulls.as_array().expect("a list").iter();
    hulls.filter(|hull| !hull.is_null()).count()
}

fn visuals(f: &Fixture) -> usize {
    let links = f.get("urdf_module", "/links").as_array().expect("a list");
    let visuals = links.iter().map(|link| link["visual"].as_array().expect("a list").len());
    visuals.max().expect("links")
}

fn index(word: &str) -> Value {
    json!({"type": ["integer", "null"], "x-index": word})
}

fn length(word: &str) -> Value {
    json!({"type": "array", "x-length": word})
}

pub fn cases() -> Vec<Case> {
    [schemas(), indices(), lengths()].into_iter().flatten().collect()
}

fn schemas() -> Vec<Case> {
    let grip = |schema: Value| json!({"properties": {"grip": schema}});
    let wrong = |name, annotation| schema(EXT001, name, true, grip(annotation));
    vec![
        wrong("index-of-7", json!({"x-index": 7})),
        wrong("index-of-cheese", json!({"x-index": "cheese"})),
        wrong("index-of-links", json!({"x-index": "links"})),
        wrong("index-of-a-list", json!({"x-index": "link", "type": "array"})),
        wrong("length-of-a-link", json!({"x-length": "link"})),
        wrong("length-of-samples", json!({"x-length": "samples"})),
        wrong("length-of-an-object", json!({"x-length": "links", "type": "object"})),
        wrong("unit-of-degrees", json!({"x-unit": "deg"})),
        wrong("unit-of-millimetres-or-metres", json!({"x-unit": "m or mm"})),
        wrong("frame-of-a-camera", json!({"x-frame": "camera"})),
        schema(
            EXT001,
            "annotation-that-nothing-refers-to",
            true,
            json!({"$defs": {"unused": {"anyOf": [{"x-unit": null}]}}}),
        ),
        schema(
            EXT001,
            "annotations",
            false,
            json!({
                "x-mine": 7, "x-indices": "cheese",
                "properties": {
                    "x-index": {"type": "integer"},
                    "torque": {"x-unit": "kg*m^2/s^2", "x-frame": "link or parent_link"},
                    "rate": {"x-unit": "1/s or 1", "type": "number"},
                    "constant": {"const": {"x-index": 7}},
                    "grip": {"x-index": "visual or collision or sample or other", "type": ["number", "null"]},
                },
            }),
        ),
    ]
}

fn indices() -> Vec<Case> {
    let is_link = || json!({"type": "integer", "x-index": "link"});
    let tree = json!({
        "$ref": "#/$defs/node",
        "$defs": {"node": {
            "type": "object",
            "properties": {"link": is_link(), "below": {"items": {"$ref": "#/$defs/node"}}},
        }},
    });
    let wrong_tree = tree.clone();
    let branch = |word: &str| json!({"required": [word], "properties": {word: is_link()}});
    vec![
        caught(EXT003, "link", index("link"), |f| json!(links(f))),
        caught(EXT003, "joint", index("joint"), |f| json!(joints(f))),
        caught(EXT003, "dof", index("dof"), |f| json!(dofs(f))),
        caught(EXT003, "visual", index("visual"), |f| json!(visuals(f))),
        caught(EXT003, "piece", index("piece"), |f| json!(pieces(f).into_iter().max())),
        caught(EXT003, "full-shape", index("full_shape"), |f| json!(full_shapes(f))),
        caught(EXT003, "decomposition-shape", index("decomposition_shape"), |f| {
            json!(pieces(f).into_iter().sum::<usize>())
        }),
        caught(EXT003, "sample", index("sample"), |_| json!(1_u64 << 32)),
        caught(EXT003, "choice-in-none", index("dof or link"), |f| json!(dofs(f).max(links(f)))),
        caught(EXT003, "negative", index("link"), |_| json!(-1)),
        caught(EXT003, "fraction", json!({"x-index": "link"}), |_| json!(0.5)),
        caught(EXT003, "huge", json!({"x-index": "link"}), |_| json!(1e300)),
        caught(EXT003, "items-at-depth-two", json!({"items": {"items": is_link()}}), |f| {
            json!([[0], [0, links(f)]])
        }),
        caught(EXT003, "prefix-items", json!({"prefixItems": [is_link(), true]}), |f| {
            json!([links(f), 1000])
        }),
        caught(
            EXT003,
            "additional-properties",
            json!({"additionalProperties": is_link()}),
            |f| json!({"a": 0, "b": links(f)}),
        ),
        caught(
            EXT003,
            "pattern-properties",
            json!({"patternProperties": {"_idx$": is_link()}}),
            |f| json!({"a": 1000, "b_idx": links(f)}),
        ),
        caught(
            EXT003,
            "one-of-by-key",
            json!({"oneOf": [branch("a"), branch("b")]}),
            |f| json!({"b": links(f)}),
        ),
        caught(
            EXT003,
            "then",
            json!({
                "if": {"properties": {"of": {"const": "link"}}},
                "then": {"properties": {"idx": is_link()}},
            }),
            |f| json!({"of": "link", "idx": links(f)}),
        ),
        invalid(EXT003, "recursive-reference", move |f| {
            let document = json!({"link": 0, "below": [{"below": [{"link": links(f)}]}]});
            extend(f, &wrong_tree, document);
        }),
        near_miss(EXT003, "recursive-reference-to-links", move |f| {
            let document = json!({"link": 0, "below": [{"below": [{"link": links(f) - 1}]}]});
            extend(f, &tree, document);
        }),
        passes(EXT003, "last-link", index("link"), |f| json!(links(f) - 1)),
        passes(EXT003, "last-piece", index("piece"), |f| {
            json!(pieces(f).into_iter().max().expect("pieces") - 1)
        }),
        passes(EXT003, "last-sample", index("sample"), |_| json!(u32::MAX)),
        passes(EXT003, "fraction-of-zero", index("link"), |_| json!(1.0)),
        passes(EXT003, "null", index("link"), |_| json!(null)),
        passes(EXT003, "name-instead", json!({"x-index": "link"}), |_| json!("a")),
        passes(EXT003, "one-word-of-a-choice", index("link or dof"), |f| {
            json!(links(f).max(dofs(f)) - 1)
        }),
        passes(EXT003, "module-that-is-not-there", index("pair"), |_| json!(1000)),
        caught(EXT003, "negative-of-any-number", index("pair"), |_| json!(-1)),
        passes(EXT003, "other", index("other"), |_| json!(1000)),
        passes(EXT003, "other-beyond-integers-of-64-bits", json!({"x-index": "other"}), |_| {
            json!(1e300)
        }),
        passes(
            EXT003,
            "another-alternative",
            json!({"anyOf": [{"x-index": "link", "type": "integer"}, {"minimum": 1000}]}),
            |_| json!(1000),
        ),
        passes(
            EXT003,
            "other-branch-of-if",
            json!({
                "if": {"properties": {"of": {"const": "link"}}},
                "then": {"properties": {"idx": is_link()}},
            }),
            |f| json!({"of": "mars", "idx": links(f)}),
        ),
    ]
}

fn lengths() -> Vec<Case> {
    let of = |count: usize| json!(vec![0.5; count]);
    let by_piece = || json!({"type": "array", "x-length": "links", "items": length("pieces")});
    vec![
        caught(EXT004, "links", length("links"), move |f| of(links(f) - 1)),
        caught(EXT004, "joints", length("joints"), move |f| of(joints(f) + 1)),
        caught(EXT004, "dofs", length("dofs"), move |f| of(dofs(f) - 1)),
        caught(EXT004, "empty", length("links"), move |_| of(0)),
        caught(EXT004, "full-shapes", length("full_shapes"), move |f| of(full_shapes(f) + 1)),
        caught(EXT004, "pieces-of-no-link", length("pieces"), move |f| {
            of(pieces(f).into_iter().max().expect("pieces") + 1)
        }),
        caught(EXT004, "pieces-of-another-link", by_piece(), move |f| {
            let mut lists: Vec<Value> = pieces(f).into_iter().map(of).collect();
            let other = (0..lists.len()).find(|i| lists[*i] != lists[0]);
            lists.swap(0, other.expect("a link with another number of pieces"));
            json!(lists)
        }),
        caught(
            EXT004,
            "row-of-a-matrix",
            json!({"x-length": "full_shapes", "items": length("full_shapes")}),
            move |f| {
                let mut rows = vec![of(full_shapes(f)); full_shapes(f)];
                rows[1] = of(full_shapes(f) - 1);
                json!(rows)
            },
        ),
        caught(
            EXT004,
            "list-or-null",
            json!({"anyOf": [length("dofs"), {"type": "null"}]}),
            move |f| of(dofs(f) + 1),
        ),
        passes(EXT004, "a-link-each", length("links"), move |f| of(links(f))),
        passes(EXT004, "pieces-of-each-link", by_piece(), move |f| {
            json!(pieces(f).into_iter().map(of).collect::<Vec<Value>>())
        }),
        passes(EXT004, "decomposition-shapes", length("decomposition_shapes"), move |f| {
            of(pieces(f).into_iter().sum())
        }),
        passes(EXT004, "either", length("joints or dofs"), move |f| of(dofs(f))),
        passes(EXT004, "no-list", json!({"x-length": "links"}), |_| json!("a")),
        passes(EXT004, "pairs-without-a-model", length("pairs"), move |_| of(1000)),
        passes(
            EXT004,
            "null-instead",
            json!({"anyOf": [length("dofs"), {"type": "null"}]}),
            |_| json!(null),
        ),
    ]
}
