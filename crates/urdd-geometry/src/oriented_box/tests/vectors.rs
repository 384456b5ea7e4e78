use super::*;
use crate::levels::levels;

#[test]
fn each_instruction_set_finds_what_the_plain_loop_finds() {
    // On a coarse grid, so that many dot products equal each other or the limits.
    let vectors = |count: u32, shift: f64| -> Vec<Vector3<f64>> {
        (0..count)
            .map(|i| f64::from(i) + shift)
            .map(|x| Vector3::new((1.7 * x).sin(), (2.3 * x).cos(), (0.9 * x).sin()))
            .map(|v| v.map(|x| (4.0 * x).round() / 4.0))
            .collect()
    };
    for (count, num_axes) in [(1, 1), (2, 8), (7, 3), (8, 5), (9, 8), (100, 7)] {
        let (list, axes) = (vectors(count, 1.0), vectors(num_axes, 0.5));
        for level in levels() {
            let [low, high] = reach(level, &list, &Axes::new(&axes));
            for (a, axis) in axes.iter().enumerate() {
                let dot = |v: &Vector3<f64>| axis.x * v.x + axis.y * v.y + axis.z * v.z;
                let dots = || list.iter().map(dot);
                let plain = [
                    dots().fold(f64::INFINITY, f64::min),
                    dots().fold(f64::NEG_INFINITY, f64::max),
                ];
                assert_eq!([low[a], high[a]], plain, "{level:?} {count} {a}");
                let mut found = Vec::new();
                for limit in [0.0, 0.25, plain[1]] {
                    beyond(level, &list, &Axes::new(&axes), limit, &mut found);
                    let found = found.iter().map(|bits| bits >> a & 1 == 1);
                    let plain = dots().map(|d| d > limit);
                    assert!(found.eq(plain), "{level:?} {count} {a} {limit}");
                }
            }
        }
    }
}
