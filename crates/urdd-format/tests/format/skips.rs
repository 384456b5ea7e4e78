//! Which pairs of links are skipped, by reasons and edits.

use SkipReason::{Adjacent, Always, Never, None as NoReason, SameLink};
use SkippedReason as Skipped;
use urdd_format::index::{LinkIdx, PieceIdx};
use urdd_format::link_shapes_simple_skips::{LinkShapesSimpleSkipsModule, SkipReason, SkipReasons};
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit, SkippedReason};
use urdd_format::shapes::PieceShape;
use urdd_format::skips::skips_module;

/// Three links; the first has two pieces.
fn simple() -> LinkShapesSimpleSkipsModule {
    let full = vec![
        vec![SameLink, Adjacent, Never],
        vec![Adjacent, SameLink, NoReason],
        vec![Never, NoReason, SameLink],
    ];
    let pieces = vec![
        vec![SameLink, SameLink, Adjacent, Never],
        vec![SameLink, SameLink, Always, Never],
        vec![Adjacent, Always, SameLink, NoReason],
        vec![Never, Never, NoReason, SameLink],
    ];
    let piece =
        |link: u32, piece: u32| PieceShape { link_idx: LinkIdx(link), piece_idx: PieceIdx(piece) };
    LinkShapesSimpleSkipsModule {
        full_shapes: (0..3).map(LinkIdx).collect(),
        decomposition_shapes: vec![piece(0, 0), piece(0, 1), piece(1, 0), piece(2, 0)],
        full_convex_hulls_simple_skips: Vec::new(),
        full_obbs_simple_skips: Vec::new(),
        full_bounding_spheres_simple_skips: Vec::new(),
        decomposition_convex_hulls_simple_skips: None,
        decomposition_obbs_simple_skips: None,
        decomposition_bounding_spheres_simple_skips: None,
        reasons: SkipReasons {
            full_convex_hulls: full.clone(),
            full_obbs: full.clone(),
            full_bounding_spheres: full,
            decomposition_convex_hulls: Some(pieces),
            decomposition_obbs: None,
            decomposition_bounding_spheres: None,
        },
    }
}

fn edit(link_a: &str, link_b: &str, skip: bool) -> SkipEdit {
    SkipEdit { link_a: link_a.to_owned(), link_b: link_b.to_owned(), skip, reason: String::new() }
}

fn made(skipped: &[SkippedReason], edits: Vec<SkipEdit>) -> LinkShapesSkipsModule {
    skips_module(&simple(), skipped.to_vec(), edits, &["a", "b", "c"])
}

const T: bool = true;
const F: bool = false;

#[test]
fn a_pair_is_skipped_for_its_reason() {
    let of = |skipped: &[SkippedReason]| made(skipped, Vec::new()).full_convex_hulls_skips;
    assert_eq!(of(&[]), [[T, F, F], [F, T, F], [F, F, T]]);
    assert_eq!(of(&[Skipped::SameLink, Skipped::Adjacent]), [[T, T, F], [T, T, F], [F, F, T]]);
    assert_eq!(of(&[Skipped::Never]), [[T, F, T], [F, T, F], [T, F, T]]);
    assert_eq!(made(&[Skipped::Never], Vec::new()).decomposition_obbs_skips, None);
}

#[test]
fn of_several_edits_of_a_pair_the_last_counts_and_all_pieces_follow() {
    let edits = vec![
        edit("b", "a", true),
        edit("c", "a", true),
        edit("a", "b", false),
        edit("a", "a", false),
        edit("a", "nobody", true),
    ];
    let skips = made(&[Skipped::SameLink, Skipped::Always, Skipped::Adjacent], edits);
    let pieces = skips.decomposition_convex_hulls_skips.expect("matrix");
    assert_eq!(pieces, [[T, F, F, T], [F, T, F, T], [F, F, T, F], [T, T, F, T]]);
}
