//! Masses and tensors of bodies, with the limits that MuJoCo has for them.

use crate::space::{Matrix, Pose, Vector, centre, moved, sum, turned};

pub const LEAST_EIGENVALUE: f64 = 1e-14;

/// Mass, centre, tensor about the centre, and its eigenvalues from the largest to the smallest.
#[derive(Clone, Default)]
pub struct Body {
    pub mass: f64,
    pub centre: Vector,
    pub tensor: Matrix,
    pub moments: Vector,
}

impl Body {
    /// A body whose tensor is about axes of its own.
    pub fn new(mass: f64, pose: &Pose, tensor: &Matrix) -> Body {
        let tensor = turned(tensor, &pose.turn);
        Body { mass, centre: pose.xyz, tensor, moments: [0.0; 3] }
    }

    /// The body as it is seen from another place.
    pub fn placed(&self, at: &Pose) -> Body {
        Body {
            mass: self.mass,
            centre: at.place(self.centre),
            tensor: turned(&self.tensor, &at.turn),
            moments: self.moments,
        }
    }

    /// Two bodies as one.
    pub fn with(&self, other: &Body, epsilon: f64) -> Body {
        let mass = self.mass + other.mass;
        let centre = centre([self.mass, other.mass], [self.centre, other.centre]);
        let [own, others] =
            [self, other].map(|body| moved(&body.tensor, body.mass, body.centre, centre));
        let tensor = sum(&own, &others);
        Body { mass, centre, tensor, moments: eigenvalues(&tensor, epsilon) }
    }
}

/// The eigenvalues of a symmetric matrix from the largest to the smallest, by rotations that make its largest element off
/// the diagonal 0. One below `epsilon`, and a rotation that is less, is none. NaN if an element is not finite.
pub fn eigenvalues(matrix: &Matrix, epsilon: f64) -> Vector {
    const MOST: usize = 500;
    if matrix.iter().flatten().any(|value| !value.is_finite()) {
        return [f64::NAN; 3];
    }
    let mut turned = *matrix;
    for _ in 0..MOST {
        let off = |row: usize, column: usize| turned[row][column].abs();
        let (row, column, other) = if off(0, 1) > off(0, 2) && off(0, 1) > off(1, 2) {
            (0, 1, 2)
        } else if off(0, 2) > off(1, 2) {
            (0, 2, 1)
        } else {
            (1, 2, 0)
        };
        let value = turned[row][column];
        if value == 0.0 || value.abs() < epsilon {
            break;
        }
        let tau = (turned[column][column] - turned[row][row]) / (2.0 * value);
        let tangent = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        if cosine > 1.0 - epsilon {
            break;
        }
        let sine = tangent * cosine;
        turned[row][row] -= tangent * value;
        turned[column][column] += tangent * value;
        let (first, second) = (turned[other][row], turned[other][column]);
        for (at, value) in [
            ((row, column), 0.0),
            ((other, row), cosine * first - sine * second),
            ((other, column), sine * first + cosine * second),
        ] {
            (turned[at.0][at.1], turned[at.1][at.0]) = (value, value);
        }
    }
    let mut values = [0, 1, 2].map(|axis| turned[axis][axis]);
    values.sort_by(|a, b| b.total_cmp(a));
    values
}
