//! Shapes whose best decomposition is known: its volume, or its distance from the surface, by closed forms.

use urdd_geometry::Mesh;
use urdd_geometry::decompose::{Settings, decompose};

use crate::decompose::{check, exact, prism, push_box, ring, turned, volume};

fn within(most: usize) -> Settings {
    Settings { max_pieces: most, ..exact() }
}

/// The summed volume of the pieces over that of the solid.
fn fullness(pieces: &[Mesh], solid: f64) -> f64 {
    pieces.iter().map(volume).sum::<f64>() / solid
}

/// A comb of boxes that touch: a back and teeth, 1 wide with gaps of 1, centimetres.
fn comb(teeth: u32) -> (Mesh, f64) {
    let wide = 0.01 * f64::from(2 * teeth - 1);
    let mut outline = vec![[0.0, 0.0], [wide, 0.0]];
    let mut ears = Vec::new();
    // From the right: each tooth as four corners, the two at its foot in the line of the back's edge.
    for k in (0..teeth).rev() {
        let [left, right] = [0.02 * f64::from(k), 0.02 * f64::from(k) + 0.01];
        let at = outline.len() as u32;
        outline.extend([[right, 0.02], [right, 0.07], [left, 0.07], [left, 0.02]]);
        ears.extend([[at, at + 1, at + 2], [at, at + 2, at + 3]]);
    }
    // The back: a fan about its lower left corner.
    let last = outline.len() as u32 - 1;
    ears.push([0, 1, 2]);
    ears.extend((2..last).filter(|k| (k - 2) % 4 != 1 && (k - 2) % 4 != 2).map(|k| {
        let next = if (k - 2) % 4 == 0 { k + 3 } else { k + 1 };
        [0, k, next]
    }));
    let solid = 0.03 * (wide * 0.02 + f64::from(teeth) * 0.01 * 0.05);
    (prism(&outline, &ears, 0.03), solid)
}

#[test]
fn a_comb_is_a_back_and_its_teeth() {
    for (teeth, most) in [(5, 7), (12, 20)] {
        let (mesh, solid) = comb(teeth);
        assert!((volume(&mesh) / solid - 1.0).abs() < 1e-9, "the test's own mesh");
        let pieces = check(&mesh, &within(most));
        assert!(pieces.len() > teeth as usize);
        let fullness = fullness(&pieces, solid);
        assert!((fullness - 1.0).abs() < 1e-3, "{teeth}: {fullness}");
    }
}

/// A square box without a lid, turned about z: the outer and inner half sides, the height, the thickness of the floor.
fn box_cup([outer, inner, height, floor]: [f64; 4], angle: f64) -> (Mesh, f64) {
    // A square of circumradius R has the half side R / sqrt 2, and its sides across the diagonals.
    let [r, s] = [outer, inner].map(|half| half * 2.0_f64.sqrt());
    let profile = [[0.0, 0.0], [r, 0.0], [r, height], [s, height], [s, floor], [0.0, floor]];
    let mut cup = turned(&profile, 4);
    let (sin, cos) = (angle + std::f64::consts::FRAC_PI_4).sin_cos();
    for v in &mut cup.vertices {
        *v = [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
    }
    let solid = 4.0 * outer * outer * height - 4.0 * inner * inner * (height - floor);
    (cup, solid)
}

#[test]
fn a_cup_is_a_floor_and_four_walls() {
    for shape in [[0.07, 0.056, 0.15, 0.02], [0.1, 0.098, 0.15, 0.002], [0.03, 0.029, 0.2, 0.001]] {
        for angle in [0.0, std::f64::consts::FRAC_PI_4, 0.3] {
            let (mut cup, solid) = box_cup(shape, angle);
            assert!((volume(&cup).abs() / solid - 1.0).abs() < 1e-9, "the test's own mesh");
            // Triangles in either winding.
            for _ in 0..2 {
                let pieces = check(&cup, &within(7));
                let fullness = fullness(&pieces, solid);
                let what = format!("{shape:?} {angle}: {} pieces, {fullness}", pieces.len());
                assert!(pieces.len() >= 5, "{what}");
                assert!((fullness - 1.0).abs() < 5e-3, "{what}");
                cup.triangles.iter_mut().for_each(|t| t.swap(1, 2));
            }
        }
    }
}

#[test]
fn a_ring_of_seven_pieces_stands_off_by_little() {
    let (middle, tube) = (0.1_f64, 0.02_f64);
    let pieces = check(&turned(&ring(middle, tube, 16), 48), &Settings::default());
    // The chord of a fifth of the inner circle; seven equal parts have 7.9 mm.
    let most = (middle - tube) * (1.0 - (std::f64::consts::PI / 5.0).cos());
    for piece in &pieces {
        for t in &piece.triangles {
            let [a, b, c] = t.map(|i| piece.vertices[i as usize]);
            let p = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
            let off = (p[0].hypot(p[1]) - middle).hypot(p[2]) - tube;
            assert!(off < most, "{p:?} is {off} off, more than {most}");
        }
    }
}

/// A file's coordinates are rounded, so the flat underside of an arm is not quite flat.
#[test]
fn a_face_that_rounding_bends_is_cut_along() {
    for bend in [0.0, 2e-7, -2e-7] {
        let mut t = Mesh::default();
        push_box(&mut t, [-0.02, -0.02, 0.0], [0.02, 0.02, 0.1]);
        push_box(&mut t, [-0.1, -0.02, 0.1], [0.1, 0.02, 0.14]);
        // One lower corner of the arm.
        t.vertices[8][2] += bend;
        let solid = 0.04 * 0.04 * 0.1 + 0.2 * 0.04 * 0.04;
        let pieces = check(&t, &within(4));
        let fullness = fullness(&pieces, solid);
        assert!((fullness - 1.0).abs() < 1e-3, "{fullness} with {bend}");
    }
}

#[test]
fn no_more_pieces_than_a_standoff_needs() {
    let (mesh, _) = comb(12);
    let count = |standoff_tolerance: f64| {
        let settings = Settings { standoff_tolerance, ..within(20) };
        decompose(&mesh, &settings).pieces.len()
    };
    // One piece has lids of 1 cm over the gaps. They are on average 2.5 mm from the surface where they are open, as are
    // two sides. A tolerance of 1 cm accepts that in any case, and 1 um needs every tooth.
    assert_eq!(count(0.01), 1);
    assert!(count(1e-6) >= 13);
    let some = count(3e-4);
    assert!(1 < some && some < 13, "{some}");
}
