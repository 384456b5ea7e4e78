use super::prelude::*;

declare_lint! {
    /// The visuals and the collisions of a link are the same, but in different places or in different units.
    ///
    /// Boxes around both have the same three lengths to 5 %, and are apart; or one is 10, 25.4, 100 or 1000 times as large as
    /// the other. Contacts then happen where nothing is seen.
    ///
    /// Give both the same `<origin>` and `scale`.
    LNT021 "visual-and-collision-apart", Warning, Collisions, since "1.1.0"
}

/// Lengths are the same to this part.
const SAME: f64 = 0.05;
/// How far the centres may be apart, as a part of the diagonal.
const APART: f64 = 0.2;
/// Ratios of units, and to which part.
const UNITS: [f64; 4] = [10.0, 25.4, 100.0, 1000.0];
const CLOSE: f64 = 0.03;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let geometry = urdf.geometry(findings)?;
    for (index, link) in
        geometry.links.iter().enumerate().filter(|(_, link)| !link.is_partial && !link.is_turned())
    {
        let visual = bounds(link.corners_of(GeometryKind::Visual));
        let collision = bounds(link.corners_of(GeometryKind::Collision));
        let Some(((a, b), (c, d))) = visual.zip(collision) else {
            continue;
        };
        let (visual, collision) = (b - a, d - c);
        let (seen, solid) = (visual.norm(), collision.norm());
        if seen.min(solid) <= 0.0 {
            continue;
        }
        let ratio = seen.max(solid) / seen.min(solid);
        let apart = ((a + b - c - d) / 2.0).norm();
        let message = if is_same(&visual, &collision) && apart > APART * seen.max(solid) {
            format!(
                "visuals and collisions have the same size, but are {} apart; put both in the same place",
                metres(apart)
            )
        } else if UNITS.iter().any(|unit| (ratio / unit - 1.0).abs() < CLOSE) {
            format!(
                "the visuals are {} long and the collisions {}; give both the same scale",
                metres(seen),
                metres(solid)
            )
        } else {
            continue;
        };
        urdf.at(urdf.links[index], message).report(findings);
    }
    Some(())
}

fn is_same(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    let sorted = |lengths: &Vector3<f64>| {
        let mut sorted = [lengths.x, lengths.y, lengths.z];
        sorted.sort_by(f64::total_cmp);
        sorted
    };
    let pairs = sorted(a).into_iter().zip(sorted(b));
    pairs.into_iter().all(|(a, b)| (a - b).abs() <= SAME * a.max(b))
}
