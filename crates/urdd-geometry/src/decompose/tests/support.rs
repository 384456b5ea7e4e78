use super::*;
use crate::levels::levels;

#[test]
fn each_instruction_set_finds_what_the_plain_loop_finds() {
    for count in [1, 2, 5, 16, 33, 400] {
        // On a coarse grid, so that many are equally far, also in directions with a zero coordinate.
        let candidates: Vec<Candidate> = (0..count)
            .map(|i| {
                let x = f64::from(i);
                let p = [(1.7 * x).sin(), (2.3 * x).cos(), (0.9 * x).sin()];
                Candidate::new(p.map(|c| (4.0 * c).round() / 4.0), 7 * i)
            })
            .collect();
        let d = &*DIRECTIONS;
        let mut plain = [[0; WIDTH]; ROWS];
        for (k, found) in plain.as_flattened_mut().iter_mut().enumerate() {
            let d = d.each_ref().map(|row| row.as_flattened()[k]);
            let along = |c: &Candidate| c.at[0] * d[0] + c.at[1] * d[1] + c.at[2] * d[2];
            let most = candidates.iter().map(along).fold(f32::NEG_INFINITY, f32::max);
            let first = candidates.iter().find(|c| along(c) == most);
            *found = first.expect("one").index;
        }
        for level in levels() {
            assert_eq!(farthest_at(level, &candidates), plain, "{level:?} {count}");
        }
    }
}
