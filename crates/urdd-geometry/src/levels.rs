//! The instruction sets of this machine: kernels give the same bits on each, which tests hold.

use fearless_simd::Level;

/// Every level that this machine has, the lowest that its architecture may have among them.
pub fn levels() -> Vec<Level> {
    let best = Level::new();
    let mut levels = vec![best];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_sse2().map(Level::Sse2));
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_avx2().map(Level::Avx2));
    }
    levels
}
