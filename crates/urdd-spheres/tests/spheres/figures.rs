//! How far spheres are from pieces, compared with closed forms.

use crate::cuboid;
use urdd_directory::account::{Account, AccountError};
use urdd_directory::cancellation::Cancellation;
use urdd_format::link_shapes_spheres::SphereFit;
use urdd_spheres::model::Sphere;
use urdd_spheres::surface::Pieces;

fn fit(pieces: &Pieces, spheres: &[Sphere]) -> SphereFit {
    pieces.fit(spheres, &Account::default()).expect("within the account")
}

#[test]
fn a_sphere_around_a_cube_stands_off_by_what_its_points_are_beyond_the_faces() {
    let pieces = Pieces::new(&[cuboid([-1.0; 3], [1.0; 3])]).expect("pieces");
    let radius = 3f64.sqrt();
    let found = fit(&pieces, &[Sphere { centre: [0.0; 3], radius }]);
    // The points of SPEC 8.9.5, and the distance from a cube, written again.
    let mut all = Vec::new();
    for k in 0..64u32 {
        let z = 1.0 - f64::from(2 * k + 1) / 64.0;
        let turn = f64::from(k) * 0.618_033_988_749_894_9;
        let angle = (turn - turn.floor()) * 2.0 * std::f64::consts::PI;
        let s = (1.0 - z * z).sqrt();
        let point = [radius * s * angle.cos(), radius * s * angle.sin(), radius * z];
        let beyond = point.map(|x| (x.abs() - 1.0).max(0.0));
        all.push(beyond.iter().map(|x| x * x).sum::<f64>().sqrt());
    }
    let most = all.iter().copied().fold(0.0, f64::max);
    assert!((found.max_standoff - most).abs() < 1e-9);
    assert!((found.mean_standoff - all.iter().sum::<f64>() / 64.0).abs() < 1e-9);
    // Over a face, the sphere is sqrt 3 - 1 off.
    assert!(most <= radius - 1.0 && most > 0.9 * (radius - 1.0));
    assert_eq!([found.uncovered_fraction, found.max_uncovered], [0.0, 0.0]);
}

#[test]
fn half_of_a_long_bar_is_uncovered() {
    let pieces = Pieces::new(&[cuboid([-2.0, -0.1, -0.1], [2.0, 0.1, 0.1])]).expect("pieces");
    let found = fit(&pieces, &[Sphere { centre: [-1.0, 0.0, 0.0], radius: 1.01 }]);
    // From x = 0.01 less what the sphere bends back, to 2: half of the long sides, and one end.
    assert!((found.uncovered_fraction - 0.5).abs() < 0.03, "{}", found.uncovered_fraction);
    // The farthest centroids are next to the corners of that end.
    let corner = (3.0f64 * 3.0 + 2.0 * 0.01).sqrt() - 1.01;
    assert!(found.max_uncovered < corner && found.max_uncovered > corner - 0.02);
}

#[test]
fn what_is_within_another_sphere_or_piece_does_not_count() {
    let halves = [cuboid([-1.0; 3], [0.2, 1.0, 1.0]), cuboid([-0.2, -1.0, -1.0], [1.0; 3])];
    let (halves, whole) = (
        Pieces::new(&halves).expect("pieces"),
        Pieces::new(&[cuboid([-1.0; 3], [1.0; 3])]).expect("pieces"),
    );
    let own = Sphere { centre: [0.0; 3], radius: 1.5 };
    let inner = Sphere { centre: [0.1, 0.0, 0.0], radius: 0.5 };
    let [two, one] = [&halves, &whole].map(|of| fit(of, &[own]));
    // The standoff is from both together; faces within the other half are no surface.
    assert!((two.max_standoff - one.max_standoff).abs() < 1e-9);
    assert!((two.uncovered_fraction - one.uncovered_fraction).abs() < 0.01);
    // The corners of a face beyond a circle of the radius sqrt 1.25, by its integral; the corner itself is 0.232 m off.
    assert!((one.uncovered_fraction - 0.0978).abs() < 0.012, "{}", one.uncovered_fraction);
    assert!(one.max_uncovered > 0.1 && one.max_uncovered < 0.233);
    // A sphere within another changes nothing.
    assert_eq!(fit(&whole, &[own, inner]), one);
}

#[test]
fn very_many_spheres_end_where_it_is_cancelled() {
    let pieces = Pieces::new(&[cuboid([-1.0; 3], [1.0; 3])]).expect("pieces");
    let cancellation = Cancellation::default();
    cancellation.cancel();
    let spheres = vec![Sphere { centre: [0.0; 3], radius: 1.0 }; 65_536];
    let found = pieces.fit(&spheres, &Account::new(&cancellation));
    assert!(matches!(found, Err(AccountError::Cancelled(_))));
}

/// Each point of each of them is compared with all others: 64 times the square of their number.
#[test]
fn spheres_around_the_same_points_are_charged_and_equal_ones_are_looked_at_once() {
    let pieces = Pieces::new(&[cuboid([-1.0; 3], [1.0; 3])]).expect("pieces");
    let one = Sphere { centre: [0.0; 3], radius: 1.0 };
    let two = fit(&pieces, &[one]);
    let many = fit(&pieces, &vec![one; 20_000]);
    assert_eq!(many.max_standoff, two.max_standoff);
    assert_eq!(many.max_uncovered, two.max_uncovered);
    assert!((many.mean_standoff - two.mean_standoff).abs() < 1e-9);
    // So little aside of each other that none holds a point of another.
    let aside = |k: u32| Sphere { centre: [1e-11 * f64::from(k), 0.0, 0.0], radius: 1.0 };
    let near: Vec<Sphere> = (0..5000).map(aside).collect();
    let found = pieces.fit(&near, &Account::default());
    assert!(matches!(found, Err(AccountError::Overdrawn(_))), "{found:?}");
    // As many as people have are no cost: of a point, few are looked at.
    let spread = |k: u32| {
        let [x, y, z] = [k % 20, k / 20 % 20, k / 400].map(|k| f64::from(k) / 10.0 - 1.0);
        Sphere { centre: [x, y, z], radius: 0.08 }
    };
    let spread: Vec<Sphere> = (0..8000).map(spread).collect();
    fit(&pieces, &spread);
}
