//! A triangle mesh, its measures and transforms.

use nalgebra::{Matrix3, Matrix4, Vector3};

/// A triangle mesh. Lengths in metres.
///
/// A triangle is three indices into `vertices`, counter-clockwise when seen from outside. The methods of this type
/// panic on an index that is out of range; meshes from [`read`](crate::read) have no such index.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions, metres.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// An axis-aligned bounding box: its minimum and maximum corner, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest coordinate along each axis.
    pub min: [f64; 3],
    /// Largest coordinate along each axis.
    pub max: [f64; 3],
}

/// The 4 by 4 matrix that places a URDF mesh element in its link's frame: scale, then rotation, then translation.
///
/// `rotation` is row-major; `translation` is in metres.
#[must_use]
pub fn placement(scale: [f64; 3], rotation: [[f64; 3]; 3], translation: [f64; 3]) -> Matrix4<f64> {
    Matrix4::from_fn(|row, column| match (row, column) {
        (3, 3) => 1.0,
        (3, _) => 0.0,
        (_, 3) => translation[row],
        _ => rotation[row][column] * scale[column],
    })
}

impl Bounds {
    /// The bounds of points; without points, from infinity to minus infinity.
    #[must_use]
    pub fn of(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let mut bounds = Bounds { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
        for point in points {
            for (axis, coordinate) in point.into_iter().enumerate() {
                bounds.min[axis] = bounds.min[axis].min(coordinate);
                bounds.max[axis] = bounds.max[axis].max(coordinate);
            }
        }
        bounds
    }

    /// The lengths along the axes.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.max[axis] - self.min[axis])
    }

    /// The largest length along an axis; 0 without points.
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.size().into_iter().fold(0.0, f64::max)
    }
}

impl Mesh {
    /// The positions of a triangle's vertices.
    #[must_use]
    #[inline]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|index| self.vertices[index as usize])
    }

    /// The axis-aligned bounding box of the triangles; `None` without triangles. Unused vertices do not count.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        let corners = self.triangles.as_flattened().iter();
        let corners = corners.map(|corner| self.vertices[*corner as usize]);
        (!self.triangles.is_empty()).then(|| Bounds::of(corners))
    }

    /// Surface area, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.triangles
            .iter()
            .map(|triangle| double_area_normal(self.corners(*triangle)).norm() / 2.0)
            .sum()
    }

    /// Enclosed volume, cubic metres; positive for a closed surface whose triangles face outward.
    ///
    /// Sums the signed tetrahedra between a fixed point and each triangle (divergence theorem). The fixed point is the
    /// first vertex, so that a mesh far from the origin loses no precision. The result has no meaning for an open
    /// surface.
    #[must_use]
    pub fn signed_volume(&self) -> f64 {
        let Some(first) = self.triangles.first() else {
            return 0.0;
        };
        let origin = Vector3::from(self.vertices[first[0] as usize]);
        self.triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] =
                    self.corners(*triangle).map(|corner| Vector3::from(corner) - origin);
                a.dot(&b.cross(&c)) / 6.0
            })
            .sum()
    }

    /// Applies a 4 by 4 matrix whose last row is 0, 0, 0, 1.
    ///
    /// A mirroring matrix (negative determinant) also flips the triangles, so that they still face outward. The
    /// identity matrix leaves every coordinate unchanged.
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

    /// Reverses the winding of every triangle.
    pub fn flip(&mut self) {
        for triangle in &mut self.triangles {
            triangle.swap(1, 2);
        }
    }

    /// Appends the vertices and triangles of `other`, in order.
    ///
    /// # Panics
    /// If the total number of vertices exceeds `u32::MAX`.
    #[expect(clippy::expect_used, reason = "no mesh that is read has so many vertices")]
    pub fn append(&mut self, other: &Self) {
        let offset = u32::try_from(self.vertices.len()).expect("more vertices than u32 can count");
        assert!(
            u32::try_from(self.vertices.len() + other.vertices.len()).is_ok(),
            "more vertices than u32 can count"
        );
        self.vertices.extend_from_slice(&other.vertices);
        self.triangles
            .extend(other.triangles.iter().map(|triangle| triangle.map(|index| index + offset)));
    }
}

/// The corners of a triangle in the same cyclic order, the lowest first.
pub(crate) fn from_lowest([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The normal of a triangle; its length is twice the area.
pub(crate) fn double_area_normal(corners: [[f64; 3]; 3]) -> Vector3<f64> {
    let [a, b, c] = corners.map(Vector3::from);
    (b - a).cross(&(c - a))
}
