//! A triangle mesh: its measures, its transforms, and its cleaning by rounding, welding, and removal of degenerate or unused
//! elements.
//!
//! All operations are deterministic and keep the order of the remaining elements.

use nalgebra::{Matrix3, Matrix4, Vector3};

use crate::vector::normal;

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
    pub fn size(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.max[axis] - self.min[axis])
    }

    /// The largest length along an axis; 0 without points.
    pub fn extent(&self) -> f64 {
        self.size().into_iter().fold(0.0, f64::max)
    }
}

impl Mesh {
    /// The positions of a triangle's vertices.
    #[inline]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|index| self.vertices[index as usize])
    }

    /// The axis-aligned bounding box of the triangles; `None` without triangles. Unused vertices do not count.
    pub fn bounds(&self) -> Option<Bounds> {
        let corners = self.triangles.as_flattened().iter();
        let corners = corners.map(|corner| self.vertices[*corner as usize]);
        (!self.triangles.is_empty()).then(|| Bounds::of(corners))
    }

    /// Surface area, square metres.
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
    pub fn signed_volume(&self) -> f64 {
        let Some(first) = self.triangles.first() else { return 0.0 };
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
    normal(corners).into()
}

impl Mesh {
    /// Rounds every coordinate to the nearest binary32, and -0 to 0. Returns how many triangles were dropped because a
    /// corner has no finite binary32 value.
    pub fn round_to_f32(&mut self) -> usize {
        for coordinate in self.vertices.iter_mut().flatten() {
            let rounded = *coordinate as f32;
            // Adding 0 turns -0 into 0 and leaves other values unchanged.
            *coordinate = f64::from(rounded) + 0.0;
        }
        self.drop_non_finite()
    }

    /// Drops triangles with a non-finite corner; returns how many. If a coordinate is not finite, also drops all unused
    /// vertices.
    pub fn drop_non_finite(&mut self) -> usize {
        if self.vertices.iter().flatten().all(|coordinate| coordinate.is_finite()) {
            return 0;
        }
        let before = self.triangles.len();
        let vertices = &self.vertices;
        self.triangles.retain(|triangle| {
            triangle.iter().all(|index| {
                vertices[*index as usize].iter().all(|coordinate| coordinate.is_finite())
            })
        });
        self.drop_unused_vertices();
        before - self.triangles.len()
    }

    /// Merges vertices at the same position into the first of them. 0 and -0 are equal; no tolerance applies.
    ///
    /// Returns how many vertices were removed. Triangles stay, even if they become degenerate.
    pub fn weld(&mut self) -> usize {
        let before = self.vertices.len();
        let (kept, index_of) = welded(&self.vertices, |vertex| Some(vertex.map(|x| x + 0.0)));
        self.vertices = kept;
        for triangle in &mut self.triangles {
            *triangle = triangle.map(|index| index_of[index as usize]);
        }
        before - self.vertices.len()
    }

    /// Drops triangles without area, which have coincident or collinear corners; returns how many.
    ///
    /// The area is computed from the stored coordinates in binary64 and compared with exactly 0, so a thin triangle
    /// stays. After [`round_to_f32`](Self::round_to_f32) two corners are either equal or distinct.
    pub fn drop_degenerate(&mut self) -> usize {
        let before = self.triangles.len();
        let vertices = &self.vertices;
        self.triangles.retain(|triangle| {
            let [a, b, c] = triangle.map(|index| vertices[index as usize]);
            a != b && b != c && c != a && double_area_normal([a, b, c]).norm_squared() > 0.0
        });
        before - self.triangles.len()
    }

    /// Drops vertices that no triangle uses; returns how many. The order of the others is kept.
    pub fn drop_unused_vertices(&mut self) -> usize {
        let mut used = vec![false; self.vertices.len()];
        for index in self.triangles.iter().flatten() {
            used[*index as usize] = true;
        }
        let mut index_of = vec![0_u32; self.vertices.len()];
        let mut next = 0_u32;
        for (new, used) in index_of.iter_mut().zip(&used) {
            *new = next;
            next += u32::from(*used);
        }
        let before = self.vertices.len();
        let mut flags = used.iter();
        self.vertices.retain(|_| *flags.next().unwrap_or(&false));
        for triangle in &mut self.triangles {
            *triangle = triangle.map(|index| index_of[index as usize]);
        }
        before - self.vertices.len()
    }
}

/// The distinct positions in order of first use, and the index of each given point among them: `u32::MAX` if `place` gives
/// it no position. Uses open addressing: the standard map with its secure hash takes three times as long.
pub(crate) fn welded(
    given: &[[f64; 3]],
    place: impl Fn([f64; 3]) -> Option<[f64; 3]>,
) -> (Vec<[f64; 3]>, Vec<u32>) {
    const FREE: u32 = u32::MAX;
    let mut slots = vec![FREE; (given.len() * 2).next_power_of_two().max(2)];
    let mask = slots.len() - 1;
    let mut kept: Vec<[f64; 3]> = Vec::with_capacity(given.len());
    let index_of = |point: &[f64; 3]| {
        let Some(place) = place(*point) else { return FREE };
        let mut slot = hash(place) & mask;
        loop {
            match slots[slot] {
                FREE => {
                    // A mesh has at most `u32::MAX` vertices.
                    slots[slot] = u32::try_from(kept.len()).unwrap_or(FREE);
                    kept.push(place);
                    return slots[slot];
                }
                index if kept[index as usize].map(f64::to_bits) == place.map(f64::to_bits) => {
                    return index;
                }
                _ => slot = (slot + 1) & mask,
            }
        }
    };
    let index = given.iter().map(index_of).collect();
    (kept, index)
}

/// Mixes the bits of three coordinates (the finalizer of MurmurHash3 after each).
fn hash(place: [f64; 3]) -> usize {
    let mut mixed = 0_u64;
    for coordinate in place {
        mixed = (mixed ^ coordinate.to_bits()).wrapping_mul(0xff51_afd7_ed55_8ccd);
        mixed ^= mixed >> 33;
        mixed = mixed.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        mixed ^= mixed >> 33;
    }
    mixed as usize
}
