//! Meshes without faces: MuJoCo takes the hull of their points.

use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;

use urdd_source::sniff::lines;

/// A mesh with its triangles; of points alone, those of their hull. None if they have none.
pub fn with_faces(mesh: Mesh) -> Option<Mesh> {
    match mesh.triangles.is_empty() {
        false => Some(mesh),
        true => Some(ConvexHull::new(&mesh.vertices).ok()?.into_mesh()),
    }
}

/// The points of an OBJ that has no faces, in 32 bits as MuJoCo keeps them.
pub fn of_obj(bytes: &[u8]) -> Option<Vec<[f64; 3]>> {
    // Most have faces, behind their points: of these no number is read.
    let is_face = |line: &[u8]| {
        let mut words = line.split(u8::is_ascii_whitespace);
        words.find(|word| !word.is_empty()) == Some(&b"f"[..]) && std::str::from_utf8(line).is_ok()
    };
    if lines(bytes).any(is_face) {
        return None;
    }
    let mut points = Vec::new();
    for line in lines(bytes) {
        let Ok(line) = std::str::from_utf8(line) else { continue };
        let mut words = line.split_ascii_whitespace();
        if words.next() == Some("v") {
            let mut point = [0.0; 3];
            for coordinate in &mut point {
                *coordinate = f64::from(words.next()?.parse::<f32>().ok()?);
            }
            points.push(point);
        }
    }
    let is_finite = points.as_flattened().iter().all(|x| x.is_finite());
    (is_finite && !points.is_empty()).then_some(points)
}
