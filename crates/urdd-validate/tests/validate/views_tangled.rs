//! Shapes whose rows of a matrix are wrong as a whole, so that one mistake gives one finding.

use urdd_document::shape_matrices::Elements;
use urdd_validate::views::tangled::*;

fn skips(rows: [[bool; 3]; 3]) -> Tangled {
    let rows: Vec<Vec<bool>> = rows.iter().map(|row| row.to_vec()).collect();
    Tangled::new(Elements::Skips(&rows))
}

#[test]
fn exchanged_rows_are_tangled_and_others_are_not() {
    let sound = skips([[true, false, true], [false, true, false], [true, false, true]]);
    assert!((0..3).all(|i| !sound.asymmetric(i) && !sound.pair(i, i)));
    // The last two rows are exchanged.
    let exchanged = skips([[true, false, true], [true, false, true], [false, true, false]]);
    assert!(exchanged.asymmetric(1) && exchanged.pair(1, 2));
    // Equal except for the two diagonal elements and those across.
    let across = skips([[true, false, false], [false, false, true], [false, true, false]]);
    assert!(!across.asymmetric(1) && across.pair(1, 2) && !across.pair(0, 1));
}
