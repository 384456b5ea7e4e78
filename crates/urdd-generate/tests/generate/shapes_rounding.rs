//! Rounds distances to their significant digits.

use urdd_generate::shapes::seven_digits;

#[test]
fn the_number_nearest_to_the_decimal_of_seven_digits() {
    // Rust's own formatting, which rounds exactly.
    let mut x = 1.000_000_4e-6;
    while x < 1e6 {
        let text = format!("{x:.6e}");
        assert_eq!(seven_digits(x), text.parse::<f64>().unwrap(), "{x}");
        x *= 1.000_37;
    }
    assert_eq!(seven_digits(0.0), 0.0);
    assert_eq!(seven_digits(9.999_999_7), 10.0);
    assert_eq!(seven_digits(123.456_784_9), 123.4568);
    for unchanged in [1.234_567_891e-7, 1_234_567.891, 0.125] {
        assert_eq!(seven_digits(unchanged), unchanged);
    }
}

#[test]
fn order_is_kept() {
    let mut before = 0.0;
    for step in 0..200_000_i32 {
        let x = 0.999_99 + f64::from(step) * 1e-10;
        assert!(seven_digits(x) >= before);
        before = seven_digits(x);
    }
}
