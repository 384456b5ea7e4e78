//! A crash outside of any rule.

use crate::check::Examined;
use urdd_format::report::{Cause, Kind, NotExamined};

#[test]
fn a_crash_outside_of_any_rule_is_said_of_its_urdd() {
    let crash = || -> Result<Examined, NotExamined> { panic!("at index {}", 7) };
    let examined = Examined::caught(Kind::Urdd, "a", crash);
    let why = examined.report.not_examined.expect("a reason");
    assert_eq!(why.cause, Cause::Crash);
    assert!(why.reason.starts_with("the program crashed: at index 7;"));
}
