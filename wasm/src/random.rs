//! Seeds for hash tables. They need not be random: no output depends on them.

/// Fills `length` bytes.
///
/// # Safety
/// As `getrandom` calls it: `length` bytes at `pointer` may be written.
#[unsafe(no_mangle)]
unsafe extern "Rust" fn __getrandom_v03_custom(
    pointer: *mut u8,
    length: usize,
) -> Result<(), getrandom::Error> {
    for k in 0..length {
        // SAFETY: within the range that the caller allows.
        unsafe { pointer.add(k).write((k as u8).wrapping_mul(157) ^ 0x5A) };
    }
    Ok(())
}
