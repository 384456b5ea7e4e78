//! A triangle mesh, and its measures.

use nalgebra::{Matrix3, Matrix4, Vector3};

/// A triangle mesh. Lengths in metres.
///
/// A triangle is three indices into `vertices`, counter-clockwise when seen from outside. The methods of this
/// type panic on an index that is out of range; meshes from [`read`](crate::read) have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions, metres.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each triangle, as indices of `vertices`.
    pub triangles: Vec<[u32; 3]>,
}

/// An axis-aligned box: its lowest and highest corner, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinate along each axis.
    pub min: [f64; 3],
    /// The greatest coordinate along each axis.
    pub max: [f64; 3],
}

/// Scales, then rotates, then moves: the 4 by 4 matrix of a URDF mesh element in its link's frame.
///
/// `rotation` holds rows, `translation` is in metres.
#[must_use]
pub fn placement(scale: [f64; 3], rotation: [[f64; 3]; 3], translation: [f64; 3]) -> Matrix4<f64> {
    Matrix4::from_fn(|row, column| match (row, column) {
        (3, 3) => 1.0,
        (3, _) => 0.0,
        (_, 3) => translation[row],
        _ => rotation[row][column] * scale[column],
    })
}

impl Mesh {
    /// The positions of a triangle's corners.
    #[must_use]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|index| self.vertices[index as usize])
    }

    /// The box around the triangles; `None` without triangles. Vertices that no triangle uses do not count.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        let first = self.vertices[self.triangles.first()?[0] as usize];
        let mut bounds = Bounds {
            min: first,
            max: first,
        };
        for corner in self
            .triangles
            .iter()
            .flat_map(|triangle| self.corners(*triangle))
        {
            for (axis, coordinate) in corner.into_iter().enumerate() {
                bounds.min[axis] = bounds.min[axis].min(coordinate);
                bounds.max[axis] = bounds.max[axis].max(coordinate);
            }
        }
        Some(bounds)
    }

    /// The sum of the triangles' areas, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.triangles
            .iter()
            .map(|triangle| double_area_normal(self.corners(*triangle)).norm() / 2.0)
            .sum()
    }

    /// The volume inside the surface, cubic metres: positive for a closed surface whose triangles face outward.
    ///
    /// The sum of the signed tetrahedra between a fixed point and each triangle (the divergence theorem). The point
    /// is the first vertex, so that a mesh far from the origin loses no digits. Of a surface that is not closed it
    /// has no meaning.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let Some(first) = self.triangles.first() else {
            return 0.0;
        };
        let origin = Vector3::from(self.vertices[first[0] as usize]);
        self.triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = self
                    .corners(*triangle)
                    .map(|corner| Vector3::from(corner) - origin);
                a.dot(&b.cross(&c)) / 6.0
            })
            .sum()
    }

    /// Applies a 4 by 4 matrix whose last row is 0, 0, 0, 1.
    ///
    /// Where the matrix mirrors (a negative determinant), the triangles are turned round so that they face outward
    /// as before. A scale of 1 and a rotation by 0 leave every coordinate as it was.
    pub fn transform(&mut self, matrix: &Matrix4<f64>) {
        let rows: [[f64; 4]; 3] =
            std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)]));
        for vertex in &mut self.vertices {
            let [x, y, z] = *vertex;
            *vertex = rows.map(|row| row[0] * x + row[1] * y + row[2] * z + row[3]);
        }
        let linear: Matrix3<f64> = matrix.fixed_view::<3, 3>(0, 0).into_owned();
        if linear.determinant() < 0.0 {
            self.flip();
        }
    }

    /// Turns every triangle round.
    pub fn flip(&mut self) {
        for triangle in &mut self.triangles {
            triangle.swap(1, 2);
        }
    }

    /// Appends the vertices and triangles of `other`, in their order.
    ///
    /// # Panics
    /// With more than `u32::MAX` vertices in all.
    pub fn append(&mut self, other: &Self) {
        let offset = u32::try_from(self.vertices.len()).expect("more vertices than u32 can count");
        assert!(
            u32::try_from(self.vertices.len() + other.vertices.len()).is_ok(),
            "more vertices than u32 can count"
        );
        self.vertices.extend_from_slice(&other.vertices);
        self.triangles.extend(
            other
                .triangles
                .iter()
                .map(|triangle| triangle.map(|index| index + offset)),
        );
    }
}

/// The normal of a triangle, twice its area long.
pub(crate) fn double_area_normal(corners: [[f64; 3]; 3]) -> Vector3<f64> {
    let [a, b, c] = corners.map(Vector3::from);
    (b - a).cross(&(c - a))
}
