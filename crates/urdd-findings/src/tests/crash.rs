//! A crash outside of any rule.

use crate::check::Examined;
use urdd_format::report::{Kind, Verdict};

#[test]
fn a_crash_outside_of_any_rule_is_said_of_its_urdd() {
    let crash = || -> Result<Examined, String> { panic!("at index {}", 7) };
    let examined = Examined::caught(Kind::Urdd, "a", crash);
    assert_eq!(examined.report.verdict, Verdict::Incomplete);
    let reason = examined.report.reason.expect("a reason");
    assert!(reason.starts_with("the program crashed: at index 7;"));
}
