use super::prelude::*;
use urdd_format::readable::number;

declare_lint! {
    /// Links of different sizes have one mass and one inertia.
    ///
    /// They are defaults that nobody replaced: the robot moves in a simulator, but not as the real one.
    ///
    /// Compute mass and inertia of each link from its geometry.
    LNT004 "same-default-inertia", Info, WrongMotion, since "1.1.0"
}

/// Number of links, and of different sizes: a left and a right twin are no defaults.
const MANY: usize = 3;
/// Links without a mass of their own, such as frames, are written with less than this, kg: their mass is that of others.
const MASSLESS: f64 = 1e-3;
/// A size is another one from this ratio of volumes on.
const APART: f64 = 1.1;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    let mut groups: BTreeMap<[u64; 7], Vec<usize>> = BTreeMap::new();
    for (index, link) in robot.links.iter().enumerate() {
        let inertial = link.inertial.as_ref();
        let numbers = inertial.and_then(|inertial| Some((inertial.mass?, inertial.inertia?)));
        if let Some((mass, [a, b, c, d, e, f])) = numbers
            && mass > MASSLESS
            && [a, b, c, d, e, f] != [0.0; 6]
        {
            let key = [mass, a, b, c, d, e, f].map(f64::to_bits);
            groups.entry(key).or_default().push(index);
        }
    }
    let mut groups: Vec<_> = groups.into_iter().filter(|(_, links)| links.len() >= MANY).collect();
    groups.sort_by_key(|(_, links)| links[0]);
    for (key, links) in groups {
        let hulls = links.iter().filter(|link| !geometry.links[**link].is_partial);
        let hulls = hulls.filter_map(|link| geometry.links[*link].hull());
        let mut volumes: Vec<f64> = hulls.map(|hull| hull.volume).collect();
        volumes.sort_by(f64::total_cmp);
        let mut sizes: Vec<f64> = Vec::new();
        for volume in volumes {
            if sizes.last().is_none_or(|last| volume > APART * last) {
                sizes.push(volume);
            }
        }
        if sizes.len() < MANY {
            continue;
        }
        let [mass, xx, _, _, yy, _, zz] = key.map(f64::from_bits);
        let message = format!(
            "{} links of {} different sizes have {} kg and the moments {} {} {}; compute those of each link",
            links.len(),
            sizes.len(),
            number(mass, 4),
            number(xx, 4),
            number(yy, 4),
            number(zz, 4)
        );
        urdf.at(urdf.inertial(links[0], "inertia"), message).report(findings);
    }
    Some(())
}
