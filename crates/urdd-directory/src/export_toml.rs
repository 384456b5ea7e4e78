//! The tables of `NAME.export.toml`, which imports write and exports read: what exports need and a URDD does not say.
#![expect(missing_docs, reason = "the file that `urdd export init` writes says what they mean")]

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::{Deserialize, Serialize};
use toml::{Spanned, Table};

use urdd_format::escape::is_hidden;

/// A name, and where it is in the file.
pub type Name = Spanned<String>;

/// A value that was not read from a file.
pub fn unplaced<T>(value: T) -> Spanned<T> {
    Spanned::new(0..0, value)
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    pub robot: Name,
    #[serde(default, skip_serializing_if = "is_default")]
    pub base: BaseTable,
    #[serde(default, skip_serializing_if = "is_default")]
    pub group: Vec<Spanned<GroupTable>>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub end_effector: Vec<EndEffectorTable>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub frames: FramesTable,
    #[serde(default, skip_serializing_if = "is_default")]
    pub actuators: ActuatorsTable,
    #[serde(default, skip_serializing_if = "is_default")]
    pub limits: LimitsTable,
    #[serde(default, skip_serializing_if = "is_default")]
    pub contact: ContactTable,
    #[serde(default, skip_serializing_if = "is_default")]
    pub curobo: CuroboTable,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl File {
    /// One that says nothing of a robot.
    pub fn of(robot: &str) -> File {
        File {
            robot: unplaced(robot.to_owned()),
            base: BaseTable::default(),
            group: Vec::new(),
            end_effector: Vec::new(),
            frames: FramesTable::default(),
            actuators: ActuatorsTable::default(),
            limits: LimitsTable::default(),
            contact: ContactTable::default(),
            curobo: CuroboTable::default(),
        }
    }

    /// The text of the file, with what is set, in the order of its words.
    ///
    /// # Errors
    /// None are known: each value has a form in TOML.
    pub fn to_text(&self) -> Result<String, toml::ser::Error> {
        text_of(self)
    }
}

#[derive(Serialize, Deserialize, Default, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct BaseTable {
    pub floating: bool,
    #[serde(skip_serializing_if = "is_default")]
    pub poses: BTreeMap<Name, Spanned<Vec<f64>>>,
}

#[derive(Serialize, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct GroupTable {
    pub name: Name,
    pub base: Option<Name>,
    pub tip: Option<Name>,
    pub joints: Option<Vec<Name>>,
    pub groups: Option<Vec<Name>>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub passive: bool,
}

#[derive(Serialize, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct EndEffectorTable {
    pub name: Name,
    pub group: Name,
    pub parent_group: Option<Name>,
    pub parent_link: Name,
}

#[derive(Serialize, Deserialize, Default, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct FramesTable {
    pub tools: Vec<Name>,
    pub imus: Vec<Name>,
}

#[derive(Serialize, Deserialize, Default, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct ActuatorsTable {
    pub bandwidth: Option<Spanned<f64>>,
    pub joint: BTreeMap<Name, Spanned<JointGains>>,
}

/// What a person, or the description that was imported, sets for the actuator of a joint.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointGains {
    /// N m/rad or N/m.
    pub kp: Option<f64>,
    /// N m s/rad or N s/m.
    pub kv: Option<f64>,
    /// The inertia of the motor, as the joint sees it, kg m² or kg.
    pub armature: Option<f64>,
    /// Its name, if it is not that of the joint.
    pub name: Option<String>,
    /// What it is told, where positions are asked for.
    pub kind: Option<ActuatorKind>,
    /// The least and greatest position or speed that it can be told, if these are not the limits of the joint.
    pub ctrlrange: Option<[f64; 2]>,
    /// The least and greatest force, if it is not the effort of the joint either way, N or N m.
    pub forcerange: Option<[f64; 2]>,
}

#[derive(Serialize, Deserialize, Default, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct LimitsTable {
    pub acceleration: Option<Spanned<f64>>,
    pub jerk: Option<Spanned<f64>>,
}

#[derive(Serialize, Deserialize, Default, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct ContactTable {
    pub friction: Option<Spanned<f64>>,
}

#[derive(Serialize, Deserialize, Default, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct CuroboTable {
    pub ee_link: Option<Name>,
    pub retract: Option<Name>,
    pub locked: BTreeMap<Name, Spanned<f64>>,
}

urdd_format::words! {
    /// What an actuator is told.
    #[derive(Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum ActuatorKind "are no actuators" {
        /// They are told positions, rad or m.
        Position "position",
        /// They are told velocities, rad/s or m/s.
        Velocity "velocity",
        /// They are told torques or forces, N m or N.
        Motor "motor",
    }
}

/// Tables as this program writes them.
pub(crate) fn text_of(file: &impl Serialize) -> Result<String, toml::ser::Error> {
    Ok(printable(&toml::to_string(&Table::try_from(file)?)?))
}

/// A TOML without comments, in which each hidden character of a string is an escape: those that turn text around, that are
/// not seen, and control characters.
fn printable(text: &str) -> String {
    let is_raw = |c| !matches!(c, '\n' | '\t') && is_hidden(c);
    if !text.contains(is_raw) {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(['"', '\'']) {
        let (before, from) = rest.split_at(start);
        out.push_str(before);
        let of = |quote: &'static str| from.starts_with(quote).then_some(quote);
        let quotes = of("\"\"\"").or(of("'''")).or(of("\"")).unwrap_or("'");
        let inside = &from[quotes.len()..];
        let (inside, after) = inside.split_at(length(inside, quotes));
        rest = after.get(quotes.len()..).unwrap_or_default();
        if !inside.contains(is_raw) {
            out.extend([quotes, inside, quotes]);
            continue;
        }
        // A literal string has no escapes, and the first line break of three quotes is none of the text.
        let is_literal = quotes.starts_with('\'');
        let (quotes, inside) = match is_literal {
            true => ("\"", inside.strip_prefix('\n').unwrap_or(inside)),
            false => (quotes, inside),
        };
        out.push_str(quotes);
        for c in inside.chars() {
            match c {
                '"' | '\\' if is_literal => out.extend(['\\', c]),
                '\n' if is_literal => out.push_str("\\n"),
                c if is_raw(c) => _ = write!(out, "\\U{:08X}", u32::from(c)),
                c => out.push(c),
            }
        }
        out.push_str(quotes);
    }
    out + rest
}

/// The bytes of a string up to the quotes that end it.
fn length(inside: &str, quotes: &str) -> usize {
    let mut is_escaped = false;
    for (at, c) in inside.char_indices() {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = quotes.starts_with('"'),
            _ if inside[at..].starts_with(quotes) => {
                // Up to two quotes before three are of the text.
                let is_later = |more: &usize| {
                    quotes.len() > 1
                        && inside.get(at + more..).is_some_and(|it| it.starts_with(quotes))
                };
                return at + (1..=2).take_while(is_later).count();
            }
            _ => {}
        }
    }
    inside.len()
}
