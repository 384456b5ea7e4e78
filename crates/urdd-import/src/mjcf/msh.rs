//! MuJoCo's own mesh files: four counts (vertices, normals, places in textures, faces), then these.

use urdd_geometry::Mesh;

/// Reads a mesh, or says what is wrong with it.
pub fn read(bytes: &[u8]) -> Result<Mesh, &'static str> {
    let (words, rest_of_word) = bytes.as_chunks::<4>();
    let head: Option<&[[u8; 4]; 4]> = words.first_chunk();
    let counts = head.ok_or("has no header of an MSH file")?.map(i32::from_le_bytes);
    let counts = counts.map(|count| usize::try_from(count).ok());
    let [Some(vertices), Some(normals), Some(places), Some(faces)] = counts else {
        return Err("has a negative count in its MSH file");
    };
    let sizes = [(vertices, 3), (normals, 3), (places, 2), (faces, 3)];
    // In a browser, a product of these is more than a `usize` has.
    let length: u64 = sizes.iter().map(|(count, each)| *count as u64 * each).sum();
    if words.len() as u64 != 4 + length || !rest_of_word.is_empty() || vertices < 4 {
        return Err("is of another length than its MSH file says");
    }
    let (coordinates, rest) = words[4..].split_at(vertices * 3);
    let indices = &rest[normals * 3 + places * 2..];
    let points = coordinates.as_chunks().0.iter();
    let points = points.map(|point: &[[u8; 4]; 3]| point.map(|x| f64::from(f32::from_le_bytes(x))));
    let triangles = indices.as_chunks().0.iter();
    let triangles: Vec<[u32; 3]> =
        triangles.map(|face: &[[u8; 4]; 3]| face.map(u32::from_le_bytes)).collect();
    let mesh = Mesh { vertices: points.collect(), triangles };
    if mesh.triangles.as_flattened().iter().any(|index| *index as usize >= vertices) {
        return Err("has a face of a vertex that its MSH file does not have");
    }
    if !mesh.vertices.as_flattened().iter().all(|x| x.is_finite()) {
        return Err("has a vertex that is not finite");
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_the_length() {
        let file = |counts: [i32; 4], words: usize| -> Vec<u8> {
            let body = vec![0; 4 * words];
            counts.iter().flat_map(|count| count.to_le_bytes()).chain(body).collect()
        };
        assert!(read(&file([4, 0, 0, 1], 15)).is_ok());
        for (counts, words) in [
            ([4, 0, 0, 1], 14),
            ([4, 0, 0, i32::MAX], 15),
            // Three times that is 2 more than 32 bits have.
            ([0x5555_5556, 0, 0, 0], 2),
            ([0x5555_5556, 0x5555_5556, 0, 1], 7),
            ([-1, 0, 0, 0], 0),
        ] {
            assert!(read(&file(counts, words)).is_err(), "{counts:?}");
        }
    }

    #[test]
    fn faces_are_of_vertices_that_are_there_and_finite() {
        let with = |place: usize, word: u32| {
            let mut words = [4, 0, 0, 1].into_iter().chain([0; 15]).collect::<Vec<u32>>();
            words[4 + place] = word;
            read(&words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>())
        };
        assert!(with(14, 3).is_ok() && with(11, 1.0_f32.to_bits()).is_ok());
        assert!(with(14, 4).is_err() && with(14, u32::MAX).is_err());
        assert!(with(11, f32::NAN.to_bits()).is_err() && with(0, f32::INFINITY.to_bits()).is_err());
    }
}
