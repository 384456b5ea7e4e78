use crate::rules::prelude::*;
use urdd_directory::position::{self, LineIndex};
use urdd_document::carried_urdf::NoUrdf;
use urdd_document::schema_check::excerpt;

declare_rule! {
    /// The carried URDF cannot be read as a URDF.
    ///
    /// The file must be well-formed XML in UTF-8 with a `<robot>` that has a name; every link a
    /// name; every joint a name, a type that URDF defines, a parent and a child; every mimic a
    /// joint; every shape its sizes or its file name. Numbers must be numbers: three to a vector, four to
    /// a colour. Where that fails, readers differ: some refuse, some drop a word of `0 x 0 1`, some take
    /// zeros. SPEC 6.1.8 lists every element and attribute.
    ///
    /// Correct the URDF at the places that are given, and write the URDD again. A `$(arg …)` or `${…}`
    /// means that xacro was not run.
    URD011 "unreadable-urdf", Error, clause "6.1.2", since "0.1.0",
    phase Syntax, needs [UrdfFile], of Robot,
}

fn check(described: &Described, findings: &mut Findings) -> Option<()> {
    let carried = match described.urdf {
        Ok(carried) => carried,
        Err(NoUrdf::Unreadable { path, error }) => {
            findings.report(Finding::in_file(path, format!("the URDF is too large: {error}")));
            return Some(());
        }
        Err(_) => return None,
    };
    let reading = described.urdf_text()?;
    if let Some(offset) = carried.not_utf8_at {
        let message =
            "the URDF is not in UTF-8; save it as UTF-8, and say so in its XML declaration";
        Finding::in_file(&carried.path, message)
            .position(Some(position::position(&carried.text, offset)))
            .report(findings);
        return Some(());
    }
    let lines = LineIndex::new(&carried.text);
    for problem in &reading.problems {
        let mut finding = Finding::in_file(&carried.path, problem.fault.to_string())
            .position(Some(lines.position(problem.offset)));
        if let Some(actual) = &problem.actual {
            finding = finding.actual(excerpt(&actual.as_str().into()));
        }
        findings.report(finding);
    }
    Some(())
}
