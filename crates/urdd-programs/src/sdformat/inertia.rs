//! Inertias that libsdformat adds up where links become one, and which of them ign-math calls valid.

use std::f64::consts::PI;

pub(super) type Vector = [f64; 3];
type Matrix = [[f64; 3]; 3];

/// Where something is: its position, and roll, pitch and yaw.
#[derive(Clone, Copy, Default)]
pub(super) struct Pose {
    pub xyz: Vector,
    pub rpy: Vector,
}

/// The inertia of a link.
#[derive(Clone, Copy, Default)]
pub(super) struct Inertia {
    pub mass: f64,
    pub pose: Pose,
    /// About the centre of mass, in the axes of its pose.
    pub moments: Matrix,
}

impl Inertia {
    /// Adds that of a link which is at a pose. If both have no mass, the centre of mass is not a number.
    pub fn add(&mut self, other: &Inertia, at: &Pose) {
        let mass = self.mass + other.mass;
        let (own, joint) = (rotation(self.pose.rpy), rotation(at.rpy));
        let turned = apply(&joint, other.pose.xyz);
        let center: Vector = std::array::from_fn(|axis| turned[axis] + at.xyz[axis]);
        let common: Vector = std::array::from_fn(|axis| {
            (self.mass * self.pose.xyz[axis] + other.mass * center[axis]) / mass
        });
        let first = about(&rotated(&own, &self.moments), self.mass, self.pose.xyz, common);
        let axes = multiplied(&joint, &rotation(other.pose.rpy));
        let second = about(&rotated(&axes, &other.moments), other.mass, center, common);
        let sum = std::array::from_fn(|row| {
            std::array::from_fn(|column| first[row][column] + second[row][column])
        });
        self.moments = rotated(&transposed(&own), &sum);
        self.pose.xyz = common;
        self.mass = mass;
    }

    /// `MassMatrix3::IsValid` of ign-math.
    pub fn is_valid(&self) -> bool {
        let m = &self.moments;
        let diagonal = [m[0][0], m[1][1], m[2][2]];
        let near = tolerance(diagonal);
        let determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[1][2])
            - m[0][1] * (m[0][1] * m[2][2] - m[1][2] * m[0][2])
            + m[0][2] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
        let minor = m[0][0] * m[1][1] - m[0][1] * m[0][1];
        let is_positive = self.mass >= 0.0
            && [m[0][0], minor, determinant].into_iter().all(|number| number + near >= 0.0);
        let principal = self.principal();
        let near = tolerance(principal);
        let [a, b, c] = principal;
        is_positive
            && principal.into_iter().all(|moment| moment + near >= 0.0)
            && [(a, b, c), (b, c, a), (c, a, b)].into_iter().all(|(a, b, c)| a + b + near >= c)
    }

    /// The principal moments, as ign-math finds them.
    fn principal(&self) -> Vector {
        const NEAR: f64 = 1e-6;
        let m = &self.moments;
        let (x, y, z) = (m[0][0], m[1][1], m[2][2]);
        let (xy, xz, yz) = (m[0][1], m[0][2], m[1][2]);
        let near = NEAR * x.max(y).max(z);
        if [xy, xz, yz].into_iter().all(|product| product.abs() <= near) {
            return [x, y, z];
        }
        let b = x + y + z;
        let c = x * y - xy * xy + x * z - xz * xz + y * z - yz * yz;
        let d = x * yz * yz + y * xz * xz + z * xy * xy - x * y * z - 2.0 * xy * xz * yz;
        let p = b * b - 3.0 * c;
        if p < near * near {
            return [b / 3.0; 3];
        }
        let q = 2.0 * b * b * b - 9.0 * b * c - 27.0 * d;
        let angle = (0.5 * q / p.powf(1.5)).clamp(-1.0, 1.0).acos();
        [0.0, 2.0 * PI, -2.0 * PI]
            .map(|turn| (b + 2.0 * p.sqrt() * ((angle + turn) / 3.0).cos()) / 3.0)
    }
}

/// What counts as nothing beside moments.
fn tolerance(moments: Vector) -> f64 {
    10.0 * f64::EPSILON * 0.5 * moments.iter().sum::<f64>().abs()
}

/// Moments about a centre of mass, moved to another point.
fn about(moments: &Matrix, mass: f64, center: Vector, point: Vector) -> Matrix {
    let offset: Vector = std::array::from_fn(|axis| center[axis] - point[axis]);
    let square: f64 = offset.iter().map(|part| part * part).sum();
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let own = if row == column { square } else { 0.0 };
            moments[row][column] + mass * (own - offset[row] * offset[column])
        })
    })
}

fn rotation([roll, pitch, yaw]: Vector) -> Matrix {
    let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
    [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
}

fn apply(matrix: &Matrix, vector: Vector) -> Vector {
    matrix.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
}

fn transposed(matrix: &Matrix) -> Matrix {
    std::array::from_fn(|row| std::array::from_fn(|column| matrix[column][row]))
}

fn multiplied(first: &Matrix, second: &Matrix) -> Matrix {
    let columns = transposed(second);
    first.map(|row| columns.map(|column| row.iter().zip(column).map(|(a, b)| a * b).sum()))
}

/// A tensor in other axes.
fn rotated(axes: &Matrix, tensor: &Matrix) -> Matrix {
    multiplied(&multiplied(axes, tensor), &transposed(axes))
}
