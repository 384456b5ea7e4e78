//! Chooses the margins of the pairs.

use urdd_learned::train::calibration::*;
use urdd_learned::train::labels::Labels;

/// Outputs of contacts with exponentially distributed excess, in closed form.
fn exponential(count: usize) -> Vec<f64> {
    let value = |k: usize| -((k as f64 + 0.5) / count as f64).ln();
    (0..count).map(value).collect()
}

/// Labels of one pair: first the colliding configurations, then the free ones.
fn of_one_pair(colliding: usize, free: usize) -> Labels {
    let collides = (0..colliding + free).map(|k| k < colliding);
    let collides: Vec<bool> = collides.collect();
    let distance = |collides: &bool| if *collides { 0.0 } else { 1.0 };
    Labels {
        configurations: Vec::new(),
        num_dofs: 1,
        distances: collides.iter().map(distance).collect(),
        num_pairs: 1,
        collides,
    }
}

#[test]
fn a_tail_is_followed_beyond_the_highest_contact() {
    let contacts = exponential(1000);
    let first = levels(&contacts, 1.0, 1.0)[0];
    // So high that FIRST_MISSES of 1,000 contacts are above: ln(1000 / 0.02) = 10.8.
    assert!((first.margin - 10.8).abs() < 1.0, "{first:?}");
    assert!(first.margin > contacts[0]);
}

#[test]
fn margins_fall_while_few_collisions_are_missed() {
    let contacts = exponential(1000);
    // 200 free configurations among the highest contacts, and 10 among the others.
    let free = (0..200).map(|k| 6.0 + 0.02 * k as f64).chain([1.0; 10]);
    let outputs: Vec<f64> = contacts.into_iter().chain(free).collect();
    let labels = of_one_pair(1000, 210);
    let margin = margins(&outputs, &labels, 1.0)[0];
    // 0.5 % of 1,000 is 5: the margin is ln(1000 / 5) = 5.3, or higher if a lower one clears no more.
    assert!((5.0..6.0).contains(&margin), "{margin}");
}

#[test]
fn of_few_contacts_none_is_given_up() {
    let outputs = [1.0, 0.5, 3.0];
    let labels = of_one_pair(2, 1);
    assert_eq!(margins(&outputs, &labels, 1.0), [1.1]);
}
