//! Findings with one cause.

use crate::report::causes::*;
use urdd_format::report::Place;

#[test]
fn names_and_numbers_do_not_tell_causes_apart() {
    let same = without_particulars("link `a` is off by 0.25 m, at most 1e-6");
    assert_eq!(same, without_particulars("link `b c` is off by 3 m, at most 2"));
    assert_ne!(same, without_particulars("joint `a` is off by 0.25 m, at most 1e-6"));
}

#[test]
fn places_do_not_tell_causes_apart() {
    let same = meaning("shapes 3 (link `a`) and 0 (link `b`): /full_obbs/0/3 is the edit");
    let other =
        "shapes 9 (piece 0 of `a`) and 1 (piece 2 of `b`): /decomposition_obbs/1/9 is the edit";
    assert_eq!(same, meaning(other));
    assert_eq!(
        meaning("the sphere about piece 1 of link 1 (`a`) is large"),
        meaning("the sphere about the hull of link 3 (`b`) is large")
    );
    assert_ne!(meaning("the origin (`a`) is lost"), meaning("the axis (`a`) is lost"));
}

#[test]
fn a_pair_is_the_same_either_way_round() {
    let at = |subject: &str| Place { subject: Some(subject.to_owned()), ..Place::default() };
    let one = subject(&at("`b` piece 3, `a` piece 1"));
    assert_eq!(one.as_deref(), Some("`a`, `b`"));
    assert_eq!(one, subject(&at("`a`, `b`")));
}
