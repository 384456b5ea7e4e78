use urdd_directory::file_type::FileType;
use urdd_directory::position::LineIndex;
use urdd_findings::part::SkipReason;
use urdd_source::checked_in::{urdf_of, xacros_of};
use urdd_source::declared_of;
use urdd_xml::Xml;

use super::prelude::*;
use crate::checked_in::{compared, made, may_be_robot, text};
use crate::meaning::Differences;

declare_lint! {
    /// A `.urdf` is not what the xacro file of its name beside it makes.
    ///
    /// `arm.urdf` was made of `arm.xacro` or `arm.urdf.xacro` once, and one of the two was changed since. Programs that read the
    /// `.urdf` have another robot than those that run xacro, and the next person who runs it loses what was changed by hand.
    ///
    /// Make it again: `xacro arm.urdf.xacro > arm.urdf`. If it was made with arguments, declare these in `urdd.toml`
    /// (`[[robot]]`): a `.urdf` that is one of the declared robots is no finding. If it is another robot, give it another name.
    ///
    /// Formatting, the order of attributes and of parts, and rounded numbers (to five digits or a millionth) are no difference. It is compared where
    /// xacro may run: with `--xacro`, or where the xacro file is named.
    LNT067 "checked-in-urdf-is-stale", Warning, WrongMotion, since "1.4.1"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let settings = &urdf.settings.source;
    let path = urdf.folder.join(urdf.file);
    if FileType::Xacro.is_of(&path) {
        return of_xacro(urdf, &path, findings);
    }
    if !settings.xacro.expand_urdf || urdf.settings.without_meshes {
        return Some(());
    }
    let (mut first, mut unknown) = (None, None);
    for xacro in xacros_of(&path, urdf.files).into_iter().filter(|one| may_be_robot(one, settings))
    {
        let name = xacro.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for made in made(&xacro, settings) {
            match made {
                Err(error) => {
                    unknown
                        .get_or_insert_with(|| format!("`{name}` beside it was not made: {error}"));
                }
                Ok(read) => match compared(urdf.root, &Xml::new(&read.text), urdf.folder, settings)
                {
                    Some(found) if found.count == 0 => return Some(()),
                    Some(found) => drop(first.get_or_insert((name.clone(), found))),
                    None => {}
                },
            }
        }
    }
    match (first, unknown) {
        // One that was not made may be what it is.
        (_, Some(why)) => findings.skip(SkipReason::obstacle(why)),
        (Some((xacro, Differences { first: Some((node, attribute, words)), count, .. })), None) => {
            let message = message(urdf.file, &xacro, &words, count);
            match attribute {
                Some(attribute) => urdf.at_attribute(node, attribute, message),
                None => urdf.at(node, message),
            }
            .report(findings);
            Some(())
        }
        _ => Some(()),
    }
}

fn message(urdf: &str, xacro: &str, words: &str, count: usize) -> String {
    let more = match count {
        0 | 1 => String::new(),
        2 => " (and 1 more difference)".to_owned(),
        _ => format!(" (and {} more differences)", count - 1),
    };
    format!(
        "`{urdf}` is not what `{xacro}` makes: {words}{more}; make it again, or declare the arguments that it is made with in urdd.toml"
    )
}

/// A xacro file, and the URDF of its name beside it, which nobody else examines.
fn of_xacro(urdf: &Subject, path: &Path, findings: &mut Findings) -> Option<()> {
    let settings = &urdf.settings.source;
    let declared = declared_of(path, &settings.robots);
    // Of several robots of a file, one compares all.
    let is_first = declared.first().is_none_or(|one| one.arguments == settings.xacro.arguments);
    if !urdf.settings.compares_checked_in || !is_first {
        return Some(());
    }
    let beside = urdf_of(path);
    let Some(read) = text(&beside, settings) else { return Some(()) };
    let xml = Xml::new(&read.text);
    let root = xml.document().ok()?.root_element();
    let own = compared(root, &Xml::new(urdf.text), urdf.folder, settings)?;
    let mut others = declared.iter().skip(1).filter_map(|one| {
        let settings = settings.with_declared(&one.arguments);
        urdd_source::read_source(path, &settings).ok()
    });
    let is_same = |read: &urdd_source::SourceText| {
        let found = compared(root, &Xml::new(&read.text), urdf.folder, settings);
        found.is_some_and(|found| found.count == 0)
    };
    if own.count == 0 || others.any(|one| is_same(&one)) {
        return Some(());
    }
    let (node, _, words) = own.first?;
    let name = beside.file_name().unwrap_or_default().to_string_lossy();
    let at = LineIndex::new(&read.text).position(node.range().start);
    let message = message(&name, urdf.file, &words, own.count);
    Finding::in_file(name, message).position(Some(at)).report(findings);
    Some(())
}
