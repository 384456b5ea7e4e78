//! Masses and inertias of bodies, in their links' frames.

use urdd_document::robot::{Inertial, Origin};
use urdd_export::inertia::{self, Mass, Odd};

fn of(mass: f64, [xx, yy, zz]: [f64; 3]) -> (Option<Mass>, Option<Odd>) {
    let inertial = Inertial {
        origin: Origin { rpy: [0.3, -0.2, 0.9], ..Origin::default() },
        mass: Some(mass),
        inertia: Some([xx, 0.0, 0.0, yy, 0.0, zz]),
    };
    inertia::mass(&inertial)
}

#[test]
fn the_mass_stays_whatever_the_inertia() {
    for (moments, enough, note) in [
        ([1.0, 1.0, 2.0], true, None),
        ([1.0, 1.0, 1.5], true, None),
        ([0.0, 0.0, 0.0], false, None),
        ([0.0, 2.0, 2.0], false, None),
        ([1.0, 1.0, 2.1], true, Some(Odd::Triangle)),
        ([1.0, 1.0, -1.0], false, Some(Odd::Indefinite)),
    ] {
        let (mass, said) = of(0.2, moments);
        let mut mass = mass.expect("a mass");
        assert_eq!((mass.mass, said), (0.2, note), "{moments:?}");
        assert_eq!(mass.is_enough(), enough, "{moments:?}");
        assert!((mass.axes.matrix().determinant() - 1.0).abs() < 1e-12);
        mass.raise();
        assert!(mass.is_enough() && mass.mass == 0.2, "{moments:?}");
    }
    assert_eq!(of(0.0, [0.0; 3]), (None, None));
    assert_eq!(of(-1.0, [0.0; 3]), (None, Some(Odd::Negative)));
    // A disc: after rounding, the largest moment does not exceed the sum of the other two.
    let (disc, _) = of(1.0, [0.1, 0.2, 0.1 + 0.2]);
    let mut moments: [f64; 3] = disc.expect("a mass").moments.into();
    moments.sort_by(f64::total_cmp);
    assert!(moments[0] + moments[1] >= moments[2]);
}
