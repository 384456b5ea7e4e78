//! What programs do with a file in another encoding than UTF-8.

use std::fs;

use super::linted;
use urdd_format::report::Deed;
use urdd_lint::LintSettings;

/// A robot whose axis has tabs between its numbers, which urdfdom does not read.
const ROBOT: &str = "<robot name=\"r\"><!-- \u{e4} -->\n<link name=\"a\"/>\n<link name=\"b\"/>\n\
    <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/><origin xyz=\"0\t0\t1\"/></joint>\n</robot>\n";

/// Where a file has a fault that ROS refuses, and where the effect is; none where nothing is found.
fn refused(bytes: &[u8]) -> Vec<[Option<usize>; 4]> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("r.urdf");
    fs::write(&file, bytes).expect("written");
    let urdf = linted(&file, &LintSettings::default()).report.urdds.remove(0);
    let ros = urdf.programs.iter().find(|one| one.program == "urdfdom6").expect("ROS");
    let refused = ros.effects.iter().find(|effect| effect.does == Deed::Refuses);
    let at = refused.map(|effect| [effect.line, effect.column]).unwrap_or_default();
    let found = urdf.findings.iter().filter(|finding| {
        finding.programs.iter().any(|one| (&*one.program, one.does) == ("urdfdom6", Deed::Refuses))
    });
    let places = found.map(|one| [one.line, one.column, at[0], at[1]]);
    places.map(|place| place.map(|number| number.map(|count| count.get()))).collect()
}

fn utf16(text: &str) -> Vec<u8> {
    "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}

#[test]
fn a_fault_is_found_at_its_place_whatever_encoding_a_file_declares() {
    let declared = |name: &str| format!("<?xml version=\"1.0\" encoding=\"{name}\"?>{ROBOT}");
    let column = ROBOT.lines().nth(3).and_then(|line| line.find("xyz")).expect("a place") + 1;
    let place = [Some(4), Some(column), Some(4), Some(column)];
    for name in ["us-ascii", "US-ASCII", "ISO-8859-1", "windows-1252", "utf8", "UTF-8", "Shift_JIS"]
    {
        let text = declared(name).replace('\u{e4}', "a");
        assert_eq!(refused(text.as_bytes()), [place], "{name}");
    }
    for name in ["ISO-8859-1", "windows-1252"] {
        let text = declared(name);
        let bytes: Vec<u8> = text.chars().map(|c| u8::try_from(c).expect("a byte")).collect();
        assert_eq!(refused(&bytes), [place], "{name}");
    }
    // Two bytes are a character.
    let text = declared("Shift_JIS");
    let (before, after) = text.split_once('\u{e4}').expect("a character");
    let bytes = [before.as_bytes(), &[0x83, 0x41], after.as_bytes()].concat();
    assert_eq!(refused(&bytes), [place]);
}

#[test]
fn what_programs_make_of_utf_16_is_told_at_the_beginning() {
    let declared = format!("<?xml version=\"1.0\" encoding=\"UTF-16\"?>{ROBOT}");
    // URD011 has another fault.
    let unreadable = ROBOT.replace("0\t0\t1", "0 0 x");
    for text in [ROBOT.to_owned(), declared, unreadable] {
        let found = refused(&utf16(&text));
        assert_eq!(found, [[Some(1), Some(1), Some(1), Some(1)]], "{text}");
    }
}

#[test]
fn a_byte_order_mark_moves_nothing() {
    let place = refused(ROBOT.as_bytes());
    assert_eq!(place.len(), 1);
    assert_eq!(refused(format!("\u{feff}{ROBOT}").as_bytes()), place);
}
