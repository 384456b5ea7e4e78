//! EXT001: each row of the table of comparisons (SPEC 11.1), with a schema just within what is allowed and one just beyond.
//! EXT003 and EXT004 of parts, which only a robot has that is put together.

use serde_json::{Map, Value, json};
use urdd_validate::code::Code::*;

use crate::bases::{composed, extended};
use crate::{Case, changed};
use testkit::fixture::{Fixture, toy_robot};

const EXTENSION: &str = "x_acme_gripper_module";
const ALLOWED: usize = 1_000_000;

/// A row: a schema on a value, and the comparisons that the table counts for it.
struct Row {
    name: &'static str,
    schema: Value,
    /// Definitions that the schema refers to.
    others: Value,
    value: Value,
    comparisons: usize,
}

fn row(name: &'static str, schema: Value, value: Value, comparisons: usize) -> Row {
    Row { name, schema, others: json!({}), value, comparisons }
}

/// A schema of `count` schemas that are `true`: `count + 1` comparisons.
fn all_of(count: usize) -> Value {
    json!({ "allOf": vec![true; count] })
}

/// The whole schema, in which a row's is met as often as is allowed, or once more than that in the last step.
fn whole(row: &Row, beyond: bool) -> Value {
    let mut definitions: Map<String, Value> = row.others.as_object().expect("an object").clone();
    definitions.insert("s0".to_owned(), row.schema.clone());
    let (mut level, mut comparisons) = (0, row.comparisons);
    let mut refer = |count: usize, level: usize| {
        let one = json!({ "$ref": format!("#/$defs/s{level}") });
        definitions.insert(format!("s{}", level + 1), json!({ "allOf": vec![one; count] }));
    };
    // Ten times as many with each step, and then as many as fit. Outside of the last are five: `$defs`, `properties`, the
    // reference in it, and `allOf`.
    while comparisons < 8_000 {
        refer(10, level);
        (level, comparisons) = (level + 1, 1 + 10 * (1 + comparisons));
    }
    let outside = 2 + 1 + 1;
    let count = (ALLOWED - outside) / (1 + comparisons);
    refer(count + usize::from(beyond), level);
    let grip = json!({ "$ref": format!("#/$defs/s{}", level + 1) });
    json!({ "$defs": definitions, "properties": { "grip": grip } })
}

