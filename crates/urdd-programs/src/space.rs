//! Vectors, matrices and poses, for readers that compute inertias as their programs do.

pub(crate) type Vector = [f64; 3];
pub(crate) type Matrix = [[f64; 3]; 3];

/// A place and a turn.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub xyz: Vector,
    pub turn: Matrix,
}

impl Default for Pose {
    fn default() -> Pose {
        Pose { xyz: [0.0; 3], turn: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] }
    }
}

impl Pose {
    /// Of an `<origin>`. Angles that are not finite are 0.
    pub fn new(xyz: Vector, rpy: Vector) -> Pose {
        let [(sr, cr), (sp, cp), (sy, cy)] =
            rpy.map(|angle| if angle.is_finite() { angle.sin_cos() } else { (0.0, 1.0) });
        let turn = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ];
        Pose { xyz, turn }
    }

    /// The pose of something that has a pose in this one.
    pub fn then(&self, inner: &Pose) -> Pose {
        Pose { xyz: self.place(inner.xyz), turn: product(&self.turn, &inner.turn) }
    }

    pub fn place(&self, point: Vector) -> Vector {
        [0, 1, 2].map(|row| self.xyz[row] + dot(self.turn[row], point))
    }
}

/// A tensor about other axes.
pub(crate) fn turned(tensor: &Matrix, turn: &Matrix) -> Matrix {
    product(&product(turn, tensor), &transposed(turn))
}

/// The tensor of a mass about its centre, about another point.
pub(crate) fn moved(tensor: &Matrix, mass: f64, centre: Vector, point: Vector) -> Matrix {
    let arm = less(centre, point);
    let mut moved = *tensor;
    for row in 0..3 {
        for column in 0..3 {
            let square = if row == column { dot(arm, arm) } else { 0.0 };
            moved[row][column] += mass * (square - arm[row] * arm[column]);
        }
    }
    moved
}

/// The centre of two masses together.
pub(crate) fn centre(masses: [f64; 2], centres: [Vector; 2]) -> Vector {
    let sum = masses[0] + masses[1];
    [0, 1, 2].map(|axis| (masses[0] * centres[0][axis] + masses[1] * centres[1][axis]) / sum)
}

pub(crate) fn sum(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| a[row][column] + b[row][column]))
}

pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let b = transposed(b);
    a.map(|row| b.map(|column| dot(row, column)))
}

pub(crate) fn transposed(a: &Matrix) -> Matrix {
    [0, 1, 2].map(|column| a.map(|row| row[column]))
}

pub(crate) fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
