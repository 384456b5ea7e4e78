//! Fixes with one right answer of what programs refuse or lose, and of a prefix that is not declared.

use std::ops::Range;

use urdd_directory::position::LineIndex;
use urdd_findings::check::Check;
use urdd_findings::code::Code;
use urdd_format::index::Count;
use urdd_format::report::{Fix, TextEdit};
use urdd_programs::Fault;
use urdd_source::undeclared_prefix;
use urdd_xml::element::{children, name};
use urdd_xml::{Node, Xml};

use crate::subject::Subject;

/// Attributes of several numbers, and how many.
const VECTORS: [(&str, usize); 6] =
    [("xyz", 3), ("rpy", 3), ("size", 3), ("scale", 3), ("rgba", 4), ("quat_xyzw", 4)];
/// What URDF has since version 1.1.
const SINCE_1_1: [&str; 5] = ["capsule", "quat_xyzw", "acceleration", "deceleration", "jerk"];

/// Maximum number of elements that one is compared with.
const MOST_BESIDE: usize = 1_000;

/// The fix of a fault, if it has one right answer.
pub fn fix(subject: &Subject, offset: usize, fault: &Fault) -> Option<Fix> {
    let node = subject.element(offset)?;
    match fault {
        _ if is_empty_dynamics(node) => {
            Some(subject.fix("remove the empty `<dynamics>`", whole(subject, node), String::new()))
        }
        Fault::NotANumber { attribute, .. } | Fault::Count { attribute, .. } => {
            spaced(subject, node, attribute)
        }
        Fault::Value { attribute, .. } => in_lower_case(subject, node, attribute),
        Fault::Version(_) => version(subject, node),
        Fault::Repeated(_) | Fault::NotUnique { kind: "material", .. } => equal(subject, node),
        Fault::NotFound(_) => trimmed(subject, node),
        _ => None,
    }
}

fn is_empty_dynamics(node: Node) -> bool {
    name(node) == "dynamics" && node.attributes().len() == 0 && children(node).next().is_none()
}

/// Numbers with single spaces between them: others separate them by tabs, line ends or commas, or have white space around.
fn spaced<'a>(subject: &Subject<'a>, node: Node<'a, 'a>, attribute: &str) -> Option<Fix> {
    let value = node.attribute(attribute)?;
    let count = VECTORS.iter().find(|(name, _)| *name == attribute).map_or(1, |(_, count)| *count);
    let is_between = |c: char| c.is_whitespace() || count > 1 && matches!(c, ',' | ';');
    // A comma within a number is a decimal point to some: `0 0,05`.
    let is_decimal = |word: &str| word.trim_matches([',', ';']).contains(',');
    if value.trim().contains(char::is_whitespace) && value.split_whitespace().any(is_decimal) {
        return None;
    }
    let words: Vec<&str> = value.split(is_between).filter(|word| !word.is_empty()).collect();
    let is_plain = |word: &&str| {
        let is_digit = |byte: u8| byte.is_ascii_digit() || b"+-.eE".contains(&byte);
        word.bytes().all(is_digit) && word.parse().is_ok_and(f64::is_finite)
    };
    let mended = words.join(" ");
    if words.len() != count || !words.iter().all(is_plain) || mended == value {
        return None;
    }
    Some(subject.fix(format!("write `{mended}`"), subject.value(node, attribute)?, mended))
}

/// A word of URDF that was written with other letters.
fn in_lower_case<'a>(subject: &Subject<'a>, node: Node<'a, 'a>, attribute: &str) -> Option<Fix> {
    let value = node.attribute(attribute)?;
    let lower = value.trim().to_lowercase();
    let kinds = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];
    if attribute != "type" || lower == value || !kinds.contains(&lower.as_str()) {
        return None;
    }
    Some(subject.fix(format!("write `{lower}`"), subject.value(node, attribute)?, lower))
}

/// `1.0`, where the robot has nothing that came later.
fn version<'a>(subject: &Subject<'a>, node: Node<'a, 'a>) -> Option<Fix> {
    let is_newer = |node: Node| {
        let has = |name: &&str| node.has_attribute(*name);
        SINCE_1_1.contains(&name(node)) || SINCE_1_1.iter().any(has)
    };
    let mut elements = subject.root.descendants().filter(Node::is_element);
    if elements.any(is_newer) {
        return None;
    }
    Some(subject.fix("write `1.0`", subject.value(node, "version")?, "1.0".to_owned()))
}

/// Removes an element that says again what one of the same name beside it does.
fn equal<'a>(subject: &Subject<'a>, node: Node<'a, 'a>) -> Option<Fix> {
    let own = node.attribute("name");
    let is_other = |other: &Node| name(*other) == name(node) && other.attribute("name") == own;
    let before = node.prev_siblings().skip(1).filter(Node::is_element).take(MOST_BESIDE);
    before.filter(is_other).last().filter(|first| is_equal(*first, node))?;
    let message = format!("remove the second `<{}>`, which says the same", name(node));
    Some(subject.fix(message, whole(subject, node), String::new()))
}

fn is_equal(one: Node, other: Node) -> bool {
    let (mut inside, mut beside) = (children(one), children(other));
    let mut are_equal = || loop {
        match (inside.next(), beside.next()) {
            (None, None) => return true,
            (Some((_, one)), Some((_, other))) if is_equal(one, other) => {}
            _ => return false,
        }
    };
    let has = |attribute: urdd_xml::Attribute| {
        other.attribute(attribute.name()) == Some(attribute.value())
    };
    let text = |node: Node| node.text().unwrap_or_default().trim().to_owned();
    name(one) == name(other)
        && one.attributes().len() == other.attributes().len()
        && one.attributes().all(has)
        && text(one) == text(other)
        && are_equal()
}

/// The name of a file without white space around it, if there is such a file.
fn trimmed<'a>(subject: &Subject<'a>, node: Node<'a, 'a>) -> Option<Fix> {
    let value = node.attribute("filename")?;
    let mended = value.trim();
    if mended == value || mended.is_empty() || !subject.has_file(mended) {
        return None;
    }
    let range = subject.value(node, "filename")?;
    Some(subject.fix(format!("write `{mended}`"), range, mended.to_owned()))
}

/// An element with the white space before it, if nothing else is on its lines.
fn whole<'a>(subject: &Subject<'a>, node: Node<'a, 'a>) -> Range<usize> {
    let range = node.range();
    let before = subject.text[..range.start].trim_end_matches([' ', '\t']);
    let after = subject.text[range.end..].trim_start_matches([' ', '\t']);
    let is_alone = before.ends_with('\n') && after.starts_with(['\n', '\r']);
    match is_alone {
        true => {
            let line = before.strip_suffix("\r\n").or(before.strip_suffix('\n'));
            line.map_or(range.start, str::len)..range.end
        }
        false => range,
    }
}

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
