//! Reproducible random choices from a seed.

use sha2::{Digest, Sha256};

use urdd_kinematics::unit;

/// Random numbers determined by a seed and a name, so that the choices for one field do not depend on other fields.
pub(crate) struct Dice {
    stream: u64,
    count: u64,
}

impl Dice {
    pub(crate) fn new(seed: u64, name: &str) -> Self {
        let mut hasher = Sha256::new();
        hasher.update(seed.to_le_bytes());
        hasher.update(name);
        let hash = hasher.finalize();
        let stream = hash.iter().take(4).fold(0, |bits, byte| bits << 8 | u64::from(*byte));
        Dice { stream, count: 0 }
    }

    /// A number below `count`, or 0 if `count` is 0.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub(crate) fn below(&mut self, count: usize) -> usize {
        self.count += 1;
        (unit(self.stream, self.count) * count as f64) as usize
    }

    /// 1 or -1.
    pub(crate) fn sign(&mut self) -> f64 {
        [1.0, -1.0][self.below(2)]
    }

    /// `most` distinct numbers below `count`, or all of them, in random order.
    pub(crate) fn choose(&mut self, count: usize, most: usize) -> Vec<usize> {
        let mut all: Vec<usize> = (0..count).collect();
        let most = most.min(count);
        for place in 0..most {
            let other = place + self.below(count - place);
            all.swap(place, other);
        }
        all.truncate(most);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chooses_each_at_most_once_and_the_same_again() {
        let chosen = Dice::new(7, "a").choose(100, 40);
        let mut once = chosen.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), 40);
        assert!(once.iter().all(|place| *place < 100));
        assert_eq!(chosen, Dice::new(7, "a").choose(100, 40));
        assert_ne!(chosen, Dice::new(8, "a").choose(100, 40));
        assert_ne!(chosen, Dice::new(7, "b").choose(100, 40));
        assert_eq!(Dice::new(7, "a").choose(3, 40).len(), 3);
    }
}
