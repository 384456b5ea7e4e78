//! Compares spheres with the exact shapes: missed collisions and false contacts.

use urdd_spheres::judge::*;
use urdd_spheres::samples::Sample;

fn samples(collide: &[bool]) -> Vec<Sample> {
    let one = |collides: &bool| Sample {
        poses: Vec::new(),
        touching: Vec::from_iter(collides.then_some(0)),
    };
    collide.iter().map(one).collect()
}

#[test]
fn radii_grow_until_the_rates_are_in_balance() {
    // Free ones from 1 mm on, collisions up to 3 mm: in between, each millimetre costs both rates equally, relative
    // to their goals.
    let mut collide = vec![false];
    let mut gaps = vec![0.009];
    for k in 0..100 {
        collide.push(true);
        gaps.push(-0.007 + 1e-4 * f64::from(k));
        collide.push(false);
        gaps.push(0.00105 + 1e-4 * f64::from(k));
    }
    let grown = growth(&samples(&collide), &gaps, 0.02);
    let after: Vec<f64> = gaps.iter().map(|gap| gap - 2.0 * grown).collect();
    let rates = rates(&samples(&collide), &after);
    assert_eq!([rates.missed, rates.colliding, rates.free], [1, 100, 101]);
    // From SciPy's intervals, over all thresholds.
    assert_eq!(rates.false_contacts, 18);
    // Without collisions, or without free configurations, there is nothing to balance.
    assert_eq!(growth(&samples(&[false, false]), &[-0.01, 0.01], 0.02), 0.0);
}
