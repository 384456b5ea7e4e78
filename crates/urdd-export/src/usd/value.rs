//! Values as the text of USD has them: shortest numbers, escaped strings.

use std::fmt::Write;

use nalgebra::UnitQuaternion;
use urdd_kinematics::rotation::canonical;
use urdd_xml::number::number;

/// A binary32: the shortest text that denotes it.
pub(super) fn float(value: f64) -> String {
    let value = value as f32 + 0.0;
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// A tuple of binary32.
pub(super) fn floats(values: &[f64]) -> String {
    tuple(values.iter().map(|value| float(*value)))
}

/// A tuple of binary64.
pub(super) fn doubles(values: &[f64]) -> String {
    tuple(values.iter().map(|value| number(*value)))
}

fn tuple(values: impl Iterator<Item = String>) -> String {
    format!("({})", values.collect::<Vec<_>>().join(", "))
}

/// The components of a rotation's canonical quaternion: w, x, y, z.
pub(super) fn wxyz(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = canonical(rotation).into_inner();
    [q.w, q.i, q.j, q.k]
}

/// An array.
pub(super) fn array(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(", "))
}

/// A string in quotes, on one line. Control characters are escaped.
pub(super) fn string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                quoted.push('\\');
                quoted.push(c);
            }
            '\n' => quoted += "\\n",
            '\t' => quoted += "\\t",
            _ if c.is_ascii_control() => {
                let _ = write!(quoted, "\\x{:02x}", u32::from(c));
            }
            _ => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A file, relative to the file that names it unless the path says otherwise.
pub(super) fn asset(path: &str) -> String {
    let here = if path.starts_with(['/', '.']) || path.contains(':') { "" } else { "./" };
    // Three delimiters where the path has one.
    let at = if path.contains('@') { "@@@" } else { "@" };
    format!("{at}{here}{path}{at}")
}
