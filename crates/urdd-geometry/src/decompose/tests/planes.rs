use super::*;
use crate::levels::levels;

/// A normal and an offset.
type Plain = ([f64; 3], f64);

/// Planes around the origin at distances of about 1. Some repeat one or eight slots later, so that heights are
/// equal, and every fifth slot is empty.
fn planes(slots: usize) -> (Planes, Vec<Option<Plain>>) {
    let mut plain: Vec<Option<Plain>> = Vec::new();
    let mut planes = Planes::default();
    for i in 0..slots {
        let x = i.saturating_sub([0, 1, 8][i % 3]) as f64;
        let (z, r) = ((1.9 * x).sin(), (1.9 * x).cos());
        let plane = ([r * (2.3 * x).cos(), r * (2.3 * x).sin(), z], 1.0 + 0.1 * (0.7 * x).sin());
        planes.push(plane.0, plane.1);
        plain.push(Some(plane));
    }
    for i in (0..slots).skip(4).step_by(5) {
        planes.clear(i);
        plain[i] = None;
    }
    (planes, plain)
}

#[test]
fn each_instruction_set_sees_what_the_plain_loop_sees() {
    for slots in [1, 3, 7, 8, 9, 16, 23, 100] {
        let (planes, plain) = planes(slots);
        assert_eq!(planes.slots(), slots);
        let height = |p: [f64; 3], i: usize| {
            plain[i].map_or(f64::NEG_INFINITY, |(n, offset)| {
                n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - offset
            })
        };
        for k in 0..200 {
            let x = f64::from(k);
            let p = [(1.1 * x).sin(), (0.7 * x).cos(), (0.3 * x).sin()].map(|c| 1.3 * c);
            let heights: Vec<f64> = (0..slots).map(|i| height(p, i)).collect();
            let most = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let first = heights.iter().position(|h| *h == most).unwrap_or(0);
            let seen: Vec<u32> = (0..slots as u32).filter(|i| heights[*i as usize] > 0.0).collect();
            for level in levels() {
                assert_eq!(planes.highest(level, p), (first as u32, most), "{level:?} {slots}");
                let mut found = Above::default();
                for limit in [1e-3, most, f64::MAX] {
                    let above = planes.above(level, p, limit, &mut found);
                    assert_eq!(above, most > limit, "{level:?} {slots}");
                    if above {
                        assert_eq!(found.slots, seen, "{level:?} {slots}");
                        assert_eq!(found.heights[..slots], heights, "{level:?} {slots}");
                    }
                }
            }
        }
    }
}
