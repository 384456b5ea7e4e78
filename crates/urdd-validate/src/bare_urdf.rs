//! Validates a URDF without a URDD, with the rules that need only the source: whether it describes one tree, whether
//! its names resolve, and what is unusual about it.

use std::path::Path;

use super::context::{Subject, examined};
use super::described::{Described, UrdfText};
use super::engine::{Outcomes, run_all};
use super::reference::urdf_text;
use super::rule::{CheckOf, Rule};
use super::rules;
use urdd_directory::discover::Found;
use urdd_directory::robot_file::RobotFile;
use urdd_directory::root::{ReadError, Root};
use urdd_document::carried_urdf::{self, CarriedUrdf};
use urdd_document::mechanism::Mechanism;
use urdd_findings::examined::Examined;
use urdd_format::report::Kind;
use urdd_xml::Xml;

/// Whether a path is a file that is a URDF: by its content, or by its extension where that does not say.
pub fn is_urdf(path: &Path) -> bool {
    path.is_file() && RobotFile::at(path) == Some(RobotFile::Urdf)
}

/// The URDF at a path: its folder, and its file name.
pub fn found(path: &Path) -> Found {
    // The target of a symbolic link can be in another folder.
    let target = path.is_symlink().then(|| path.canonicalize().unwrap_or_default());
    let path = target.as_deref().unwrap_or(path);
    let name = path.file_name().unwrap_or_default();
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    Found { path: folder.to_owned(), name: name.to_string_lossy().into_owned(), closed: None }
}

/// Examines a URDF with the rules that apply to it.
pub(super) fn examine(found: &Found, rules: &[&'static Rule]) -> Result<Examined, ReadError> {
    let urdf = carried_urdf::read_file(&Root::open(&found.path)?, &found.name)?;
    Ok(judged(urdf, None, &found.name, rules))
}

/// Examines the text of a URDF with the rules that need nothing else. `name` is its name in the report.
pub fn examine_urdf(xml: &Xml<'_>, name: &str) -> Examined {
    Examined::caught::<ReadError>(Kind::Urdf, name, || {
        let urdf = CarriedUrdf::of_bytes(name, xml.text().as_bytes())?;
        // A byte order mark is not part of the URDF.
        let reading = (urdf.text == xml.text()).then(|| urdf_text::of(xml));
        Ok(judged(urdf, reading, name, &rules::all()))
    })
}

fn judged(
    urdf: CarriedUrdf,
    reading: Option<urdf_text::Reading>,
    name: &str,
    rules: &[&'static Rule],
) -> Examined {
    let text = UrdfText::known(reading);
    let mechanism = text.robot(Ok(&urdf)).map(Mechanism::new);
    let described =
        Described { mechanism: mechanism.as_ref(), module: None, urdf: Ok(&urdf), text: &text };
    let of_robots = rules.iter().copied().filter(|rule| matches!(rule.check, CheckOf::Robot(_)));
    let subject = Subject { described, urdd: None };
    let mut checks = run_all(subject, of_robots.collect(), &mut Outcomes::new());
    checks.sort_by_key(|check| check.rule.code);
    examined(Kind::Urdf, name, described.robot(), checks)
}
