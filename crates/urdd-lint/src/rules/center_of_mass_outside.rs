use super::prelude::*;
use urdd_findings::finding::point;

declare_lint! {
    /// The centre of mass of a link is outside of its shapes.
    ///
    /// No mass inside the convex hull of the shapes has its centre there. Gravity then turns the joints before the link otherwise
    /// than on the robot, and a legged robot falls. Common causes: a sign, millimetres, the frame of the CAD assembly, a missing
    /// `<origin>`.
    ///
    /// Write the centre of mass in the link's frame, in metres, as the `<origin>` of `<inertial>`.
    LNT002 "centre-of-mass-outside", Warning, WrongMotion, since "1.1.0"
}

/// How far outside is taken for a rough model: a part of the body's size, and m.
const PART: f64 = 0.1;
const MARGIN: f64 = 0.005;
/// Frames with a token mass do no harm, kg.
const LIGHT: f64 = 0.01;
/// A denser body than this, kg/m³, has parts that its shapes leave out.
const DENSE: f64 = 4000.0;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, bodies) = urdf.bodies(findings)?;
    let geometry = urdf.geometry(findings)?;
    if !urdf.moves() {
        return Some(());
    }
    // A body at a time: it has one hull.
    let mut order: Vec<usize> = (0..robot.links.len()).collect();
    order.sort_by_key(|link| bodies.top[*link]);
    let mut last = None;
    let mut found = BTreeMap::new();
    for index in order {
        let (link, top) = (&robot.links[index], bodies.top[index]);
        let body = &geometry.bodies.get(&top).filter(|body| !body.is_partial && !body.is_turned());
        let Some((inertial, body)) = Inertial::of(link).zip(*body) else {
            continue;
        };
        let has_shapes = !link.visual.is_empty() || !link.collision.is_empty();
        if !has_shapes || inertial.mass <= LIGHT {
            continue;
        }
        let (_, hull) =
            last.take().filter(|(of, _)| *of == top).unwrap_or_else(|| (top, body.hull()));
        let (_, Some(hull)) = last.insert((top, hull)) else { continue };
        let points = body.in_frame(&bodies.pose[index]);
        let size = diagonal(points);
        let center = bodies.pose[index].transform_point(&Point3::from(inertial.center));
        let beyond = hull.outside(&center.coords);
        if inertial.mass > DENSE * hull.volume || beyond <= PART * size + MARGIN {
            continue;
        }
        let message = format!(
            "the centre of mass is {} outside of the link's shapes, which are {} long; write it in the link's frame, in metres",
            metres(beyond),
            metres(size)
        );
        let node = urdf.inertial(index, "origin");
        let center = point(inertial.center.into());
        found.insert(index, urdf.at(node, message).actual(center).off_by(beyond, "m"));
    }
    found.into_values().for_each(|finding| finding.report(findings));
    Some(())
}
