//! The parts of a robot that a rule judges, and those that it did not verify.

use std::collections::HashMap;

use crate::code::Code;
use crate::part::*;

#[test]
fn an_unsound_part_is_left_out_and_said() {
    let mut scope = Scope::without(HashMap::from([(Part::Hull(1), Code::MSH017)]));
    let piece = |link| Part::Piece { link, piece: 0 };
    assert!(!scope.judges(piece(1), &[Part::Hull(1)]));
    assert_eq!(scope.nothing_left(), Some(Code::MSH017));
    assert!(scope.judges(piece(0), &[Part::Hull(0)]));
    assert_eq!(scope.nothing_left(), None);
    let left = scope.not_verified();
    assert_eq!(left.len(), 1);
    assert_eq!(left[0].part, piece(1));
    assert_eq!(left[0].why, Why::Failed(Code::MSH017));
    assert!(scope.afresh().judges(piece(0), &[]));
}

#[test]
fn a_fault_without_a_part_is_one_of_all_parts() {
    let mut faulted = Faulted::default();
    faulted.add(&[Part::Plain(3)]);
    assert!(!faulted.parts().is_empty() && !faulted.has_pieces());
    faulted.add(&[Part::Piece { link: 3, piece: 0 }]);
    assert!(faulted.has_pieces() && !faulted.elsewhere());
    let mut faulted = Faulted::default();
    faulted.add(&[]);
    assert!(faulted.has_pieces() && faulted.elsewhere());
}
