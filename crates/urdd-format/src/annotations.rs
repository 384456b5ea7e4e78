//! Annotations of schemas (SPEC 11.3 to 11.6): the unit, the frame, what an index counts, how long a list is.

use std::collections::BTreeSet;
use std::fmt;

use schemars::Schema;
use schemars::transform::Transform;
use serde_json::{Map, Value};

use super::escape;
use super::nearest::nearest;

/// The unit of every number in the value.
pub const UNIT: &str = "x-unit";
/// The frame of every position, direction and rotation in the value.
pub const FRAME: &str = "x-frame";
/// What an integer is an index of.
pub const INDEX: &str = "x-index";
/// How many elements a list has.
pub const LENGTH: &str = "x-length";
/// The keywords, in the order of the specification.
pub const KEYWORDS: [&str; 4] = [UNIT, FRAME, INDEX, LENGTH];

/// Symbols of units: SI base units, SI units with names of their own, and two of data.
pub const UNITS: &[&str] = &[
    "m", "kg", "s", "A", "K", "mol", "cd", "rad", "sr", "Hz", "N", "Pa", "J", "W", "C", "V", "F",
    "ohm", "S", "Wb", "T", "H", "lm", "lx", "bit", "byte",
];

/// Frames, as the specification's table has them.
pub const FRAMES: &[&str] = &["world", "root", "link", "parent_link", "joint", "inertial", "shape"];

/// Between the words of a choice.
const OR: &str = " or ";

/// What indices and lengths count, each with its word in `x-index`, and that in `x-length`.
macro_rules! things {
    ($($(#[$doc:meta])* $thing:ident $index:literal $length:expr;)*) => {
        /// What indices and lengths count.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Thing { $($(#[$doc])* $thing,)* }

        /// Everything that is counted, in the order of [`Thing`]: its word in `x-index`, and that in `x-length` if lists
        /// have one element for each.
        pub const THINGS: [(Thing, &str, Option<&str>); 12] =
            [$((Thing::$thing, $index, $length)),*];
    };
}

things! {
    /// A link of the robot.
    Link "link" Some("links");
    /// A joint of the robot.
    Joint "joint" Some("joints");
    /// A degree of freedom.
    Dof "dof" Some("dofs");
    /// A `visual` element of a link.
    Visual "visual" None;
    /// A `collision` element of a link.
    Collision "collision" None;
    /// A convex piece of a link.
    Piece "piece" Some("pieces");
    /// A link that has a shape.
    FullShape "full_shape" Some("full_shapes");
    /// A convex piece of any link.
    DecompositionShape "decomposition_shape" Some("decomposition_shapes");
    /// A part of a composed robot.
    Part "part" Some("parts");
    /// A pair of links with an output of the self-collision model.
    Pair "pair" Some("pairs");
    /// A sampled configuration.
    Sample "sample" None;
    /// Something else, which the description names.
    Other "other" None;
}

impl Thing {
    /// The word of `x-index`.
    pub fn index(self) -> &'static str {
        THINGS[self as usize].1
    }

    /// The word of `x-length`; `None` for what no list has one element for each.
    pub fn length(self) -> Option<&'static str> {
        THINGS[self as usize].2
    }
}

/// What the text of an `x-index` names: one thing, or a choice. `None` where a word is unknown.
pub fn of_index(text: &str) -> Option<Vec<Thing>> {
    named(text, |(_, index, _), word| *index == word)
}

/// What the text of an `x-length` names: one thing, or a choice. `None` where a word is unknown.
pub fn of_length(text: &str) -> Option<Vec<Thing>> {
    named(text, |(_, _, length), word| *length == Some(word))
}

fn named(text: &str, is: fn(&(Thing, &str, Option<&str>), &str) -> bool) -> Option<Vec<Thing>> {
    let of_word = |word| Some(THINGS.iter().find(|thing| is(thing, word))?.0);
    // A text may name a thing a thousand times.
    let things: BTreeSet<Thing> = text.split(OR).map(of_word).collect::<Option<_>>()?;
    Some(things.into_iter().collect())
}

/// Whether a text is a unit, or a choice of units: `m`, `kg*m^2`, `N*m*s/rad`, `1/s`, `rad or m`.
pub fn is_unit(text: &str) -> bool {
    text.split(OR).all(|unit| {
        let (above, below) = match unit.split_once('/') {
            None => (unit, None),
            Some((above, below)) => (above, Some(below)),
        };
        (above == "1" || is_product(above)) && below.is_none_or(is_product)
    })
}

fn is_product(text: &str) -> bool {
    text.split('*').all(|factor| {
        let (symbol, power) = factor.split_once('^').unwrap_or((factor, "2"));
        UNITS.contains(&symbol) && matches!(power.as_bytes(), [b'2'..=b'9'])
    })
}

/// Whether a text is a frame, or a choice of frames.
pub fn is_frame(text: &str) -> bool {
    text.split(OR).all(|word| FRAMES.contains(&word))
}

/// A fault of one annotation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AnnotationFault {
    /// The keyword.
    pub keyword: &'static str,
    /// The fault, with what to write instead.
    pub message: String,
}

