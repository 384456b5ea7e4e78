//! Masses and moments of inertia, and what programs make of those that no body has.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use urdd_document::robot::Inertial;
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

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

/// MuJoCo's mjMINVAL, below which it treats a value as 0: kg and kg m².
pub(super) const MIN_VALUE: f64 = 1e-15;
/// Assumed mass of a moving body that needs one, kg.
const ASSUMED_MASS: f64 = 1e-9;
/// Assumed moment of inertia of a moving body that needs one, kg m².
const ASSUMED_INERTIA: f64 = 1e-9;
/// The least moment for which MuJoCo finds principal axes by itself: it neglects products of inertia below it.
const LEAST_FULL: f64 = 1e-12;

/// The mass and inertia of a body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mass {
    pub mass: f64,
    pub centre: [f64; 3],
    /// Principal moments of inertia, kg m².
    pub moments: Vector3<f64>,
    /// The principal axes, in the link's frame.
    pub axes: Rotation3<f64>,
    /// xx, yy, zz, xy, xz, yz in the link's frame, if these are equivalent and MuJoCo accepts them.
    full: Option<[f64; 6]>,
}

/// The mass that MuJoCo uses for a link, and why it is not that of the URDF.
pub fn mass(inertial: &Inertial) -> (Option<Mass>, Option<Odd>) {
    let given = inertial.mass.unwrap_or(0.0);
    let mut odd = (given < 0.0).then_some(Odd::Negative);
    let tensor = tensor(inertial.inertia.unwrap_or_default());
    let rotation = inertial.origin.rotation();
    let turned = rotation * tensor * rotation.transpose();
    let mut eigen = ((turned + turned.transpose()) / 2.0).symmetric_eigen();
    if eigen.eigenvectors.determinant() < 0.0 {
        eigen.eigenvectors.neg_mut();
    }
    let (mut moments, most) = (eigen.eigenvalues, eigen.eigenvalues.amax());
    if moments.min() < -ROUNDING * most {
        odd = Some(Odd::Indefinite);
        moments.fill(0.0);
    }
    moments.apply(|moment| *moment = moment.max(0.0));
    let largest = moments.imax();
    // As MuJoCo computes it.
    let others = moments[(largest + 1) % 3] + moments[(largest + 2) % 3];
    let room = others - moments[largest];
    if room < -ROUNDING * most {
        odd = Some(Odd::Triangle);
    } else if room < 0.0 {
        // For a thin plate, the two are equal up to rounding.
        moments[largest] = others;
    }
    let is_full = moments.min() > LEAST_FULL && room > ROUNDING * most;
    let mass = given.max(0.0);
    let found = (mass > 0.0 || moments.max() > 0.0).then(|| Mass {
        mass,
        centre: inertial.origin.xyz,
        moments,
        axes: Rotation3::from_matrix_unchecked(eigen.eigenvectors),
        full: is_full
            .then(|| [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| turned[at])),
    });
    (found, odd)
}

impl Mass {
    /// Whether MuJoCo accepts it for a moving body.
    pub fn is_enough(&self) -> bool {
        self.mass > MIN_VALUE && self.moments.min() > MIN_VALUE
    }

    /// Raises mass and moments to what a moving body needs.
    pub fn raise(&mut self) {
        if self.mass <= MIN_VALUE {
            self.mass = ASSUMED_MASS;
        }
        (self.moments).apply(|moment| *moment = moment.max(ASSUMED_INERTIA));
        self.full = None;
    }

    /// MJCF's element.
    pub(super) fn element(self) -> Element {
        let element = Element::new("inertial")
            .with("pos", numbers(&self.centre))
            .with("mass", number(self.mass));
        if let Some(full) = self.full {
            return element.with("fullinertia", numbers(&full));
        }
        let q = UnitQuaternion::from_rotation_matrix(&self.axes);
        element
            .with("quat", numbers(&[q.w, q.i, q.j, q.k]))
            .with("diaginertia", numbers(self.moments.as_slice()))
    }
}
