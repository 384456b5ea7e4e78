use super::*;
use crate::levels::levels;

#[test]
fn each_instruction_set_finds_what_walking_finds() {
    for n in [3, 4, 6, 7, 8, 9, 12, 31, 40, 63, 64] {
        for turn in 0..20 {
            // On an ellipse, so that opposite edges of even polygons are parallel up to rounding, and unrotated
            // rectangles and hexagons have edges at right angles. Every fourth polygon has a corner that turns
            // right.
            let turned = 0.3 * f64::from(turn / 2);
            let mut polygon: Vec<Point2> = (0..n)
                .map(|k| (2.0 * f64::from(k) + 1.0) * std::f64::consts::PI / f64::from(n))
                .map(|angle| [2.0 * (angle + turned).cos(), (angle + turned).sin()])
                .collect();
            if turn % 4 == 3 {
                polygon[1] = polygon[1].map(|x| 0.2 * x);
            }
            if turn % 2 == 1 {
                let on_grid = |x: f64| (16.0 * x).round() / 16.0;
                polygon = polygon.iter().map(|p| p.map(on_grid)).collect();
            }
            polygon.push(polygon[0]);
            let plain = one_by_one(&polygon);
            for level in levels() {
                assert_eq!(at_once(level, &polygon), plain, "{level:?} {n} {turn}");
            }
        }
    }
}
