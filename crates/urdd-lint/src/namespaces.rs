//! The fix of a prefix that is not declared.

use urdd_directory::position::LineIndex;
use urdd_findings::check::Check;
use urdd_findings::code::Code;
use urdd_format::index::Count;
use urdd_format::report::{Fix, TextEdit};
use urdd_source::undeclared_prefix;
use urdd_xml::Xml;

/// Prefixes, and the addresses that their authors give them.
const KNOWN: [(&str, &str); 5] = [
    ("xacro", "http://www.ros.org/wiki/xacro"),
    ("drake", "http://drake.mit.edu"),
    ("sensor", "http://playerstage.sourceforge.net/gazebo/xmlschema/#sensor"),
    ("controller", "http://playerstage.sourceforge.net/gazebo/xmlschema/#controller"),
    ("interface", "http://playerstage.sourceforge.net/gazebo/xmlschema/#interface"),
];

/// Adds the fix of a text that is not well-formed for want of the declaration of a known prefix.
pub fn declare(xml: &Xml<'_>, name: &str, checks: &mut [Check]) {
    let Some(prefix) = undeclared_prefix(xml) else { return };
    let text = xml.text();
    let known = KNOWN.iter().find(|(known, _)| *known == prefix);
    let robot = "<robot";
    let (Some((_, address)), Some(start)) = (known, text.find(robot)) else { return };
    let at = start + robot.len();
    let declaration = format!(" xmlns:{prefix}=\"{address}\"");
    let mended = [&text[..at], &declaration, &text[at..]].concat();
    // `<robot` may be in a comment.
    if undeclared_prefix(&Xml::new(&mended)).as_ref() == Some(&prefix) {
        return;
    }
    let position = LineIndex::new(text).position(at);
    let (line, column) = (Count(position.line), Count(position.column));
    let fix = Fix {
        message: format!("declare `{prefix}`"),
        is_safe: true,
        edits: vec![TextEdit {
            file: name.to_owned(),
            line,
            column,
            end_line: line,
            end_column: column,
            text: declaration,
        }],
    };
    let mut unreadable = checks.iter_mut().filter(|check| check.rule.code == Code::URD011);
    let finding = unreadable.find_map(|check| check.findings.first_mut());
    if let Some(finding) = finding {
        finding.place.fixes.push(fix);
    }
}
