//! Batches of configurations: the threads that write their results.

use rayon::prelude::*;

/// Writes the results of a batch of configurations, `width` values each, into `out`, in blocks of `block`
/// configurations on rayon's thread pool. `write` gets the scratch state that a block shares, the index of the
/// configuration and its part of `out`. A single block is written on the caller's thread. Apart from the state and
/// `write`, nothing allocates.
///
/// # Errors
/// The error of `write` for the first configuration that fails. Results after it may then be missing.
pub fn fill<T: Send, S: Default, E: Send>(
    out: &mut [T],
    width: usize,
    block: usize,
    write: impl Fn(&mut S, usize, &mut [T]) -> Result<(), E> + Sync,
) -> Result<(), E> {
    if width == 0 {
        return Ok(());
    }
    let write_block = |(number, out): (usize, &mut [T])| {
        let mut shared = S::default();
        let mut each = out.chunks_mut(width).enumerate();
        each.find_map(|(k, row)| write(&mut shared, number * block + k, row).err())
    };
    let size = width.saturating_mul(block);
    let error = match out.len() <= size {
        true => write_block((0, out)),
        false => (out.par_chunks_mut(size).enumerate()).find_map_first(write_block),
    };
    error.map_or(Ok(()), Err)
}
