//! Options out of their ranges are refused by the library itself, whoever asks.

use urdd_export::{ActuatorKind, Choices, Detail, ExportError, Format};

use crate::made::{export, robot, urdf};

/// What is wrong with an option, if it is refused for its range.
fn refused(format: Format, choices: Choices) -> Option<String> {
    let (_folder, robot) = robot(&urdf(
        "<link name=\"a\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>",
    ));
    match export(&robot, format, &choices) {
        Err(error @ ExportError::Range(_)) => Some(error.to_string()),
        _ => None,
    }
}

fn of_actuators(bandwidth: f64) -> Choices {
    let (actuators, bandwidth) = (Some(ActuatorKind::Position), Some(bandwidth));
    Choices { actuators, bandwidth, ..Choices::default() }
}

#[test]
fn a_bandwidth() {
    for format in [Format::Mjcf, Format::Usd] {
        for (wrong, shown) in [
            (-5.0, "-5"),
            (0.0, "0"),
            (0.001, "0.001"),
            (1e-300, "1e-300"),
            (1e300, "1e300"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            let said = refused(format, of_actuators(wrong)).expect("refused");
            let expected = format!("`bandwidth` must be from 0.01 to 1,000 Hz, not {shown}");
            assert_eq!(said, expected);
        }
        assert_eq!(refused(format, of_actuators(100.0)), None);
    }
}

#[test]
fn numbers_of_spheres_and_samples() {
    let few = Choices { samples: 100, ..Choices::default() };
    for format in [Format::Curobo, Format::Foam, Format::Spherized] {
        for spheres in [0, 10_001] {
            let said = refused(format, Choices { spheres: Some(spheres), ..few.clone() });
            assert!(said.is_some_and(|said| said.contains("from 1 to 10,000")), "{spheres}");
        }
        let said = refused(format, Choices { total_spheres: Some(0), ..few.clone() });
        assert!(said.is_some_and(|said| said.contains("`total_spheres`")));
        for samples in [0, 99, 1_000_001] {
            let said = refused(format, Choices { samples, ..few.clone() });
            assert!(said.is_some_and(|said| said.contains("from 100 to 1,000,000")), "{samples}");
        }
        assert_eq!(refused(format, few.clone()), None);
    }
}

#[test]
fn a_part_of_the_triangles() {
    let wrong = [Detail::Ratio(0.0), Detail::Ratio(-1.0), Detail::Ratio(f64::NAN)];
    for detail in wrong.into_iter().chain([Detail::Ratio(1.0), Detail::Triangles(0)]) {
        for format in [Format::Urdf, Format::Drake, Format::Mjcf, Format::Moveit, Format::Sdf] {
            let said = refused(format, Choices { visuals: detail, ..Choices::default() });
            assert!(said.is_some_and(|said| said.contains("`visuals`")), "{detail:?}");
        }
    }
    assert_eq!(Detail::new(0.25), Ok(Detail::Ratio(0.25)));
    assert_eq!(Detail::new(200.0), Ok(Detail::Triangles(200)));
    for wrong in [0.0, -1.0, 1.5, f64::NAN, 1e300_f64.powi(2)] {
        assert!(Detail::new(wrong).is_err(), "{wrong}");
    }
}