impl fmt::Display for AnnotationFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` {}", self.keyword, self.message)
    }
}

/// The faults of a schema's own annotations, without those of the schemas in it.
pub fn faults(schema: &Map<String, Value>) -> Vec<AnnotationFault> {
    let found = KEYWORDS.iter().filter_map(|keyword| {
        let message = fault(keyword, schema.get(*keyword)?, schema.get("type"))?;
        Some(AnnotationFault { keyword, message })
    });
    found.collect()
}

fn fault(keyword: &str, value: &Value, kind: Option<&Value>) -> Option<String> {
    let Some(text) = value.as_str() else {
        return Some(format!(
            "is {}, and must be a string: {}",
            shown(&value.to_string()),
            known(keyword)
        ));
    };
    let is_known = match keyword {
        UNIT => is_unit(text),
        FRAME => is_frame(text),
        INDEX => of_index(text).is_some(),
        _ => of_length(text).is_some(),
    };
    if !is_known {
        let near = text.split(OR).find_map(|word| near(keyword, word));
        let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
        return Some(format!(
            "is `{}`, which is not defined: {near}{}",
            shown(text),
            known(keyword)
        ));
    }
    let fits = |words: &[&str]| match kind {
        Some(Value::String(kind)) => words.contains(&kind.as_str()),
        Some(Value::Array(kinds)) => {
            (kinds.iter()).filter_map(Value::as_str).any(|kind| words.contains(&kind))
        }
        _ => true,
    };
    match keyword {
        INDEX if !fits(&["integer", "number"]) => Some(
            "says nothing here: it is about an integer; in a list, put it into `items`".to_owned(),
        ),
        LENGTH if !fits(&["array"]) => {
            Some("says nothing here: it is about a list, `\"type\": \"array\"`".to_owned())
        }
        _ => None,
    }
}

/// A value in a message: escaped and short.
fn shown(text: &str) -> String {
    escape::line(&text.chars().take(80).collect::<String>()).to_string()
}

fn words(keyword: &str) -> Vec<&'static str> {
    match keyword {
        UNIT => UNITS.to_vec(),
        FRAME => FRAMES.to_vec(),
        INDEX => THINGS.iter().map(|thing| thing.1).collect(),
        _ => THINGS.iter().filter_map(|thing| thing.2).collect(),
    }
}

fn near(keyword: &str, word: &str) -> Option<String> {
    match keyword {
        // Symbols are so short that every word is near one.
        UNIT => None,
        _ => nearest(words(keyword).into_iter(), word),
    }
}

fn known(keyword: &str) -> String {
    match keyword {
        UNIT => {
            "write SI units such as m, rad, kg*m^2, N*m, m/s, 1/s, 1 for a number without one, or \"rad or m\"".to_owned()
        }
        _ => format!(
            "write {}, or a choice of them joined by \"{OR}\"",
            words(keyword).join(", ")
        ),
    }
}

/// The annotations of a field, as a transform of its schema. An empty text says nothing.
#[derive(Clone)]
pub(crate) struct Annotations {
    pub unit: &'static str,
    pub frame: &'static str,
    pub index: &'static str,
    /// Of a list, of the lists in it, and so on, with `, ` between.
    pub length: &'static str,
    /// The length of a list, and of each list in it.
    pub square: &'static str,
}

impl Annotations {
    pub const NONE: Self = Annotations { unit: "", frame: "", index: "", length: "", square: "" };
}

impl Transform for Annotations {
    fn transform(&mut self, schema: &mut Schema) {
        for (keyword, says) in [(UNIT, self.unit), (FRAME, self.frame), (INDEX, self.index)] {
            if !says.is_empty() {
                schema.insert(keyword.to_owned(), Value::from(says));
            }
        }
        let mut at = schema.as_object_mut();
        let lengths = self.length.split(", ").chain([self.square; 2]);
        for length in lengths.filter(|length| !length.is_empty()) {
            let Some(list) = at else { return };
            list.insert(LENGTH.to_owned(), Value::from(length));
            at = list.get_mut("items").and_then(Value::as_object_mut);
        }
    }
}

/// What a property's annotations say, in a line for people: "Unit: `m`. Frame: `link`. Length: `links`, each
/// `pieces`." Empty where they say nothing.
pub fn sentence(schema: &Value) -> String {
    let text = |schema: &Value, keyword: &str| {
        let word = schema.get(keyword).and_then(Value::as_str);
        word.map(str::to_owned)
    };
    let mut lengths = Vec::new();
    let mut innermost = schema;
    loop {
        lengths.extend(text(innermost, LENGTH));
        match innermost.get("items") {
            Some(items) => innermost = items,
            None => break,
        }
    }
    let either = |keyword| text(schema, keyword).or_else(|| text(innermost, keyword));
    let parts = [
        either(UNIT).map(|unit| format!("Unit: `{unit}`.")),
        either(FRAME).map(|frame| format!("Frame: `{frame}`.")),
        either(INDEX).map(|index| format!("Index of: `{index}`.")),
        (!lengths.is_empty()).then(|| format!("Length: `{}`.", lengths.join("`, each `"))),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
}
