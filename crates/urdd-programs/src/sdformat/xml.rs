//! What TinyXML 2.6.2, in urdfdom 3, refuses of a file that tinyxml2 has read and written again.

use crate::prelude::*;
use crate::tree::Tree;

const NOT_UTF8: Fault = Fault::Xml("the file is not UTF-8, which it says or has by default");

pub(super) fn check(bytes: &[u8], tree: &Tree<'_>, effects: &mut Effects) -> Reading<()> {
    let robot = tree.tops().find(|top| top.name() == "robot").map_or(0, At::at);
    if let Some(text) = tree.stray.filter(|text| *text < robot) {
        return effects.refuse(text, Fault::Xml("text stands before the root"));
    }
    let mut outside_quotes = declaration(bytes)
        .into_iter()
        .flat_map(|inside| inside.split(|&byte| byte == b'"').step_by(2));
    if outside_quotes.any(|piece| piece.contains(&b'>')) {
        return effects.refuse(0, Fault::Xml("the declaration has `>` inside"));
    }
    let is_checked = is_utf8(bytes) && std::str::from_utf8(bytes).is_err();
    for element in &tree.elements {
        let begins_well = |name: &str| !name.starts_with(':');
        // One that is empty is passed over.
        let is_filled = !element.children.is_empty() || element.text.is_some();
        if is_filled && !begins_well(&element.name) {
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

/// What is in the declaration at the beginning of a file.
fn declaration(bytes: &[u8]) -> Option<&[u8]> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let inside = text.strip_prefix(b"<?xml")?;
    inside.get(..inside.windows(2).position(|two| two == b"?>")?)
}

/// Whether characters are of more than one byte, as they are if there is a declaration that names no other encoding.
fn is_utf8(bytes: &[u8]) -> bool {
    let has_mark = bytes.starts_with(b"\xef\xbb\xbf");
    let Some(declaration) = declaration(bytes) else { return has_mark };
    let declaration = String::from_utf8_lossy(declaration).to_ascii_lowercase();
    let encoding = declaration.split_once("encoding").map_or("", |(_, rest)| rest);
    let name = encoding.split(['"', '\'']).nth(1).unwrap_or_default();
    has_mark || name.is_empty() || name.starts_with("utf-8") || name.starts_with("utf8")
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
