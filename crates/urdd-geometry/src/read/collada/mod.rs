//! COLLADA 1.4 and 1.5 (.dae).

mod document;
mod geometry;
mod scene;

use super::assembly::Assembly;
use super::bytes::{is_utf16, skip_byte_order_mark};
use super::error::{Failure, Fault, NoteCode, Place};
pub(super) use document::path_of_url;
use document::{Document, child};

/// Reads a document: adds every geometry of its visual scene where the nodes place it.
pub(super) fn read(bytes: &[u8], assembly: &mut Assembly) -> Result<(), Failure> {
    let text = decode(bytes, assembly)?;
    let (above, text) = begun(&text, assembly);
    let xml = urdd_xml::parse(text, urdd_xml::Kind::Other).map_err(|error| {
        let line = above + error.pos().row as usize;
        let words = error.words(text);
        Fault::malformed(format!("not well-formed XML: {words}")).at(|| Place::Line(line))
    })?;
    let root = xml.root_element();
    let tag = root.tag_name().name();
    if tag != "COLLADA" {
        return Err(Fault::malformed(format!("the outermost element is `{tag}`, not `COLLADA`")));
    }
    let document = Document::new(root);
    for image in document.images() {
        assembly.add_side_file(&image);
    }
    let unit = unit(root, assembly);
    note_up_axis(root, assembly);
    scene::walk(&document, unit, assembly)
}

/// Decodes UTF-8 with or without a byte order mark, or UTF-16 with one. Invalid UTF-8, such as an author's name in
/// Latin-1, becomes replacement characters.
fn decode<'a>(
    bytes: &'a [u8],
    assembly: &mut Assembly,
) -> Result<std::borrow::Cow<'a, str>, Failure> {
    if is_utf16(bytes) {
        let decode = if bytes[0] == 0xff { u16::from_le_bytes } else { u16::from_be_bytes };
        let units: Vec<u16> = bytes[2..].as_chunks().0.iter().map(|pair| decode(*pair)).collect();
        return String::from_utf16(&units)
            .map(Into::into)
            .map_err(|_| Fault::malformed("the text is not UTF-16"));
    }
    let bytes = skip_byte_order_mark(bytes);
    let text = String::from_utf8_lossy(bytes);
    if matches!(text, std::borrow::Cow::Owned(_)) {
        assembly.notes.add(NoteCode::Assumed, "the text is not UTF-8; invalid bytes were replaced");
    }
    Ok(text)
}

/// The number of lines above the text, and the text. Assimp and PyBullet skip white space before `<?xml`, which XML does not
/// allow there.
fn begun<'t>(text: &'t str, assembly: &mut Assembly) -> (usize, &'t str) {
    let inside = text.trim_start();
    if inside.len() == text.len() || !inside.starts_with("<?xml ") {
        return (0, text);
    }
    let note = "there is white space before the declaration `<?xml …?>`; it was skipped";
    assembly.notes.add(NoteCode::Assumed, note);
    let above = &text[..text.len() - inside.len()];
    (above.matches('\n').count(), inside)
}

/// Length of one unit of the document, metres.
fn unit(root: urdd_xml::Node<'_, '_>, assembly: &mut Assembly) -> f64 {
    let meter = child(root, "asset")
        .and_then(|asset| child(asset, "unit"))
        .and_then(|unit| unit.attribute("meter"));
    let Some(meter) = meter else { return 1.0 };
    match meter.trim().parse::<f64>() {
        Ok(unit) if unit.is_finite() && unit > 0.0 => {
            if unit != 1.0 {
                let text = format!("lengths were multiplied by the file's unit, {unit} m");
                assembly.notes.add(NoteCode::UnitApplied, text);
            }
            unit
        }
        _ => {
            let text = format!("the unit '{meter}' is not a positive number; metres were assumed");
            assembly.notes.add(NoteCode::Assumed, text);
            1.0
        }
    }
}

fn note_up_axis(root: urdd_xml::Node<'_, '_>, assembly: &mut Assembly) {
    let up =
        child(root, "asset").and_then(|asset| child(asset, "up_axis")).and_then(|up| up.text());
    if let Some(up) = up.map(str::trim).filter(|up| *up != "Z_UP") {
        let text = format!("`up_axis` {up} was not applied, as in RViz and Pinocchio");
        assembly.notes.add(NoteCode::UpAxisIgnored, text);
    }
}
