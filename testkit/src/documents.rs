//! Generates documents for the subset of JSON Schema that this project uses.

use serde_json::{Map, Value, json};

/// A list of choices. After its end, every choice is the first alternative.
pub struct Choices<'a> {
    rest: std::slice::Iter<'a, u16>,
}

impl<'a> Choices<'a> {
    pub fn new(raw: &'a [u16]) -> Self {
        Choices { rest: raw.iter() }
    }

    /// A number below `count`.
    pub fn pick(&mut self, count: usize) -> usize {
        self.rest.next().map_or(0, |raw| usize::from(*raw) % count.max(1))
    }

    /// True once in `odds` times.
    fn rarely(&mut self, odds: usize) -> bool {
        self.pick(odds) == odds - 1
    }

    pub fn one<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.pick(of.len())].clone()
    }
}

/// An instance of `schema`, a whole schema with its definitions.
pub fn instance(schema: &Value, choices: &mut Choices) -> Value {
    part(schema, schema, choices)
}

fn part(root: &Value, schema: &Value, choices: &mut Choices) -> Value {
    if let Some(reference) = schema.get("$ref") {
        let pointer = reference.as_str().unwrap().strip_prefix('#').unwrap();
        return part(root, root.pointer(pointer).unwrap(), choices);
    }
    if let Some(value) = schema.get("const") {
        return value.clone();
    }
    for keyword in ["enum", "oneOf", "anyOf", "allOf"] {
        if let Some(Value::Array(alternatives)) = schema.get(keyword) {
            assert!(keyword != "allOf" || alternatives.len() == 1);
            let chosen = choices.one(alternatives);
            return match keyword {
                "enum" => chosen,
                _ => part(root, &chosen, choices),
            };
        }
    }
    let kind = match schema.get("type") {
        Some(Value::Array(kinds)) => choices.one(kinds),
        Some(kind) => kind.clone(),
        None => return arbitrary_json(choices, 1),
    };
    match kind.as_str().unwrap() {
        "object" => object(root, schema, choices),
        "array" => array(root, schema, choices),
        "string" => string(schema, choices),
        "integer" => integer(schema, choices),
        "number" => number(choices),
        "boolean" => json!(choices.pick(2) == 1),
        "null" => Value::Null,
        other => panic!("no instances of type {other}"),
    }
}

fn object(root: &Value, schema: &Value, choices: &mut Choices) -> Value {
    let mut object = Map::new();
    let required = schema["required"].as_array().unwrap();
    for (name, property) in schema["properties"].as_object().unwrap() {
        if required.contains(&json!(name)) || choices.rarely(4) {
            object.insert(name.clone(), part(root, property, choices));
        }
    }
    if choices.rarely(8) {
        object.insert("x_note".to_owned(), arbitrary_json(choices, 1));
    }
    Value::Object(object)
}

fn array(root: &Value, schema: &Value, choices: &mut Choices) -> Value {
    if let Some(Value::Array(items)) = schema.get("prefixItems") {
        return items.iter().map(|item| part(root, item, choices)).collect();
    }
    let bound = |keyword| schema.get(keyword).and_then(Value::as_u64);
    let least = bound("minItems").unwrap_or(0) as usize;
    let most = bound("maxItems").map_or(least + 3, |most| most as usize);
    let length = least + choices.pick(most - least + 1);
    (0..length).map(|_| part(root, &schema["items"], choices)).collect()
}

fn string(schema: &Value, choices: &mut Choices) -> Value {
    let Some(pattern) = schema.get("pattern") else {
        return json!(choices.one(&["", "base_link", "Fixed", "x_", "\u{1f916}/ ä\n", "1.0"]));
    };
    let hash = "0123456789abcdef".repeat(4);
    let candidates = ["home", "1.0.0", "0.12.999999999", &hash];
    let matching: Vec<&str> = candidates
        .into_iter()
        .filter(|text| jsonschema::is_valid(&json!({ "pattern": pattern }), &json!(text)))
        .collect();
    json!(choices.one(&matching))
}

fn integer(schema: &Value, choices: &mut Choices) -> Value {
    assert_eq!(schema["minimum"], 0);
    assert_eq!(schema["maximum"], u32::MAX);
    choices.one(&[json!(0), json!(1), json!(7), json!(u32::MAX), json!(2.0), json!(-0.0)])
}

fn number(choices: &mut Choices) -> Value {
    match choices.pick(6) {
        0 => json!(0),
        1 => json!(-1),
        2 => json!(0.1),
        3 => json!(u64::MAX),
        4 => json!(-1e300),
        _ => {
            let bits = (0..4).fold(0, |bits, _| (bits << 16) | choices.pick(1 << 16) as u64);
            let number = f64::from_bits(bits);
            // JSON cannot represent a number that is not finite.
            json!(if number.is_finite() { number } else { -0.0 })
        }
    }
}

/// An arbitrary JSON value.
pub fn arbitrary_json(choices: &mut Choices, depth: usize) -> Value {
    match choices.pick(if depth == 0 { 6 } else { 8 }) {
        0 => Value::Null,
        1 => json!(choices.pick(2) == 1),
        2 => json!(choices.pick(100)),
        3 => number(choices),
        4 => json!("text"),
        5 => json!([]),
        6 => (0..choices.pick(4)).map(|_| arbitrary_json(choices, depth - 1)).collect(),
        _ => (0..choices.pick(4))
            .map(|_| {
                let key = choices.one(&["name", "bounds", "$schema", "x_y", "Mesh", "done"]);
                (key.to_owned(), arbitrary_json(choices, depth - 1))
            })
            .collect::<Map<_, _>>()
            .into(),
    }
}
