//! The codes of all present and past rules. A code is never reused: a removed rule leaves its code in [`RETIRED`].

use crate::code::*;

/// Between the first and the last code of a family, each number belongs to a present or past rule.
#[test]
fn no_number_is_missing() {
    for pair in Code::ALL.windows(2) {
        // The rules about URDFs have the numbers of their candidates (benches/evaluation/lint), of which some were
        // dropped before there was a rule.
        if pair[0].family() != pair[1].family() || pair[0].family() == "LNT" {
            continue;
        }
        let number = |code: Code| code.as_str()[3..].parse::<u32>().expect("three digits");
        for between in number(pair[0]) + 1..number(pair[1]) {
            let code = format!("{}{between:03}", pair[0].family());
            assert!(RetiredCode::parse(&code).is_some(), "{code} is marked nowhere");
        }
    }
    for retired in RETIRED {
        assert_eq!(Code::parse(retired.code), None);
    }
}
