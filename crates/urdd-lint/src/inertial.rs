//! Mass, centre of mass and principal moments of links.

use nalgebra::{Matrix3, Vector3};

use urdd_document::robot::Link;

/// The mass that a link states, kg.
pub fn mass(link: &Link) -> Option<f64> {
    link.inertial.as_ref()?.mass
}

/// The mass properties of a link, in the link's frame. The mass is above 0, and all numbers are finite.
#[derive(Debug, Clone, Copy)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub center: Vector3<f64>,
    /// Principal moments about the centre of mass, kg m².
    pub moments: Vector3<f64>,
    /// The axis of each moment, as columns.
    pub axes: Matrix3<f64>,
}

impl Inertial {
    /// Those of a link; `None` if it has none, or no mass above 0.
    pub fn of(link: &Link) -> Option<Inertial> {
        let inertial = link.inertial.as_ref()?;
        let mass = inertial.mass.filter(|mass| *mass > 0.0 && mass.is_finite())?;
        let [xx, xy, xz, yy, yz, zz] = inertial.inertia?;
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let center = Vector3::from(inertial.origin.xyz);
        let size = tensor.abs().max();
        if !size.is_finite() || !center.iter().all(|x| x.is_finite()) {
            return None;
        }
        // Scaled to 1: squares of numbers near the ends of binary64 would overflow or underflow.
        let scale = if size > 0.0 { size } else { 1.0 };
        let eigen = (tensor / scale).symmetric_eigen();
        Some(Inertial {
            mass,
            center,
            moments: eigen.eigenvalues * scale,
            axes: inertial.origin.rotation() * eigen.eigenvectors,
        })
    }

    /// The sum of the principal moments, kg m².
    pub fn trace(&self) -> f64 {
        self.moments.sum()
    }
}