fn rows() -> Vec<Row> {
    let twenty = all_of(20);
    let ten = vec![1; 10];
    let lists = [vec![vec![1; 20]; 29], vec![vec![1; 5]]].concat();
    let keys = |count: usize| -> Map<String, Value> {
        let key = |n: usize| (format!("k{n:029}"), json!(1));
        (0..count).map(key).collect()
    };
    let nested = json!([[1, 2, 3], [4, 5, 6], {"a": [7, 8]}, "nine"]);
    let long = json!({"a": 1, "b": 1, "c": 1, "d": 1, "k".repeat(100): 1});
    let loop_of = |count: usize| json!({ "allOf": vec![json!({ "$ref": "#/$defs/loop" }); count] });
    vec![
        row("true", all_of(40), json!(1), 1 + 40),
        // 200 bytes in 100 characters, and a pattern of two bytes.
        row("pattern", json!({"pattern": "ä"}), json!("ä".repeat(100)), 1 + 5 + 200),
        // A pattern of 65 bytes with a brace.
        row(
            "pattern-with-braces",
            json!({"pattern": format!("a{{1,9}}(?:{})?", "b".repeat(54))}),
            json!("a".repeat(100)),
            1 + 5 + 100 * (16 + 2),
        ),
        row(
            "pattern-properties",
            json!({"patternProperties": {"^k": true, "^z": true}}),
            json!(keys(20)),
            1 + 2 * 20 * (2 * (5 + 30)) + 2 * 20,
        ),
        // Of 29 lists of 21 values the value has six.
        row("enum", json!({ "enum": lists }), json!(vec![1; 5]), 1 + 29 * 6 + 6),
        row(
            "const-and-unique-items",
            json!({"const": nested, "uniqueItems": true}),
            nested.clone(),
            2 + 14,
        ),
        Row {
            name: "dynamic-reference",
            schema: json!({"$dynamicRef": "#t"}),
            others: json!({"t": {"$dynamicAnchor": "t", "allOf": vec![true; 40]}}),
            value: json!(1),
            comparisons: 1 + 2 + 40,
        },
        // Whether a branch is taken or not.
        row(
            "branches",
            json!({
                "not": {"allOf": [false, twenty]}, "if": twenty, "then": twenty, "else": twenty,
                "anyOf": [twenty], "oneOf": [twenty], "dependentSchemas": {"a": twenty},
            }),
            json!(1),
            7 + 7 * 21 + 2,
        ),
        // `b` is not there.
        row(
            "properties",
            json!({"properties": {"a": all_of(40), "b": all_of(40)}}),
            json!({"a": 1}),
            1 + 41,
        ),
        // On every element, not only on those that a keyword is about.
        row(
            "items",
            json!({
                "prefixItems": [twenty], "items": twenty, "contains": twenty, "unevaluatedItems": twenty,
            }),
            json!(ten),
            4 + 4 * 10 * 21,
        ),
        row(
            "members",
            json!({
                "patternProperties": {"^z": twenty}, "additionalProperties": twenty,
                "unevaluatedProperties": twenty,
            }),
            json!(keys(10)),
            3 + 10 * 2 * (5 + 30) + 3 * 10 * 21,
        ),
        // The longest key of the document for each.
        row(
            "property-names",
            json!({"propertyNames": {"pattern": "[a-z]"}}),
            long,
            1 + 5 * (1 + 5 + 100),
        ),
        Row {
            name: "schema-met-again",
            schema: json!({"$ref": "#/$defs/loop"}),
            others: json!({ "loop": loop_of(40) }),
            value: json!(1),
            comparisons: 1 + 1 + 40 * (1 + 1),
        },
    ]
}

fn toy() -> Fixture {
    extended(Fixture::core(&toy_robot()))
}

fn composition() -> Fixture {
    extended(composed())
}

fn put(f: &mut Fixture, schema: &Value, grip: &Value) {
    f.put_file(&format!("{EXTENSION}/schema.json"), schema.to_string());
    f.set(EXTENSION, "/grip", grip.clone());
}

/// Schemas inside one another: 57 definitions with 90 levels each.
fn deep() -> Value {
    let definition = |at: usize| {
        let last =
            if at == 0 { json!(true) } else { json!({ "$ref": format!("#/$defs/d{}", at - 1) }) };
        (0..90).fold(last, |inside, _| json!({ "if": inside }))
    };
    let definitions: Map<String, Value> =
        (0..57).map(|at| (format!("d{at}"), definition(at))).collect();
    json!({ "$defs": definitions, "properties": { "grip": { "$ref": "#/$defs/d56" } } })
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for beyond in [false, true] {
        for row in rows() {
            let side = if beyond { "beyond" } else { "within" };
            let name = format!("{side}-comparisons-of-{}", row.name).leak();
            let schema = whole(&row, beyond);
            cases.push(changed(EXT001, name, beyond, toy, move |f| put(f, &schema, &row.value)));
        }
    }
    cases.push(changed(EXT001, "beyond-schemas-in-one-another", true, toy, |f| {
        put(f, &deep(), &json!(1));
    }));
    // The robot has two parts.
    for (code, name, caught, keyword, word, value) in [
        (EXT003, "part", true, "x-index", "part", json!(2)),
        (EXT003, "last-part", false, "x-index", "part", json!(1)),
        (EXT004, "parts", true, "x-length", "parts", json!([1.0])),
        (EXT004, "a-part-each", false, "x-length", "parts", json!([1.0, 2.0])),
    ] {
        cases.push(changed(code, name, caught, composition, move |f| {
            put(f, &json!({ "properties": { "grip": { keyword: word } } }), &value);
        }));
    }
    cases
}
