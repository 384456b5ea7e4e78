//! The ranges of options that Python checks together with their types.

use urdd_directory::range::Range;

/// The ranges of whole numbers, by the function and its argument.
pub fn all() -> Vec<(&'static str, (u64, u64))> {
    let ends = |range: Range| (range.least as u64, range.most as u64);
    vec![
        ("generate.pieces", ends(urdd_generate::PIECES)),
        ("generate.samples", ends(urdd_generate::SAMPLES)),
        ("export.spheres", ends(urdd_export::SPHERES)),
        ("export.total_spheres", ends(urdd_export::TOTAL_SPHERES)),
        ("export.samples", ends(urdd_export::SAMPLES)),
    ]
}
