//! What TinyXML 2.6.2, in urdfdom 3, refuses of a file that tinyxml2 has read and written again.

use crate::effect::{At, Effects, Reading};
use crate::fault::Fault;
use crate::tree::{Attribute, Tree};

const NOT_UTF8: Fault = Fault::Xml("the file is not UTF-8, which it says or has by default");

pub(super) fn check(bytes: &[u8], tree: &Tree<'_>, effects: &mut Effects) -> Reading<()> {
    let robot = tree.tops().find(|top| top.name() == "robot").map_or(0, At::at);
    if let Some(text) = tree.stray.filter(|text| *text < robot) {
        return effects.refuse(text, Fault::Xml("text stands before the root"));
    }
    let is_checked = is_utf8(bytes) && std::str::from_utf8(bytes).is_err();
    for element in &tree.elements {
        let begins_well = |name: &str| !name.starts_with(':');
        if !begins_well(&element.name) {
            let fault = Fault::Xml("the name of an element begins with `:`");
            return effects.refuse(element.tag.start, fault);
        }
        for attribute in &element.attributes {
            if !begins_well(&attribute.name) {
                let fault = Fault::Xml("the name of an attribute begins with `:`");
                return effects.refuse(attribute, fault);
            }
            if is_checked && swallows(value(bytes, attribute)) {
                return effects.refuse(attribute, NOT_UTF8);
            }
        }
        let behind = bytes.get(element.tag.end..).filter(|_| is_checked).unwrap_or_default();
        let text = behind.split(|&byte| byte == b'<').next().unwrap_or_default();
        if swallows(text) {
            return effects.refuse(element.tag.end, NOT_UTF8);
        }
    }
    Ok(())
}

/// Whether characters are of more than one byte, as they are if there is a declaration that names no other encoding.
fn is_utf8(bytes: &[u8]) -> bool {
    let (has_mark, rest) = match bytes.strip_prefix(b"\xef\xbb\xbf") {
        Some(rest) => (true, rest),
        None => (false, bytes),
    };
    let text = String::from_utf8_lossy(rest.trim_ascii_start().get(..200).unwrap_or(rest));
    let declaration = text.strip_prefix("<?xml").and_then(|text| text.split("?>").next());
    let Some(declaration) = declaration else { return has_mark };
    let encoding = declaration.split_once("encoding").map_or("", |(_, rest)| rest);
    let encoding = encoding.split(['"', '\'']).nth(1).unwrap_or_default().to_ascii_lowercase();
    has_mark || encoding.is_empty() || encoding.starts_with("utf-8") || encoding.starts_with("utf8")
}

/// The bytes of a value as they are written.
fn value<'a>(bytes: &'a [u8], attribute: &Attribute<'_>) -> &'a [u8] {
    let written = bytes.get(attribute.range.clone()).unwrap_or_default();
    let start = written.iter().position(|byte| matches!(byte, b'"' | b'\''));
    let inside = start.and_then(|start| written.get(start + 1..written.len() - 1));
    inside.unwrap_or_default()
}

/// Whether the last character takes what follows with it.
fn swallows(text: &[u8]) -> bool {
    let mut at = 0;
    while let Some(byte) = text.get(at) {
        at += match byte {
            0xc2..=0xdf => 2,
            0xe0..=0xef => 3,
            0xf0..=0xf4 => 4,
            _ => 1,
        };
    }
    at > text.len()
}
