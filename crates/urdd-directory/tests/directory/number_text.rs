//! The canonical form of numbers, for JSON and YAML.

use serde_json::Number;
use urdd_directory::canonical::{write_float, write_number};

#[test]
fn floats_have_one_spelling() {
    let cases = [
        (0.0, "0.0"),
        (-0.0, "0.0"),
        (1.0, "1.0"),
        (-2.5, "-2.5"),
        (0.1, "0.1"),
        (1e-4, "0.0001"),
        (1.234e-4, "0.0001234"),
        (9.999_999e-5, "9.999999e-5"),
        (1e-7, "1.0e-7"),
        (-1.5e-300, "-1.5e-300"),
        (1e15, "1000000000000000.0"),
        (9_999_999_999_999_998.0, "9999999999999998.0"),
        (1e16, "1.0e+16"),
        (1.25e22, "1.25e+22"),
        (f64::MAX, "1.7976931348623157e+308"),
        (5e-324, "5.0e-324"),
    ];
    for (x, expected) in cases {
        let mut text = String::new();
        write_float(x, &mut text).unwrap();
        assert_eq!(text, expected);
    }
}

#[test]
fn integers_stay_integers() {
    for n in ["0", "-1", "18446744073709551615", "-9223372036854775808"] {
        let number: Number = n.parse().unwrap();
        let mut text = String::new();
        write_number(&number, &mut text).unwrap();
        assert_eq!(text, n);
    }
}
