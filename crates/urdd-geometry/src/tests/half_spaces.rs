use super::*;
use crate::levels::levels;

#[test]
fn each_instruction_set_finds_what_the_plain_loop_finds() {
    for count in [1, 3, 7, 8, 9, 20, 64] {
        // Every third one repeats the one eight before, so that distances are equal.
        let list: Vec<HalfSpace> = (0..count)
            .map(|i: usize| if i.is_multiple_of(3) { i.saturating_sub(8) } else { i })
            .map(|i| {
                let x = i as f64;
                let (z, r) = ((1.9 * x).sin(), (1.9 * x).cos());
                HalfSpace {
                    normal: [r * (2.3 * x).cos(), r * (2.3 * x).sin(), z],
                    offset: 1.0,
                    slack: if i.is_multiple_of(2) { 1e-3 } else { 0.3 },
                }
            })
            .collect();
        let mut all = HalfSpaces::new(&list).expect("one");
        assert_eq!(all.len(), count);
        for k in 0..300 {
            let x = f64::from(k);
            let p = [(1.1 * x).sin(), (0.7 * x).cos(), (0.3 * x).sin()].map(|c| 1.1 * c);
            let along =
                |h: &HalfSpace| h.normal[0] * p[0] + h.normal[1] * p[1] + h.normal[2] * p[2];
            let heights = || list.iter().map(|h| (along(h) - h.offset, h.slack));
            let beyond = heights().filter(|(height, slack)| height > slack);
            let beyond = beyond.map(|(height, _)| height).fold(f64::NEG_INFINITY, f64::max);
            let depths = list.iter().map(|h| h.offset - along(h));
            let depth = depths.fold(f64::INFINITY, f64::min);
            for level in levels() {
                all.level = level;
                assert_eq!(all.beyond(p), beyond, "{level:?} {count} {k}");
                assert_eq!(all.depth(p), depth, "{level:?} {count} {k}");
                for (distance, resolution) in [(0.0, 0.1), (0.2, 0.1), (-depth, 0.0), (-depth, 1.0)]
                {
                    let within =
                        |(height, slack): (f64, f64)| height <= distance.max(slack.min(resolution));
                    let hold = all.hold(p, distance, resolution);
                    assert_eq!(hold, heights().all(within), "{level:?} {count} {k}");
                }
            }
        }
    }
}
