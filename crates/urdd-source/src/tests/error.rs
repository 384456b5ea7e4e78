//! Places of errors.

use crate::fault::{Fault, PlacedFault};
use crate::note::SourcePlace;
use crate::{MacroCall, SourceError, XacroFault};

fn place(file: &str, line: u32, column: u32) -> SourcePlace {
    SourcePlace { file: file.to_owned(), line, column }
}

#[test]
fn an_error_has_the_innermost_place() {
    let file = || "a.xacro".to_owned();
    let call = MacroCall { place: place("a.xacro", 3, 1), name: "part".to_owned() };
    let fault = XacroFault {
        reason: "no".to_owned(),
        place: Some(place("b.xacro", 5, 6)),
        calls: vec![call],
        ..XacroFault::default()
    };
    let refused = |own: Option<&str>| {
        let file_of_fault = own.map(str::to_owned);
        let fault =
            PlacedFault { file: file_of_fault, line: 7, column: 8, fault: Fault::TwoRotations };
        SourceError::Refused { file: file(), faults: vec![fault] }
    };
    let xacro = SourceError::Xacro { file: file(), fault: Box::new(fault) };
    let said = "b.xacro:5:6: `xacro` could not expand a.xacro: no; by the macro `part`, called at a.xacro:3:1";
    assert_eq!(xacro.to_string(), said);
    let import = SourceError::Import { file: file(), line: 1, column: 2, fault: "no".to_owned() };
    for (error, expected) in [
        (xacro, Some(place("b.xacro", 5, 6))),
        (refused(None), Some(place("a.xacro", 7, 8))),
        (refused(Some("b.xacro")), Some(place("b.xacro", 7, 8))),
        (import, Some(place("a.xacro", 1, 2))),
        (SourceError::unread("a.xacro", "no"), Some(place("a.xacro", 0, 0))),
        (
            SourceError::Xacro { file: file(), fault: "no".to_owned().into() },
            Some(place("a.xacro", 0, 0)),
        ),
        (SourceError::Cancelled, None),
    ] {
        assert_eq!(error.place(), expected, "{error}");
    }
}
