//! The two readers of URDF, against each other.

use serde_json::Value;
use urdd_directory::position::LineIndex;
use urdd_source::fault::Fault;
use urdd_source::{SourceError, read_urdf};
use urdd_validate::urdf_text::{self, Reading, compare};

/// What the generator accepts and carries, the validator reads without a problem, and as the same robot; it needs no
/// further repair. What the generator rejects, it rejects because of the robot, or the validator also has a problem
/// with it.
pub fn urdf(bytes: &[u8]) {
    let unmarked = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let text = String::from_utf8_lossy(unmarked);
    let direct = urdf_text::read(&text);
    check(&direct, &text);

    let source = match read_urdf(bytes, "file") {
        Ok(source) => source,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            let readable = direct.problems.is_empty() && std::str::from_utf8(unmarked).is_ok();
            assert!(!readable || is_the_robots(&error), "only the generator: {error}");
            return;
        }
    };
    for note in &source.notes {
        assert!(!note.to_string().is_empty());
    }
    let carried = std::str::from_utf8(&source.carried).expect("what is carried is UTF-8");
    let carried = carried.strip_prefix('\u{FEFF}').unwrap_or(carried);
    let reading = urdf_text::read(carried);
    check(&reading, carried);
    assert!(reading.problems.is_empty(), "{:?}\n{carried}", reading.problems);
    assert_eq!(reading.robot.as_ref(), Some(&source.robot), "{carried}");

    let again = read_urdf(&source.carried, "file").expect("what is carried is read again");
    assert_eq!(again.robot, source.robot, "{carried}");
    assert_eq!(again.carried, source.carried, "{carried}");

    let document = serde_json::to_value(&source.robot).expect("a robot is a document");
    assert_eq!(compare::differences(&document, &document), []);
    for value in numbers(&document) {
        assert!(value.is_finite());
    }
    let _ = urdf_text::as_legacy(&source.robot);
}

/// Every location is in the text, and at the start of a character.
fn check(reading: &Reading, text: &str) {
    let lines = LineIndex::new(text);
    for problem in &reading.problems {
        assert!(text.is_char_boundary(problem.offset), "{problem:?}");
        assert!(!problem.fault.to_string().is_empty());
        lines.position(problem.offset);
    }
    for repeated in &reading.repeated {
        assert!(repeated.first < repeated.range.start, "{repeated:?}");
        assert!(text.is_char_boundary(repeated.range.start), "{repeated:?}");
    }
    if reading.robot.is_some() {
        assert!(reading.position(&lines, "/joints/0/axis/xyz").is_some());
    }
}

/// Whether the error is about the robot rather than about its notation.
fn is_the_robots(error: &SourceError) -> bool {
    let SourceError::Refused { faults, .. } = error else {
        return false;
    };
    faults.iter().any(|placed| {
        !matches!(
            placed.fault,
            Fault::NotXml(_)
                | Fault::NotRobot(_)
                | Fault::MissingAttribute { .. }
                | Fault::MissingElement { .. }
                | Fault::UnknownJointType { .. }
                | Fault::TwoRotations
        )
    })
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(number) => number.as_f64().into_iter().collect(),
        Value::Array(list) => list.iter().flat_map(numbers).collect(),
        Value::Object(map) => map.values().flat_map(numbers).collect(),
        _ => Vec::new(),
    }
}
