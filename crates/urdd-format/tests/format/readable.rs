//! Numbers in messages.

use urdd_format::readable::{counted, first_of, metres, number};

#[test]
fn an_exponent_stands_only_where_a_number_is_small_or_large() {
    for (value, digits, expected) in [
        (12.68, 4, "12.68"),
        (1.0, 5, "1"),
        (-0.5, 4, "-0.5"),
        (0.001_234_56, 3, "0.00123"),
        (0.000_999_96, 4, "1e-3"),
        (0.001, 2, "0.001"),
        (0.000_123_4, 3, "1.23e-4"),
        (4e-8, 2, "4e-8"),
        (123_456.7, 3, "123457"),
        (999_999.4, 3, "999999"),
        (1e6, 3, "1e6"),
        (-2.345e300, 3, "-2.35e300"),
        (0.0, 3, "0"),
        (-0.0, 3, "0"),
        (f64::INFINITY, 3, "inf"),
        (f64::NAN, 3, "NaN"),
    ] {
        assert_eq!(number(value, digits), expected, "{value}");
    }
    assert_eq!(metres(0.05), "0.05 m");
}

#[test]
fn any_number_reads_back_as_nearly_itself() {
    let mut value = f64::MIN_POSITIVE;
    while value.is_finite() {
        let read: f64 = number(value, 6).parse().expect("a number");
        assert!((read / value - 1.0).abs() < 1e-5, "{value} {read}");
        value *= 3.7;
    }
}

#[test]
fn one_thing_is_one() {
    assert_eq!(
        [counted(0, "DOF"), counted(1, "DOF"), counted(2, "DOF"), counted(3, "dynamics")],
        ["0 DOFs", "1 DOF", "2 DOFs", "3 dynamics"]
    );
}

#[test]
fn what_is_not_listed_is_counted() {
    let listed = |names: &[&str]| first_of(names.iter(), 2);
    assert_eq!(listed(&[]), "");
    assert_eq!(listed(&["a"]), "a");
    assert_eq!(listed(&["a", "b"]), "a, b");
    assert_eq!(listed(&["a", "b", "c", "d"]), "a, b and 2 more");
}
