//! Ranges of options.

use urdd_directory::range::Range;

const SAMPLES: Range = Range::whole("samples", 100, 1_000_000);
const BANDWIDTH: Range = Range::real("bandwidth", 0.01, 1000.0, "Hz");

#[test]
fn takes_its_ends_and_nothing_beyond() {
    for given in [100.0, 101.0, 1e6] {
        assert_eq!(SAMPLES.check(given), Ok(given));
    }
    for given in [99.0, 100.5, -100.0, 1e300, f64::NAN, f64::INFINITY] {
        assert!(SAMPLES.check(given).is_err(), "{given}");
    }
    assert_eq!(BANDWIDTH.check(0.015), Ok(0.015));
    for given in [0.0, -5.0, 1e300, f64::NAN] {
        assert!(BANDWIDTH.check(given).is_err(), "{given}");
    }
    let length = Range::above_zero("piece_tolerance", "m");
    assert_eq!(length.check(1e-300), Ok(1e-300));
    assert!(length.check(0.0).is_err() && length.check(f64::INFINITY).is_err());
}

#[test]
fn an_error_names_the_option_and_its_range() {
    let said = |range: Range, given| range.check(given).err().map(|error| error.to_string());
    let expected = "`samples` must be a whole number from 100 to 1,000,000, not 7";
    assert_eq!(said(SAMPLES, 7.0).as_deref(), Some(expected));
    let expected = "`bandwidth` must be from 0.01 to 1,000 Hz, not -5";
    assert_eq!(said(BANDWIDTH, -5.0).as_deref(), Some(expected));
    let step = Range::real("step", f64::MIN_POSITIVE, 0.1, "s");
    let expected = "`step` must be above 0 and at most 0.1 s, not 0";
    assert_eq!(said(step, 0.0).as_deref(), Some(expected));
    assert_eq!(SAMPLES.parse::<u32>("100"), Ok(100));
    for word in ["x", "99", "100.0", "-1"] {
        let expected = "it must be a whole number from 100 to 1,000,000";
        assert_eq!(SAMPLES.parse::<u32>(word), Err(expected.to_owned()), "{word}");
    }
}
