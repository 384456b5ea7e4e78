//! Choices of a seeded test: numbers, rotations and bodies.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// Numbers that are the same in each run.
pub struct Dice(pub u64);

impl Dice {
    /// In [0, 1).
    pub fn roll(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }

    pub fn turn(&mut self) -> UnitQuaternion<f64> {
        let [r, p, y] = [3.1, 1.5, 3.1].map(|most| self.within(-most, most));
        UnitQuaternion::from_euler_angles(r, p, y)
    }

    pub fn pose(&mut self) -> Isometry3<f64> {
        let turn = self.turn();
        let place = Translation3::from([0, 1, 2].map(|_| self.within(-0.6, 0.6)));
        Isometry3::from_parts(place, turn)
    }

    /// Points on an ellipsoid.
    pub fn body(&mut self, count: usize) -> Vec<[f64; 3]> {
        let size = [0, 1, 2].map(|_| self.within(0.05, 0.5));
        (0..count)
            .map(|_| {
                let p = Vector3::from([0, 1, 2].map(|_| self.within(-1.0, 1.0))).normalize();
                [0, 1, 2].map(|k| size[k] * p[k] + 0.3)
            })
            .collect()
    }
}

/// The number of arbitrary inputs to try: `few`, times `URDD_TRIALS` where it is set.
pub fn trials(few: u32) -> u32 {
    let factor = std::env::var("URDD_TRIALS");
    few * factor.map_or(1, |factor| factor.parse().expect("a number"))
}
