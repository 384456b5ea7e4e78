//! What is said of a URDD or URDF that was not examined, and where.

use crate::run::is_inside;
use urdd_format::report::{Kind, NotExamined, Place, Urdd};

/// What it is called.
pub(super) const NOT_EXAMINED: &str = "not examined";

/// Why something was not examined, where no finding says it: LNT065 does, with the lines to write.
pub(super) fn unexamined(urdd: &Urdd) -> Option<&NotExamined> {
    urdd.not_examined.as_ref().filter(|_| urdd.findings.is_empty())
}

/// The place of the reason, where `folder` is that of the URDD or URDF: of one in no file there, the URDF itself.
pub(super) fn place_in(urdd: &Urdd, folder: &str, why: &NotExamined) -> Place {
    match &why.file {
        Some(file) if is_inside(folder, Some(file)) => {
            Place { file: why.file.clone(), line: why.line, column: why.column, ..Place::default() }
        }
        _ => Place { file: own_file(urdd).map(str::to_owned), ..Place::default() },
    }
}

/// The name of a URDF in its folder; a URDD has none.
pub(super) fn own_file(urdd: &Urdd) -> Option<&str> {
    urdd.path.rsplit('/').next().filter(|_| urdd.kind == Kind::Urdf)
}

/// The place of the reason in words, as `file:line:column`.
pub(super) fn words(why: &NotExamined) -> Option<String> {
    let file = why.file.clone()?;
    let line = why.line.map(|line| format!(":{line}")).unwrap_or_default();
    let column = why.column.map(|column| format!(":{column}")).unwrap_or_default();
    Some(file + &line + &column)
}
