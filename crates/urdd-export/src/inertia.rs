//! Moments of inertia that hold the triangle inequality in the digits that are written: a principal moment is at most the
//! sum of the other two. For a thin plate or a rod the two are equal, and rounding may break it.

use nalgebra::Matrix3;

/// What is rounding, relative to the largest principal moment.
pub(super) const ROUNDING: f64 = 1e-9;

/// What no body has. Each format has its words for it, and for what it writes instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Odd {
    /// A mass below 0.
    Negative,
    /// A principal moment below 0.
    Indefinite,
    /// A principal moment that is more than the other two together.
    Triangle,
}

/// How precisely readers find the principal moments of an inertia with products, relative to the largest: Gazebo's, by
/// trigonometry, to 1e-8.
const FOUND: f64 = 1e-7;

/// An inertia (xx, xy, xz, yy, yz, zz, kg m²) that readers accept, whichever way they compute principal moments: where the
/// inequality or the sign of a moment is a matter of rounding, 2e-7 of the largest moment are added about each axis.
/// `None` for one that no body has. Moments of 0 stay, unless `positive` is asked for.
pub fn held(inertia: [f64; 6], positive: bool) -> Option<[f64; 6]> {
    let [xx, xy, xz, yy, yz, zz] = inertia;
    let moments = tensor(inertia).symmetric_eigenvalues();
    let most = moments.amax();
    let least = moments.min();
    let room = moments.sum() - 2.0 * moments.max();
    if least.min(room) < -ROUNDING * most {
        return None;
    }
    let is_diagonal = [xy, xz, yz] == [0.0; 3];
    // As readers of a diagonal inertia compute it.
    let is_exact = xx + yy >= zz && yy + zz >= xx && zz + xx >= yy && xx.min(yy).min(zz) >= 0.0;
    let is_right = if is_diagonal {
        is_exact && !(positive && least <= 0.0)
    } else {
        least.min(room) >= FOUND * most
    };
    if is_right {
        return Some(inertia);
    }
    let more = 2.0 * FOUND * most;
    Some([xx + more, xy, xz, yy + more, yz, zz + more])
}

/// The tensor of xx, xy, xz, yy, yz, zz.
pub(super) fn tensor([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// The mean of the moments of inertia.
pub(super) fn mean([xx, _, _, yy, _, zz]: [f64; 6]) -> f64 {
    (xx + yy + zz) / 3.0
}

/// The mass of a link that has moments of inertia alone, kg: far less than any body's, and Drake keeps the moments.
const LEAST_MASS: f64 = 1e-9;

const MASSLESS: &str =
    "moments of inertia without mass, for which Drake assumes 1 kg: exported with 1e-9 kg";
const NEGATIVE: &str =
    "a negative mass, for which Drake assumes 1 kg: exported as if they had none";
const IMPOSSIBLE: &str = "moments of inertia that no body has, for which Drake assumes 1 kg: exported with their mean about each axis";

/// A mass and an inertia that Drake takes as they are: it assumes a body of 1 kg for others. And what was changed.
pub fn for_drake(mass: f64, inertia: [f64; 6]) -> (f64, [f64; 6], Option<&'static str>) {
    let held = held(inertia, false);
    let mut said = held.is_none().then_some(IMPOSSIBLE);
    let mean = mean(inertia).max(0.0);
    let inertia = held.unwrap_or([mean, 0.0, 0.0, mean, 0.0, mean]);
    let has_moments = inertia != [0.0; 6];
    if mass < 0.0 {
        said = Some(NEGATIVE);
    } else if mass == 0.0 && has_moments {
        said = said.or(Some(MASSLESS));
    }
    let least = if has_moments { LEAST_MASS } else { 0.0 };
    (if mass > 0.0 { mass } else { least }, inertia, said)
}
