//! Reproducible choices of a seeded test.

/// A pseudorandom generator with the same numbers in every run.
pub struct Dice(pub u64);

impl Dice {
    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(1);
        let drawn = urdd_kinematics::unit(self.0 >> 32, self.0 & 0xffff_ffff);
        (drawn * count as f64) as usize
    }

    /// Any 16 bits.
    pub fn word(&mut self) -> u16 {
        self.below(1 << 16) as u16
    }
}
