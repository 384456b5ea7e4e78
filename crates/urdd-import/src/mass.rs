//! Masses with their centres and inertias, and many as one.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

/// A mass, its centre, and the inertia about it along the axes of the frame.
#[derive(Debug, Clone, Copy)]
pub struct Mass {
    /// kg.
    pub mass: f64,
    /// m.
    pub centre: Vector3<f64>,
    /// kg m².
    pub inertia: Matrix3<f64>,
}

impl Mass {
    /// A mass with these moments about the axes of its frame.
    pub fn along_axes(mass: f64, centre: Vector3<f64>, moments: [f64; 3]) -> Self {
        Mass { mass, centre, inertia: Matrix3::from_diagonal(&moments.into()) }
    }

    /// As it is where its frame has a pose.
    pub fn at(&self, pose: &Isometry3<f64>) -> Self {
        let rotation = pose.rotation.to_rotation_matrix();
        Mass {
            mass: self.mass,
            centre: (pose * Point3::from(self.centre)).coords,
            inertia: rotation.matrix() * self.inertia * rotation.matrix().transpose(),
        }
    }

    /// Masses as one; none without any.
    pub fn together(parts: &[Mass]) -> Option<Mass> {
        if let [only] = parts {
            return Some(*only);
        }
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        let weighted: Vector3<f64> = parts.iter().map(|part| part.centre * part.mass).sum();
        let centre = (!parts.is_empty()).then(|| weighted / mass)?;
        let inertia = parts.iter().map(|part| {
            let off = part.centre - centre;
            let around = Matrix3::identity() * off.norm_squared() - off * off.transpose();
            part.inertia + around * part.mass
        });
        Some(Mass { mass, centre, inertia: inertia.sum() })
    }
}
