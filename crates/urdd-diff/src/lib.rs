//! Internal to urdd; no stability promise.
//!
//! `urdd diff`: two robots compared by meaning. [`Side::open`] opens a URDF or a URDD, [`compare`] compares two.
//!
//! Each part (a link, a joint, a material) is first turned into a flat list of values with URDF's defaults filled in
//! (`fields`), so that formatting, the order of attributes, and how a number is written make no difference.

mod beyond_urdf;
mod fields;
mod folders;
mod loops;
mod modules;
mod open;
mod pairs;
mod parts;
mod render;
mod shapes;
mod side;

pub use folders::{
    Folder, Outcome, RobotDifference, compare_folders, folders_json, folders_markdown,
    folders_text, status,
};
pub use render::{markdown, text};
pub use side::{DiffError, Options, Side};

use urdd_directory::range::{OutOfRange, Range};
use urdd_format::diff_report::{DiffReport, PartDifference, ValueChange};
use urdd_format::report::Tool;
use urdd_xml::other_parts::Owner;

use fields::Fields;

/// The tolerance of numbers, each in its own unit.
pub const TOLERANCE: Range = Range::real("tolerance", 0.0, f64::MAX, "");

/// Compares two robots. Numbers that differ by at most `tolerance`, in the unit of each value, are equal; 0 compares
/// exactly. After a cancellation (`Options::urdf`), parts may be missing: discard the report.
///
/// # Errors
/// If the tolerance is out of the range of [`TOLERANCE`].
pub fn compare(before: &Side, after: &Side, tolerance: f64) -> Result<DiffReport, OutOfRange> {
    TOLERANCE.check(tolerance)?;
    let parts = |parts: &dyn Fn(&Side) -> Vec<(String, Fields)>| -> Vec<PartDifference> {
        fields::differences(&parts(before), &parts(after), tolerance)
    };
    let mut notes = notes(before, after);
    if tolerance > 0.0 {
        notes.push(format!("numbers that differ by at most {tolerance:?} are taken as equal"));
    }
    let [a, b] = before.others_beside(after);
    let loops = loops::Both::of(before, after);
    let said: &[&str] = if loops.say_independent { &[loops::OF_JOINT] } else { &[] };
    let [joints_a, joints_b] =
        [(before, a), (after, b)].map(|(side, others)| parts::joints(side, others, said));
    let joints = fields::differences(&joints_a, &joints_b, tolerance);
    if a.is_none() {
        notes.push(
            "attributes that URDF does not define are not compared: one has no URDF".to_owned(),
        );
    }
    let pairs = pairs::differences(before, after, &mut notes);
    let beside = beyond_urdf::differences(before, after, tolerance, &mut notes);
    let mut report = DiffReport {
        tool: Tool::urdd(),
        before: before.summary(),
        after: after.summary(),
        same: false,
        robot: robot(before, after),
        links: parts::links(before, after, tolerance),
        loops: loops.differences(tolerance),
        joints,
        materials: parts(&|side| parts::materials(&side.robot.materials)),
        other_elements: parts(&|side| {
            let mut parts = beyond_urdf::parts(&side.robot.unknown_elements, &side.account);
            parts.retain(|(label, _)| !loops.labels.contains(label));
            parts
        }),
        poses: pairs::poses(before, after, tolerance),
        dofs: loops::dofs(before, after, tolerance),
        pairs,
        configurations: loops::configurations(before, after, tolerance),
        srdf: beside.srdf,
        setup: beside.setup,
        lost: beside.lost,
        modules: None,
        findings: modules::findings(before, after),
        notes,
    };
    report.modules = modules::differences(before, after, &report, tolerance);
    report.same = render::count(&report) == 0;
    Ok(report)
}

/// Differences of the robot itself.
fn robot(before: &Side, after: &Side) -> Vec<ValueChange> {
    let others = before.others_beside(after);
    let fields = |side: &Side, others| {
        let mut fields = Fields::default();
        beyond_urdf::add_parts(others, &Owner::Robot, &[], &mut fields);
        fields.text("name", Some(&side.robot.name));
        let version = side.robot.version.as_deref();
        // Without a version, a URDF is of 1.0 (SPEC 6.1.9).
        fields.text("version", Some(version.unwrap_or("1.0")));
        fields
    };
    // It has no numbers.
    fields::compare("", &fields(before, others[0]), &fields(after, others[1]), 0.0)
}

/// What is not compared, and what differs without a difference in meaning.
fn notes(before: &Side, after: &Side) -> Vec<String> {
    let mut notes = Vec::new();
    for (word, side) in [("A", before), ("B", after)] {
        notes.extend(side.notes.iter().map(|note| format!("{word}: {note}")));
        notes.extend(side.shapes.unread().map(|note| format!("{word}: {note}")));
        let reason = side.validation.as_ref().and_then(|it| it.reason.as_ref());
        notes.extend(reason.map(|why| format!("{word}: not validated: {why}")));
        if side.shapes.is_cut {
            notes.push(format!(
                "{word}: bounding boxes of some links are left out: too many vertices"
            ));
        }
    }
    notes.extend(orders(before, after));
    notes
}

/// Notes on links and joints in another order. What an order of joints means, the indices of DOFs, is in `loops`.
fn orders(before: &Side, after: &Side) -> Vec<String> {
    let is_other = |a: Vec<&str>, b: Vec<&str>| {
        let both = fields::matched(&a, &b).into_iter().filter_map(|part| part.both());
        !both.map(|(_, j)| j).is_sorted()
    };
    let orders = [
        ("links", is_other(before.link_names(), after.link_names())),
        ("joints", is_other(before.joint_names(), after.joint_names())),
    ];
    let others = orders.into_iter().filter(|(_, is_other)| *is_other);
    let note = |word| format!("the {word} are in another order, so their indices in a URDD differ");
    others.map(|(word, _)| note(word)).collect()
}
