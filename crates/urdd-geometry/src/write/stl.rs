//! Binary STL.

use super::super::mesh::double_area_normal;
use super::super::read::Part;
use super::{WriteError, checked, single};

/// Must not start with "solid": some readers would take the file for ASCII STL.
const HEADER: &[u8] = b"binary STL, metres";

/// Writes all parts as one binary STL. Normals are computed from the triangles; 0 for a triangle without area.
///
/// # Errors
/// [`WriteError`] if there are no triangles, or if a part is invalid.
pub fn stl(parts: &[Part]) -> Result<Vec<u8>, WriteError> {
    let parts = checked(parts, "STL")?;
    let count: usize = parts.iter().map(|part| part.mesh.triangles.len()).sum();
    let mut bytes = Vec::with_capacity(84 + 50 * count);
    bytes.extend_from_slice(HEADER);
    bytes.resize(80, 0);
    bytes.extend(u32::try_from(count).map_err(|_| WriteError::TooLarge("STL"))?.to_le_bytes());
    for part in parts {
        for triangle in &part.mesh.triangles {
            let corners = triangle.map(|index| single(part.mesh.vertices[index as usize]));
            let normal = double_area_normal(corners.map(|corner| corner.map(f64::from)));
            let normal = normal.try_normalize(0.0).unwrap_or_default();
            for number in
                [single(normal.into()), corners[0], corners[1], corners[2]].into_iter().flatten()
            {
                bytes.extend(number.to_le_bytes());
            }
            bytes.extend([0, 0]);
        }
    }
    Ok(bytes)
}
