//! The mass of several bodies that are one.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

use crate::pose::origin;
use urdd_document::robot::Inertial as View;
use urdd_format::urdf::{Inertia, Inertial, Mass};

/// The mass, centre and moments of inertia of bodies at these poses: masses add up, and moments about the common centre by
/// the parallel axis theorem. A mass below 0 counts as 0, whose centre is nowhere. `None` if a number is not finite.
pub(super) fn lump(bodies: &[(Isometry3<f64>, &View)]) -> Option<Inertial> {
    let placed = bodies.iter().map(|(pose, of)| {
        let place = pose * of.origin.motion();
        (of.mass.unwrap_or(0.0).max(0.0), place, of.inertia.unwrap_or_default())
    });
    let placed: Vec<_> = placed.collect();
    let total: f64 = placed.iter().map(|(mass, ..)| mass).sum();
    let at = |place: &Isometry3<f64>| (place * Point3::origin()).coords;
    let centre: Vector3<f64> = if total > 0.0 {
        placed.iter().map(|(mass, place, _)| at(place) * (mass / total)).sum()
    } else {
        Vector3::zeros()
    };
    let mut sum = Matrix3::zeros();
    for (mass, place, [xx, xy, xz, yy, yz, zz]) in &placed {
        let turn = place.rotation.to_rotation_matrix();
        let own = Matrix3::new(*xx, *xy, *xz, *xy, *yy, *yz, *xz, *yz, *zz);
        let arm = at(place) - centre;
        let steiner = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
        sum += turn * own * turn.transpose() + steiner * *mass;
    }
    let inertia = |row: usize, column: usize| Some(sum[(row, column)]);
    let is_finite = total.is_finite() && centre.iter().chain(&sum).all(|value| value.is_finite());
    is_finite.then(|| Inertial {
        origin: Some(origin(&Isometry3::from_parts(centre.into(), Default::default()))),
        mass: Some(Mass { value: total }),
        inertia: Some(Inertia {
            ixx: inertia(0, 0),
            ixy: inertia(0, 1),
            ixz: inertia(0, 2),
            iyy: inertia(1, 1),
            iyz: inertia(1, 2),
            izz: inertia(2, 2),
        }),
    })
}
