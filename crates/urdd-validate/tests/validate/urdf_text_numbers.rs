//! Numbers as URDF writes them.

use urdd_validate::urdf_text::numbers as read;

#[test]
fn reads_what_readers_of_urdf_read() {
    assert_eq!(read("\n  0\t-5e-2\r\n +.01 "), Some([0.0, -0.05, 0.01]));
    assert_eq!(read("1. 2.E+3 .5"), Some([1.0, 2000.0, 0.5]));
    assert_eq!(read("-0"), Some([-0.0]));
    assert_eq!(read("inf"), Some([f64::INFINITY]));
    assert_eq!(read("1e999"), Some([f64::INFINITY]));
    assert!(read::<1>("NaN").is_some_and(|[x]| x.is_nan()));
}

#[test]
fn drops_no_word_and_makes_up_none() {
    for text in
        ["0 x 0 1", "0 0", "0 0 0 0", "", "0, 0, 0", "0x1 0 0", "1_0 0 0", "0 0 ${z}", "1.0f 0 0"]
    {
        assert_eq!(read::<3>(text), None, "{text}");
    }
    assert_eq!(read::<1>(""), None);
    assert_eq!(read::<1>("1 2"), None);
}
