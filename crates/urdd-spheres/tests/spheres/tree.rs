//! Trees over spheres, compared with each sphere looked at.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdd_directory::account::{Account, AccountError};
use urdd_spheres::frame::{Point, Pose, norm, sub};
use urdd_spheres::judge::touching;
use urdd_spheres::model::{Placeable, Placed, Sphere, Spheres};
use urdd_spheres::samples::Sample;
use urdd_spheres::tree::SphereTree;

/// Numbers that look random, of a linear congruence.
struct Dice(u64);

fn fraction(dice: &mut Dice) -> f64 {
    dice.0 = dice.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (dice.0 >> 40) as f64 / f64::from(1 << 24)
}

fn spheres(dice: &mut Dice, count: usize) -> Vec<Sphere> {
    let one = |_| {
        let centre = [0; 3].map(|_| 2.0 * fraction(dice) - 1.0);
        Sphere { centre, radius: 0.3 * fraction(dice).powi(3) + 1e-3 }
    };
    let mut all: Vec<Sphere> = (0..count).map(one).collect();
    // Some of them twice.
    all.extend(all.clone().iter().step_by(3));
    all
}

#[test]
fn the_nearest_and_one_that_holds_a_point_are_those_of_all() {
    let mut dice = Dice(7);
    for count in [0, 1, 8, 9, 300] {
        let all = spheres(&mut dice, count);
        let tree = SphereTree::new(&all);
        let own = Sphere { centre: [9.0; 3], radius: 1.0 };
        for _ in 0..200 {
            let point: Point = [0; 3].map(|_| 2.4 * fraction(&mut dice) - 1.2);
            let away = |one: &Sphere| norm(sub(point, one.centre)) - one.radius;
            let least = all.iter().map(away).fold(f64::INFINITY, f64::min);
            let (found, steps) = tree.distance(point);
            assert_eq!(found.to_bits(), least.to_bits());
            assert!(count < 300 || steps < count, "{steps}");
            let is_held = |own: &Sphere| {
                let mut others = all.iter().filter(|one| *one != own);
                others.any(|one| norm(sub(point, one.centre)) < 0.99 * one.radius)
            };
            assert_eq!(tree.holds(point, 0.99, &own).0, is_held(&own));
            for own in all.iter().take(5) {
                assert_eq!(tree.holds(point, 0.99, own).0, is_held(own));
            }
        }
    }
}

fn pose(dice: &mut Dice, far: f64) -> Pose {
    let [x, y, z, a, b, c] = [0; 6].map(|_| fraction(dice));
    let turn = UnitQuaternion::from_euler_angles(6.0 * a, 6.0 * b, 6.0 * c);
    Pose::from(&Isometry3::from_parts(Translation3::new(far * x, far * y, far * z), turn))
}

#[test]
fn links_touch_where_two_of_their_spheres_do() {
    let mut dice = Dice(11);
    let mut seen = [0, 0];
    for count in [1, 20, 200] {
        let all: Spheres = vec![spheres(&mut dice, count), spheres(&mut dice, 2 * count)];
        let model = Placeable::new(&all);
        let mut placed = Placed::default();
        for _ in 0..300 {
            let poses = vec![pose(&mut dice, 0.0), pose(&mut dice, 2.5)];
            let sample = Sample { poses, touching: Vec::new() };
            let touch = all[0].iter().any(|a| {
                let p = sample.poses[0].place(a.centre);
                let apart = |b: &Sphere| norm(sub(p, sample.poses[1].place(b.centre)));
                all[1].iter().any(|b| apart(b) < a.radius + b.radius)
            });
            model.place(&sample, &mut placed);
            assert_eq!(model.touches(&sample, &placed, [0, 1]).0, touch);
            seen[usize::from(touch)] += 1;
        }
    }
    assert!(seen[0] > 50 && seen[1] > 50, "{seen:?}");
}

/// Two lines of spheres beside each other, along the diagonal of all boxes around them: each is near each.
#[test]
fn spheres_of_two_links_that_are_all_near_each_other_are_charged() {
    let line = |count: u32, aside: f64| -> Vec<Sphere> {
        let one = |k: u32| Sphere { centre: [aside, 0.0, 1e-9 * f64::from(k)], radius: 0.1 };
        (0..count).map(one).collect()
    };
    let still = Sample { poses: vec![Pose::from(&Isometry3::identity()); 2], touching: Vec::new() };
    let samples = vec![still; 10];
    let found = |count: u32, account: &Account| {
        let both = vec![line(count, 0.0), line(count, 0.200_000_000_01)];
        touching(&both, &[[0, 1]], &samples, account)
    };
    assert_eq!(found(50, &Account::default()).expect("little work"), vec![Vec::<u32>::new(); 10]);
    let costly = found(6000, &Account::default()).expect_err("36 million pairs ten times");
    assert_eq!((costly.links, costly.error.to_string().contains("memory or work")), ([0, 1], true));
    assert!(matches!(costly.error, AccountError::Overdrawn(_)));
    // Where they touch, one pair is enough.
    let both = vec![line(6000, 0.0), line(6000, 0.1)];
    let found = touching(&both, &[[0, 1]], &samples, &Account::default()).expect("little work");
    assert_eq!(found, vec![vec![0]; 10]);
}
