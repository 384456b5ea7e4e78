//! Numbers of eight configurations at once, in 32 bits: one lane is one configuration.
//!
//! Uses only operations with the same result on every instruction set, as `urdd_geometry`'s lanes do: never a fused
//! multiply-add.

use fearless_simd::{Simd, f32x8, f64x8, mask32x8, prelude::*};

/// Configurations in a block.
pub const LANES: usize = 8;

/// A number for each lane.
pub type Num<S> = f32x8<S>;
/// A Boolean for each lane.
pub type Mask<S> = mask32x8<S>;

/// A number for each lane, in memory.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub struct Row(pub [f32; LANES]);

/// As [`Row`], in 64 bits: the values of a DOF.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub struct WideRow(pub [f64; LANES]);

impl Row {
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> Num<S> {
        Num::load_array_ref(simd, &self.0)
    }

    #[inline(always)]
    pub fn of<S: Simd>(value: Num<S>) -> Self {
        Row(value.to_array())
    }
}

/// A point or vector for each lane, in memory.
pub type Point = [Row; 3];

/// A point or vector for each lane.
#[derive(Clone, Copy)]
pub struct Vec3<S: Simd> {
    pub x: Num<S>,
    pub y: Num<S>,
    pub z: Num<S>,
}

#[inline(always)]
pub fn splat<S: Simd>(simd: S, value: f32) -> Num<S> {
    Num::splat(simd, value)
}

impl<S: Simd> Vec3<S> {
    #[inline(always)]
    pub fn splat(simd: S, [x, y, z]: [f32; 3]) -> Self {
        Vec3 { x: splat(simd, x), y: splat(simd, y), z: splat(simd, z) }
    }

    #[inline(always)]
    pub fn load(simd: S, point: &Point) -> Self {
        Vec3 { x: point[0].load(simd), y: point[1].load(simd), z: point[2].load(simd) }
    }

    #[inline(always)]
    pub fn store(self) -> Point {
        [Row::of(self.x), Row::of(self.y), Row::of(self.z)]
    }

    #[inline(always)]
    pub fn scale(self, by: Num<S>) -> Self {
        Vec3 { x: self.x * by, y: self.y * by, z: self.z * by }
    }

    #[inline(always)]
    pub fn plus(self, o: Self) -> Self {
        Vec3 { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }

    #[inline(always)]
    pub fn minus(self, o: Self) -> Self {
        Vec3 { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }

    #[inline(always)]
    pub fn negated(self) -> Self {
        Vec3 { x: -self.x, y: -self.y, z: -self.z }
    }

    #[inline(always)]
    pub fn dot(self, o: Self) -> Num<S> {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// The squared distance.
    #[inline(always)]
    pub fn apart(self, o: Self) -> Num<S> {
        let between = self.minus(o);
        between.dot(between)
    }
}

/// A bit for each lane.
#[inline(always)]
pub fn bits<S: Simd>(mask: Mask<S>) -> u8 {
    mask.to_bitmask() as u8
}

/// Angles beyond this, rad, are reduced before [`sin_cos`].
pub const MOST_ANGLE: f64 = 1_048_576.0;

/// How far a sine or a cosine of [`sin_cos`] is from the true one, at most.
pub const SIN_COS_ERROR: f64 = 2e-7;

/// The sine and the cosine of each angle, at most [`MOST_ANGLE`], rad, each within [`SIN_COS_ERROR`].
///
/// The nearest multiple of a quarter turn is taken off in 64 bits, in two parts, the first of which has 33 bits, so that its
/// product is exact. The rest, at most an eighth of a turn, goes through the polynomials of Cephes (`sinf`, `cosf`).
#[inline(always)]
pub fn sin_cos<S: Simd>(simd: S, angle: f64x8<S>) -> [Num<S>; 2] {
    const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
    // Added to a number below 2^51 in size, it rounds it to an integer.
    let round = f64x8::splat(simd, 6_755_399_441_055_744.0);
    let quarters = (angle * std::f64::consts::FRAC_2_PI + round) - round;
    let rest = (angle - quarters * QUARTER[0]) - quarters * QUARTER[1];
    // From -2 to 2.
    let quarter = quarters - ((quarters * 0.25 + round) - round) * 4.0;
    let (r, quarter) = (narrow(rest), narrow(quarter));
    let s = r * r;
    let sin = r + r * s * (((s * -1.951_529_6e-4 + 8.332_161e-3) * s) + -1.666_665_5e-1);
    let cos = (splat(simd, 1.0) - s * 0.5)
        + s * s * (((s * 2.443_315_7e-5 + -1.388_731_6e-3) * s) + 4.166_664_6e-2);
    let swapped = quarter.abs().simd_eq(1.0);
    let [sin, cos] = [swapped.select(cos, sin), swapped.select(sin, cos)];
    // A turn by one quarter: (cos, -sin); by two: (-sin, -cos); back by one: (-cos, sin).
    let half = quarter.abs().simd_gt(1.5);
    let sin_turns = half | quarter.simd_eq(-1.0);
    let cos_turns = half | quarter.simd_eq(1.0);
    [sin_turns.select(-sin, sin), cos_turns.select(-cos, cos)]
}

/// In 32 bits.
#[inline(always)]
pub fn narrow<S: Simd>(value: f64x8<S>) -> Num<S> {
    let (low, high) = value.split();
    low.narrow(high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    /// All levels that this machine supports, including the baseline of its architecture.
    fn levels() -> Vec<Level> {
        let best = Level::new();
        #[cfg(target_arch = "x86_64")]
        let others = [
            best.as_sse2().map(Level::Sse2),
            best.as_sse4_2().map(Level::Sse4_2),
            best.as_avx2().map(Level::Avx2),
        ];
        #[cfg(not(target_arch = "x86_64"))]
        let others = [None];
        others.into_iter().flatten().chain([best]).collect()
    }

    fn of(level: Level, angles: &[f64; LANES]) -> [[f32; LANES]; 2] {
        dispatch!(level, simd => {
            let [sin, cos] = sin_cos(simd, f64x8::load_array_ref(simd, angles));
            [sin.to_array(), cos.to_array()]
        })
    }

    #[test]
    fn sines_and_cosines_are_near_and_the_same_on_each_level() {
        let mut angle = -MOST_ANGLE;
        let mut worst = 0.0f64;
        // Steps that are no part of a turn, finer near zero.
        while angle < MOST_ANGLE {
            let step = 0.000_731 + 1.7e-4 * angle.abs();
            let angles: [f64; LANES] =
                std::array::from_fn(|lane| (angle + step * lane as f64).min(MOST_ANGLE));
            let found = of(Level::new(), &angles);
            for level in levels() {
                assert_eq!(
                    of(level, &angles).map(|all| all.map(f32::to_bits)),
                    found.map(|all| all.map(f32::to_bits))
                );
            }
            for lane in 0..LANES {
                let (sin, cos) = angles[lane].sin_cos();
                worst = worst.max((f64::from(found[0][lane]) - sin).abs());
                worst = worst.max((f64::from(found[1][lane]) - cos).abs());
            }
            angle += 8.0 * step;
        }
        assert!(worst < SIN_COS_ERROR && worst > 0.2 * SIN_COS_ERROR, "{worst}");
    }
}
