use super::*;

#[test]
fn what_is_no_number_is_nan() {
    for word in ["", ".", "-", "e5", "1e", "1.2.3", "1.#QNAN", "-nan(ind)", "1,5", "0x10"] {
        assert!(float(word.as_bytes()).is_nan(), "{word}");
    }
}

#[test]
fn indices() {
    let mut words = Words::new(b"4294967295 4294967296 00000000000007 -1");
    assert_eq!(words.index(), Some(Some(u32::MAX)));
    assert_eq!(words.index(), Some(None));
    assert_eq!(words.index(), Some(Some(7)));
    assert_eq!(words.index(), Some(None));
    assert_eq!(words.index(), None);
}
