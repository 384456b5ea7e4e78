//! What queries need of pairs of shapes: of the robot's own, and of the robot and obstacles.

use super::error::RobotError;
use super::proximity::{Proximity, SweptPair, to_root, witnesses};
use super::workspace::{Placed, Workspace};
use arrayvec::ArrayVec;
use urdd_geometry::convex::across::AT_ONCE;
use urdd_kinematics::Travel;

/// Pairs that can be checked in a configuration and along a motion.
pub trait Checked: Sync {
    /// What an answer says of a pair.
    type Pair;
    /// Configurations in one block of work: so few take no longer than starting threads.
    const BLOCK: usize;
    /// The robot's shapes.
    fn shapes(&self) -> &Proximity;
    /// Number of pairs that are tested.
    fn count(&self) -> usize;
    /// Whether a pair has an answer of its own in lists of all pairs. Otherwise, it counts for the pair before.
    fn is_first(&self, _: usize) -> bool {
        true
    }
    /// Number of pairs with an answer of their own.
    fn num_answers(&self) -> usize {
        self.count()
    }
    /// The pairs that can come within a margin (m) or leave it, each with its place in `rates`.
    fn within(&self, margin: f64) -> impl Iterator<Item = (usize, usize)>;
    /// A lower bound of the distance of a pair, m; not positive if it may touch.
    fn bound(&self, placed: &Placed, pair: usize) -> f64;
    /// Number of groups of pairs. Each pair is in one group.
    fn num_groups(&self) -> usize;
    /// A lower bound of those of all pairs of a group, m.
    fn group_bound(&self, placed: &Placed, group: usize) -> f64;
    /// Whether all pairs of a group are certainly farther apart than `distance`, m.
    fn is_group_beyond(&self, placed: &Placed, group: usize, distance: f64) -> bool {
        self.group_bound(placed, group) > distance
    }
    /// The pairs of a group.
    fn members(&self, group: usize) -> impl Iterator<Item = usize>;
    /// Whether a margin (m) counts for the pairs of a group.
    fn counts(&self, _group: usize, _margin: f64) -> bool {
        true
    }
    /// Whether a pair is certainly farther apart than `distance`, m.
    fn is_beyond(&self, placed: &Placed, pair: usize, distance: f64) -> bool {
        self.bound(placed, pair) > distance
    }
    /// The distances of some pairs, at most [`AT_ONCE`], m.
    fn values(&self, placed: &Placed, pairs: &[usize], values: &mut [f64]);
    /// Whether any pair touches or overlaps.
    fn touches(&self, placed: &Placed) -> bool;
    /// The two shapes, in the frame of the first one's link.
    fn swept(&self, placed: &Placed, pair: usize) -> SweptPair<'_>;
    /// The links of the two; none for an obstacle.
    fn links(&self, pair: usize) -> (usize, Option<usize>);
    /// What an answer says of a pair at this distance, with these closest points.
    fn found(
        &self,
        placed: &Placed,
        pair: usize,
        distance: f64,
        points: [[f64; 3]; 2],
    ) -> Self::Pair;
    /// Bounds on how far pairs move toward each other, m.
    fn rates(&self, travel: &Travel) -> Vec<f64>;
    /// The farthest that a point of a shape travels, m.
    fn farthest(&self, travel: &Travel) -> f64;
}

/// A margin, m: finite, and not negative.
///
/// # Errors
/// If it is not.
pub fn check_margin(margin: f64) -> Result<f64, RobotError> {
    match margin.is_finite() && margin >= 0.0 {
        true => Ok(margin),
        false => Err(RobotError::Setting("a margin is finite, and not below 0 m")),
    }
}

/// Whether any pair is at most `margin` apart, m. Stops at the first such pairs.
pub(super) fn any_within(checked: &impl Checked, placed: &Placed, margin: f64) -> bool {
    if margin == 0.0 {
        return checked.touches(placed);
    }
    let near = |group: &usize| {
        checked.counts(*group, margin) && !checked.is_group_beyond(placed, *group, margin)
    };
    let groups = (0..checked.num_groups()).filter(near);
    let pairs = groups.flat_map(|group| checked.members(group));
    at_most(checked, placed, pairs, margin).next().is_some()
}

/// Those of some pairs that are at most `margin` apart, m, in their order.
pub(super) fn at_most<'c>(
    checked: &'c impl Checked,
    placed: &'c Placed,
    pairs: impl Iterator<Item = usize> + 'c,
    margin: f64,
) -> impl Iterator<Item = usize> + 'c {
    let mut near = pairs.filter(move |pair| !checked.is_beyond(placed, *pair, margin));
    let some = move || {
        let pairs: ArrayVec<_, AT_ONCE> = near.by_ref().take(AT_ONCE).collect();
        let mut values = [f64::INFINITY; AT_ONCE];
        checked.values(placed, &pairs, &mut values[..pairs.len()]);
        (!pairs.is_empty()).then(|| pairs.into_iter().zip(values))
    };
    let found = std::iter::from_fn(some).flatten();
    found.filter(move |(_, value)| *value <= margin).map(|(pair, _)| pair)
}

/// The distances and indices of the `k` nearest pairs, nearest first.
pub(super) fn least<'a>(
    checked: &impl Checked,
    configuration: &[f64],
    k: usize,
    workspace: &'a mut Workspace,
) -> Result<&'a [(f64, usize)], RobotError> {
    let Workspace { placed, least, .. } = workspace;
    checked.shapes().place(configuration, placed)?;
    let groups = (0..checked.num_groups()).map(|group| checked.group_bound(placed, group));
    let members = |group: usize, each: &mut dyn FnMut(f64, usize)| {
        checked.members(group).for_each(|pair| each(checked.bound(placed, pair), pair));
    };
    let values = |pairs: &[usize], values: &mut [f64]| checked.values(placed, pairs, values);
    Ok(least.of((checked.count(), k), groups, members, values))
}

/// Calls `each` with some pairs, their distances (m), and their closest points in the root link's frame.
pub(super) fn closest(
    checked: &impl Checked,
    placed: &Placed,
    pairs: impl IntoIterator<Item = usize>,
    mut each: impl FnMut(usize, f64, [[f64; 3]; 2]),
) {
    let mut pairs = pairs.into_iter().peekable();
    while pairs.peek().is_some() {
        let some: ArrayVec<_, AT_ONCE> = pairs.by_ref().take(AT_ONCE).collect();
        let swept = some.iter().map(|pair| checked.swept(placed, *pair));
        let swept: ArrayVec<_, AT_ONCE> = swept.collect();
        for (pair, (distance, points)) in some.iter().zip(witnesses(checked.shapes().level, &swept))
        {
            let link = &placed.links[checked.links(*pair).0];
            each(*pair, distance, points.map(|p| to_root(link, p)));
        }
    }
}
