//! What Drake takes for the inertia of a body.

use super::Reader;
use crate::prelude::*;

impl Reader<'_> {
    /// An inertial. One that no body can have is a solid sphere of water of its mass, or of 1 kg.
    pub(super) fn inertial(&mut self, inertial: Node<'_>, part: &Part) -> Reading<()> {
        self.pose(inertial, part)?;
        let mut written = None;
        if let Some(node) = inertial.child("mass") {
            written = self.number(node, "value", part)?;
        }
        let mass = written.unwrap_or_default();
        let mut tensor = [0.0; 6];
        if let Some(node) = inertial.child("inertia") {
            let names = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
            for (name, value) in names.into_iter().zip(&mut tensor) {
                *value = self.number(node, name, part)?.unwrap_or_default();
            }
        }
        let fault = if mass < 0.0 {
            Fault::Other("the mass is negative")
        } else if !can_be(tensor) {
            Fault::Inertia(
                "no body has this inertia: two moments are less than the third, or one is negative",
            )
        } else if mass == 0.0 && tensor != [0.0; 6] {
            Fault::Inertia("the mass is 0 or missing, and the inertia is not 0")
        } else {
            if written.is_none() {
                self.effects.read_as(inertial, part, Fault::MissingElement("mass"), "no mass");
            }
            return Ok(());
        };
        let mass = if mass > 0.0 { mass } else { 1.0 };
        self.effects.read_as(inertial, part, fault, format!("a sphere of water of {mass} kg"));
        Ok(())
    }
}

/// Whether a body can have moments of inertia xx, yy, zz, xy, xz, yz.
fn can_be(tensor: [f64; 6]) -> bool {
    let moments = principal(tensor);
    let half = tensor[..3].iter().sum::<f64>() / 2.0;
    let near = 16.0 * f64::EPSILON * half.max(1.0);
    moments[0] >= -near && moments[0] + moments[1] + near >= moments[2]
}

/// The principal moments, the smallest first, by Jacobi's rotations.
fn principal([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 3] {
    let mut of = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    const TURNS: usize = 30;
    for turn in 0..TURNS {
        let (p, q) = [(0, 1), (0, 2), (1, 2)][turn % 3];
        if of[p][q] == 0.0 {
            continue;
        }
        let theta = (of[q][q] - of[p][p]) / (2.0 * of[p][q]);
        let tangent = theta.signum() / (theta.abs() + theta.hypot(1.0));
        let cosine = 1.0 / tangent.hypot(1.0);
        let sine = tangent * cosine;
        let change = tangent * of[p][q];
        of[p][p] -= change;
        of[q][q] += change;
        of[p][q] = 0.0;
        of[q][p] = 0.0;
        let r = 3 - p - q;
        let (rp, rq) = (of[r][p], of[r][q]);
        of[r][p] = cosine * rp - sine * rq;
        of[r][q] = sine * rp + cosine * rq;
        of[p][r] = of[r][p];
        of[q][r] = of[r][q];
    }
    let mut moments = [of[0][0], of[1][1], of[2][2]];
    moments.sort_unstable_by(f64::total_cmp);
    moments
}
