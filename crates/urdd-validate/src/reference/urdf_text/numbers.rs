//! Numbers as URDF writes them.

/// The numbers of an attribute: decimal, with or without fraction, exponent and sign (`+.01`, `1.`, `-5e-2`), separated
/// and surrounded by white space. `inf`, `nan` and numbers beyond binary64 are read as numbers that are not finite.
pub fn read<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    let mut words = text.split_ascii_whitespace();
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    words.next().is_none().then_some(numbers)
}
