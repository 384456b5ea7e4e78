use super::*;

#[test]
fn an_octahedron_has_one_candidate_away_from_the_planes_of_symmetry() {
    // The direction's largest coordinate determines the farthest vertex: +z in the middle of the map.
    let points = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let lists = candidates(&points, 16);
    assert_eq!(lists[7 * 16 + 7], [4]);
    // Row u from 0.875 to 1, column v from 0 to 0.125: x is largest.
    assert_eq!(lists[15 * 16 + 8], [0]);
    assert_eq!(lists[15 * 16 + 15], [5]);
    assert!(lists.iter().all(|list| !list.is_empty() && list.len() <= 3));
}
