//! Checks by spheres: the answers of a closed form, of brute force and of Rust, and an error for what a caller does wrong.

use std::path::Path;
use std::ptr::{null, null_mut};

use testkit::robots::made_bars;
use urdd_c::*;
use urdd_robot::EdgeSettings;
use urdd_robot::spheres::{ApproximateAnswer as Approximate, CoveringAnswer as Covered};

use crate::interface::{c, fails, ok};
use crate::loops;

/// Three bars: link 0 is fixed, link 1 turns about (0.3, 0), link 2 about the end of it, 0.5 m away.
fn bars(folder: &Path, modules: &[&str]) -> (*mut Robot, urdd_robot::Robot) {
    let path = made_bars(folder, modules);
    let mut robot = null_mut();
    let name = c(path.to_str().expect("UTF-8"));
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_open(name.as_ptr(), &mut robot) });
    (robot, urdd_robot::Robot::open(&path).expect("a robot"))
}

const BASE: f64 = 0.2;
const TIP: f64 = 0.05;

/// A sphere at the origin, and one at the tip, 0.4 m along the last bar, after coarser ones around them.
fn spheres() -> [LinkSphere; 4] {
    let sphere = |level, link, x, radius| LinkSphere { level, link, centre: [x, 0.0, 0.0], radius };
    [
        sphere(0, 0, 0.0, 0.3),
        sphere(0, 2, 0.35, 0.2),
        sphere(1, 2, 0.4, TIP),
        sphere(1, 0, 0.0, BASE),
    ]
}

const PAIR: LinkPair = LinkPair { links: [2, 0] };

fn tip(q: &[f64]) -> [f64; 3] {
    let (first, both) = (q[0], q[0] + q[1]);
    [0.3 + 0.5 * first.cos() + 0.4 * both.cos(), 0.5 * first.sin() + 0.4 * both.sin(), 0.0]
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    [0, 1, 2].map(|k| (a[k] - b[k]).powi(2)).iter().sum::<f64>().sqrt()
}

/// Configurations that are no nearer to a contact than what is rounded.
fn rows(count: usize, distance: impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let mut found = Vec::new();
    let mut numbers = [0.1f64, 0.2];
    while found.len() < 2 * count {
        numbers = [(numbers[0] + 0.7548777).fract(), (numbers[1] + 0.5698403).fract()];
        let q = numbers.map(|number| 6.0 * number - 3.0);
        if distance(&q).abs() > 1e-5 {
            found.extend(q);
        }
    }
    found
}

/// Holds both answers of each row to the distances of the spheres.
#[track_caller]
unsafe fn hold(
    (covering, near): (*const CoveringChecker, *const ApproximatingChecker),
    margin: f64,
    q: &[f64],
    distance: impl Fn(&[f64]) -> f64,
) {
    let count = q.len() / 2;
    let mut covered = vec![CoveringAnswer::Maybe; count];
    let mut approximate = vec![ApproximateAnswer::Contact; count];
    let at = q.as_ptr();
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_covering_checker_is_within(covering, at, count, 2, margin, covered.as_mut_ptr()));
        let out = approximate.as_mut_ptr();
        ok(urdd_approximating_checker_is_within(near, at, count, 2, margin, out));
    }
    let mut touching = 0;
    for ((q, covered), approximate) in q.chunks(2).zip(&covered).zip(&approximate) {
        let touches = distance(q) <= margin;
        touching += usize::from(touches);
        assert_eq!(*covered == CoveringAnswer::Maybe, touches, "{q:?}: {}", distance(q));
        assert_eq!(*approximate == ApproximateAnswer::Contact, touches, "{q:?}: {}", distance(q));
    }
    assert!(touching * 20 > count && (count - touching) * 20 > count, "{touching} of {count}");
    // One row at a time.
    for (k, q) in q.chunks(2).enumerate().take(40) {
        let (mut one, mut other) = (CoveringAnswer::Maybe, ApproximateAnswer::Contact);
        let at = q.as_ptr();
        // SAFETY: as above.
        unsafe {
            match margin {
                0.0 => {
                    ok(urdd_covering_checker_in_collision(covering, at, 1, 2, &mut one));
                    ok(urdd_approximating_checker_in_collision(near, at, 1, 2, &mut other));
                }
                _ => {
                    ok(urdd_covering_checker_is_within(covering, at, 1, 2, margin, &mut one));
                    ok(urdd_approximating_checker_is_within(near, at, 1, 2, margin, &mut other));
                }
            }
        }
        assert_eq!((one, other), (covered[k], approximate[k]));
    }
}

#[test]
fn given_spheres_touch_where_their_distances_say_so_also_among_obstacles() {
    let folder = testkit::temporary::folder();
    let (robot, _) = bars(folder.path(), &["core"]);
    let (spheres, pairs) = (spheres(), [PAIR]);
    let (mut covering, mut near) = (null_mut(), null_mut());
    let own = |q: &[f64]| apart(tip(q), [0.0; 3]) - BASE - TIP;
    // SAFETY: as the header says.
    unsafe {
        let (at, of) = (spheres.as_ptr(), pairs.as_ptr());
        ok(urdd_robot_covering_checker_of(robot, at, 4, of, 1, &mut covering));
        ok(urdd_robot_approximating_checker_of(robot, at, 4, of, 1, &mut near));
        ok(urdd_robot_free(robot));
        let mut dofs = [0, 0];
        ok(urdd_covering_checker_num_dofs(covering, &mut dofs[0]));
        ok(urdd_approximating_checker_num_dofs(near, &mut dofs[1]));
        assert_eq!(dofs, [2, 2]);
        hold((covering, near), 0.0, &rows(1000, own), own);
        hold((covering, near), 0.1, &rows(1000, |q| own(q) - 0.1), own);

        // A cloud of points about the tip's way, and a field of heights that it goes over.
        let points: Vec<[f64; 3]> = (0..300)
            .map(|k| [0.7548777, 0.5698403, 0.4301597].map(|step| (f64::from(k) * step).fract()))
            .map(|[x, y, z]| [0.6 + 0.6 * x, 0.6 * y, 0.04 * z - 0.02])
            .collect();
        let heights: Vec<f64> = (0..12).map(|k| if k % 3 == 1 { 0.02 } else { -0.1 }).collect();
        let (cell, thickness) = ([0.2, 0.3], 0.05);
        let place = [1., 0., 0., -0.5, 0., 1., 0., -0.6, 0., 0., 1., 0., 0., 0., 0., 1.];
        let (mut cloud, mut field) = (null_mut(), null_mut());
        let at = points.as_ptr().cast();
        ok(urdd_obstacle_points(c"cloud".as_ptr(), null(), at, 300, 0.02, &mut cloud));
        let (name, at) = (c"field".as_ptr(), heights.as_ptr());
        let pose = place.as_ptr();
        ok(urdd_obstacle_height_field(name, pose, at, 4, 3, cell.as_ptr(), thickness, &mut field));
        let to_cloud = |q: &[f64], by: f64| {
            let p = tip(q);
            let each = points.iter().map(|[x, y, z]| apart(p, [x + by, *y, *z]) - 0.02 - TIP);
            each.fold(f64::INFINITY, f64::min)
        };
        let to_field = |q: &[f64]| {
            let p = tip(q);
            let each = heights.iter().enumerate().map(|(k, height)| {
                let middle = [
                    -0.5 + (k % 3) as f64 * cell[0],
                    -0.6 + (k / 3) as f64 * cell[1],
                    height - thickness / 2.0,
                ];
                let half = [cell[0] / 2.0, cell[1] / 2.0, thickness / 2.0];
                let away = [0, 1, 2].map(|k| ((p[k] - middle[k]).abs() - half[k]).max(0.0));
                apart(away, [0.0; 3]) - TIP
            });
            each.fold(f64::INFINITY, f64::min)
        };
        let all = |q: &[f64], by: f64| own(q).min(to_cloud(q, by)).min(to_field(q));
        // The sphere at the origin may touch them.
        let [mut of_tip, mut field_of_tip] = [null_mut(); 2];
        ok(urdd_obstacle_ignoring(cloud, c"a".as_ptr(), &mut of_tip));
        ok(urdd_obstacle_ignoring(field, c"a".as_ptr(), &mut field_of_tip));
        let obstacles = [of_tip.cast_const(), field_of_tip.cast_const()];
        let (mut around, mut near_around) = (null_mut(), null_mut());
        ok(urdd_covering_checker_around(covering, obstacles.as_ptr(), 2, &mut around));
        ok(urdd_approximating_checker_around(near, obstacles.as_ptr(), 2, &mut near_around));
        for obstacle in [cloud, field, of_tip, field_of_tip] {
            ok(urdd_obstacle_free(obstacle));
        }
        let q = rows(1000, |q| all(q, 0.0));
        hold((around, near_around), 0.0, &q, |q| all(q, 0.0));
        assert!(q.chunks(2).filter(|q| to_cloud(q, 0.0) < 0.0 && to_field(q) > 0.0).count() > 20);
        assert!(q.chunks(2).filter(|q| to_field(q) < 0.0 && to_cloud(q, 0.0) > 0.0).count() > 20);
        // The cloud moves; the checkers without obstacles stay.
        let place = [1., 0., 0., -0.9, 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
        ok(urdd_covering_checker_move_obstacles(around, 0, place.as_ptr(), 1));
        ok(urdd_approximating_checker_move_obstacles(near_around, 0, place.as_ptr(), 1));
        hold((around, near_around), 0.0, &rows(1000, |q| all(q, -0.9)), |q| all(q, -0.9));
        hold((covering, near), 0.0, &rows(100, own), own);
        ok(urdd_covering_checker_free(covering));
        ok(urdd_covering_checker_free(around));
        ok(urdd_approximating_checker_free(near));
        ok(urdd_approximating_checker_free(near_around));
    }
}

#[test]
fn the_first_contact_of_a_motion_is_where_the_law_of_cosines_says() {
    let folder = testkit::temporary::folder();
    let (robot, _) = bars(folder.path(), &["core"]);
    let (spheres, pairs) = (spheres(), [PAIR]);
    let mut near = null_mut();
    // The last bar folds back over the others: the tip is sqrt(0.8 + 0.64 cos) from the origin.
    let (margin, end) = (0.3, 3.0);
    let touching = ((0.55f64.powi(2) - 0.8) / 0.64).acos() / end;
    let (starts, ends) = ([0.0, 0.0].repeat(70), [0.0, end, 0.0, 0.5].repeat(35));
    // SAFETY: as the header says.
    unsafe {
        let (at, of) = (spheres.as_ptr(), pairs.as_ptr());
        ok(urdd_robot_approximating_checker_of(robot, at, 4, of, 1, &mut near));
        let (mut blocked, mut contacts) = (vec![0.0; 70], vec![0.0; 140]);
        let (start, end) = (starts.as_ptr(), ends.as_ptr());
        let out = blocked.as_mut_ptr();
        let edge = urdd_approximating_checker_blocked_edge;
        ok(edge(near, start, end, 70, 2, margin, 0.01, false, out));
        let out = contacts.as_mut_ptr();
        let first = urdd_approximating_checker_first_contact;
        ok(first(near, start, end, 70, 2, margin, 0.01, false, out, 140));
        for (k, (blocked, contact)) in blocked.iter().zip(contacts.chunks(2)).enumerate() {
            if k % 2 == 1 {
                assert!(blocked.is_nan() && contact.iter().all(|part| part.is_nan()));
                continue;
            }
            // The tip travels more than a metre: 4096 parts of 100 and more.
            assert!(contact[0] <= touching + 1e-6 && touching <= contact[1] + 1e-6, "{contact:?}");
            assert!(contact[1] - contact[0] < 2.5e-6, "{contact:?} {touching}");
            assert!(*blocked >= contact[1], "{blocked}");
        }
        let (mut one, mut two) = (0.0, [0.0; 2]);
        ok(edge(near, start, end, 1, 2, margin, 0.01, false, &mut one));
        ok(first(near, start, end, 1, 2, margin, 0.01, false, two.as_mut_ptr(), 2));
        assert_eq!((one, two.as_slice()), (blocked[0], &contacts[..2]));
        ok(urdd_approximating_checker_free(near));
        ok(urdd_robot_free(robot));
    }
}

#[test]
fn the_spheres_of_a_urdd_answer_as_in_rust() {
    const ROWS: usize = 600;
    let folder = testkit::temporary::folder();
    let (robot, known) = bars(folder.path(), &["all", "spheres"]);
    let space = known.configurations().expect("configurations");
    let q: Vec<f64> = (0..=ROWS as u64).flat_map(|k| space.random(k)).collect();
    let (from, to) = (&q[..2 * ROWS], &q[2..]);
    let settings = EdgeSettings { margin: 0.01, resolution: Some(0.02), open_loops: true };
    let fixed = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    let on = urdd_directory::cancellation::Cancellation::default();
    macro_rules! compare {
        ($checker:expr, $none:expr, $make:ident, $in_collision:ident, $edge:ident, $first:ident, $free:ident, $is_free:expr) => {
            let (checker, mut made) = ($checker.expect("a checker"), null_mut());
            // SAFETY: as the header says.
            unsafe {
                ok($make(robot, &mut made));
                let mut answers = vec![$none; ROWS];
                ok($in_collision(made, from.as_ptr(), ROWS, 2, answers.as_mut_ptr()));
                let expected = checker.in_collision_batch(from).expect("answers");
                let free = answers.iter().map(|answer| *answer != $none);
                assert!(free.clone().eq(expected.iter().map(|answer| *answer == $is_free)));
                let count = free.filter(|free| *free).count();
                assert!(count > 20 && count < ROWS - 20, "{count}");
                let (mut blocked, mut expected) = (vec![0.0; ROWS], vec![0.0; ROWS]);
                let (start, end, out) = (from.as_ptr(), to.as_ptr(), blocked.as_mut_ptr());
                ok($edge(made, start, end, ROWS, 2, 0.01, 0.02, true, out));
                let edges =
                    checker.blocked_edge_batch_into([from, to], &settings, &on, &mut expected);
                edges.expect("parts");
                assert_eq!(fixed(&blocked), fixed(&expected));
                let (mut contacts, mut expected) = (vec![0.0; 2 * ROWS], vec![0.0; 2 * ROWS]);
                let out = contacts.as_mut_ptr();
                ok($first(made, start, end, ROWS, 2, 0.01, 0.02, true, out, 2 * ROWS));
                let edges =
                    checker.first_contact_batch_into([from, to], &settings, &on, &mut expected);
                edges.expect("parts");
                assert_eq!(fixed(&contacts), fixed(&expected));
                ok($free(made));
            }
        };
    }
    compare!(
        known.covering_checker(),
        CoveringAnswer::Maybe,
        urdd_robot_covering_checker,
        urdd_covering_checker_in_collision,
        urdd_covering_checker_blocked_edge,
        urdd_covering_checker_first_contact,
        urdd_covering_checker_free,
        Covered::Free
    );
    compare!(
        known.approximating_checker(),
        ApproximateAnswer::Contact,
        urdd_robot_approximating_checker,
        urdd_approximating_checker_in_collision,
        urdd_approximating_checker_blocked_edge,
        urdd_approximating_checker_first_contact,
        urdd_approximating_checker_free,
        Approximate::Free
    );
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_free(robot) });
}

#[test]
fn loops_are_open_on_a_motion_of_spheres_or_it_is_an_error() {
    let (robot, _) = loops::open();
    let (mut made, mut blocked) = (null_mut(), 0.0);
    let sphere = |link| LinkSphere { level: 0, link, centre: [0.0; 3], radius: 0.001 };
    let (spheres, pair) = ([sphere(0), sphere(1)], LinkPair { links: [0, 1] });
    let (start, end) = ([0.0; 3], [0.1; 3]);
    // SAFETY: as the header says.
    unsafe {
        ok(urdd_robot_covering_checker_of(robot, spheres.as_ptr(), 2, &pair, 1, &mut made));
        let mut ask = |open_loops| {
            let (start, end) = (start.as_ptr(), end.as_ptr());
            let edge = urdd_covering_checker_blocked_edge;
            edge(made, start, end, 1, 3, 0.0, 0.01, open_loops, &mut blocked)
        };
        fails(ask(false), Status::Value, "loops stay closed");
        ok(ask(true));
        ok(urdd_covering_checker_free(made));
        ok(urdd_robot_free(robot));
    }
}

#[test]
fn what_a_caller_does_wrong_with_spheres_is_a_status_with_a_text() {
    let folder = testkit::temporary::folder();
    let (robot, _) = bars(folder.path(), &["all"]);
    let (good, mut made) = (spheres(), null_mut());
    // SAFETY: every mistake is one that the header says is found.
    unsafe {
        let gone = urdd_robot_covering_checker(robot, &mut made);
        fails(gone, Status::MissingModule, "link_shapes_spheres_module");
        assert!(made.is_null());
        let mut other = null_mut();
        let gone = urdd_robot_approximating_checker(robot, &mut other);
        fails(gone, Status::MissingModule, "link_shapes_spheres_module");
        let mut of = |spheres: &[LinkSphere], pairs: &[LinkPair]| {
            let status = urdd_robot_covering_checker_of(
                robot,
                spheres.as_ptr(),
                spheres.len(),
                pairs.as_ptr(),
                pairs.len(),
                &mut made,
            );
            assert_eq!(made.is_null(), status != Status::Ok);
            ok(urdd_covering_checker_free(made));
            status
        };
        ok(of(&good, &[PAIR, PAIR]));
        let with = |change: &dyn Fn(&mut LinkSphere)| {
            let mut changed = good;
            change(&mut changed[3]);
            changed
        };
        for radius in [f64::NAN, 0.0, -1.0, f64::INFINITY, 2e9] {
            let bad = with(&|of| of.radius = radius);
            fails(of(&bad, &[PAIR]), Status::Value, "sphere 0 of link 0: its radius");
        }
        let far = with(&|of| of.centre[1] = f64::NAN);
        fails(of(&far, &[PAIR]), Status::Value, "its centre is not finite");
        let link = with(&|of| of.link = 9);
        fails(of(&link, &[PAIR]), Status::OutOfRange, "link 9 is out of range");
        let gap = with(&|of| of.level = usize::MAX);
        fails(of(&gap, &[PAIR]), Status::Value, "leave no level out");
        fails(of(&[], &[PAIR]), Status::Value, "no level of spheres");
        fails(of(&good, &[LinkPair { links: [2, 2] }]), Status::Value, "two links");
        fails(of(&good, &[LinkPair { links: [2, 9] }]), Status::OutOfRange, "link 9");
        let (at, pair) = (good.as_ptr(), PAIR);
        let huge = urdd_robot_covering_checker_of(robot, at, usize::MAX, &pair, 1, &mut made);
        fails(huge, Status::Length, "more than any memory");
        let huge = urdd_robot_covering_checker_of(robot, at, 4, &pair, usize::MAX, &mut made);
        fails(huge, Status::Length, "more than any memory");

        ok(urdd_robot_covering_checker_of(robot, at, 4, &pair, 1, &mut made));
        let mut answer = CoveringAnswer::Free;
        let mut ask = |q: [f64; 2], margin, dofs| {
            answer = CoveringAnswer::Free;
            let status =
                urdd_covering_checker_is_within(made, q.as_ptr(), 1, dofs, margin, &mut answer);
            // After an error no answer says that it is free.
            assert_eq!(status == Status::Ok, answer == CoveringAnswer::Free, "{q:?}");
            status
        };
        ok(ask([0.0, 0.0], 0.1, 2));
        fails(ask([f64::NAN, 0.0], 0.0, 2), Status::Value, "value 0 of the configuration");
        fails(ask([0.0, 2e9], 0.0, 2), Status::Value, "1e9");
        fails(ask([0.0, 0.0], -1.0, 2), Status::Value, "margin");
        fails(ask([0.0, 0.0], f64::NAN, 2), Status::Value, "margin");
        let q = [0.0, 0.0, 1.0, 1.0];
        let short = urdd_covering_checker_in_collision(made, q.as_ptr(), 1, 3, &mut answer);
        fails(short, Status::Length, "expected 2");
        let none = urdd_covering_checker_in_collision(made, q.as_ptr(), 1, 2, null_mut());
        fails(none, Status::Pointer, "`answers` is null");
        let edge = |margin, resolution, end: f64| {
            let (ends, mut blocked) = ([0.0, end], 0.0);
            let (start, end, out) = (q.as_ptr(), ends.as_ptr(), &mut blocked);
            urdd_covering_checker_blocked_edge(
                made, start, end, 1, 2, margin, resolution, false, out,
            )
        };
        ok(edge(0.0, 0.1, 1.0));
        fails(edge(0.0, 0.0, 1.0), Status::Value, "give a resolution");
        fails(edge(0.0, -0.1, 1.0), Status::Value, "resolution");
        fails(edge(-0.1, 0.1, 1.0), Status::Value, "margin");
        fails(edge(0.0, 1e-9, 1.0), Status::Value, "steps");

        let (mut obstacle, point) = (null_mut(), [0.5, 0.0, 0.0]);
        let mut cloud = |points: *const f64, count, radius| {
            let name = c"cloud".as_ptr();
            let status = urdd_obstacle_points(name, null(), points, count, radius, &mut obstacle);
            assert_eq!(obstacle.is_null(), status != Status::Ok);
            ok(urdd_obstacle_free(obstacle));
            status
        };
        ok(cloud(point.as_ptr(), 1, 0.0));
        for radius in [f64::NAN, -1.0, f64::INFINITY, 2e9] {
            fails(cloud(point.as_ptr(), 1, radius), Status::Value, "obstacle `cloud`");
        }
        fails(cloud([0.0, f64::NAN, 0.0].as_ptr(), 1, 0.1), Status::Value, "obstacle `cloud`");
        fails(cloud(null(), 0, 0.1), Status::Value, "obstacle `cloud`");
        fails(cloud(null(), 1, 0.1), Status::Pointer, "`points` is null");
        fails(cloud(point.as_ptr(), usize::MAX, 0.1), Status::Value, "10000000 are allowed");
        let (mut seen, mut shapes, mut holding) = (null_mut(), null_mut(), null_mut());
        ok(urdd_obstacle_points(c"seen".as_ptr(), null(), point.as_ptr(), 1, 0.1, &mut seen));
        ok(urdd_robot_proximity(robot, c"hulls".as_ptr(), &mut shapes));
        let carried = urdd_proximity_attach(shapes, 2, seen, &mut holding);
        fails(carried, Status::Value, "obstacle `seen`");
        ok(urdd_proximity_free(shapes));
        ok(urdd_obstacle_free(seen));
        let (heights, mut obstacle) = ([0.1, 0.2, 0.3, 0.4], null_mut());
        let mut field = |heights: *const f64, rows, columns, cell: [f64; 2], thickness| {
            let (name, cell) = (c"field".as_ptr(), cell.as_ptr());
            let status = urdd_obstacle_height_field(
                name,
                null(),
                heights,
                rows,
                columns,
                cell,
                thickness,
                &mut obstacle,
            );
            assert_eq!(obstacle.is_null(), status != Status::Ok);
            ok(urdd_obstacle_free(obstacle));
            status
        };
        let at = heights.as_ptr();
        ok(field(at, 2, 2, [0.1, 0.1], 0.0));
        fails(field(at, 2, 2, [0.1, -0.1], 1.0), Status::Value, "obstacle `field`");
        fails(field(at, 2, 2, [0.1, 0.1], f64::NAN), Status::Value, "obstacle `field`");
        fails(field(at, 2, 0, [0.1, 0.1], 1.0), Status::Value, "obstacle `field`");
        fails(field(at, 0, 2, [0.1, 0.1], 1.0), Status::Value, "obstacle `field`");
        fails(field(at, usize::MAX, 2, [0.1, 0.1], 1.0), Status::Value, "10000000 are allowed");

        let mut base = null_mut();
        let ball = [5.0; 3];
        ok(urdd_obstacle_sphere(c"ball".as_ptr(), ball.as_ptr(), 0.1, &mut base));
        let mut ignoring = null_mut();
        ok(urdd_obstacle_ignoring(base, c"nothing".as_ptr(), &mut ignoring));
        let (mut around, obstacles) = (null_mut(), [ignoring.cast_const()]);
        let unknown = urdd_covering_checker_around(made, obstacles.as_ptr(), 1, &mut around);
        fails(unknown, Status::UnknownName, "nothing");
        let place = [1.0; 16];
        let none = urdd_covering_checker_move_obstacles(made, 0, place.as_ptr(), 1);
        fails(none, Status::Value, "rotation and a translation");
        let place = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
        let none = urdd_covering_checker_move_obstacles(made, 0, place.as_ptr(), 1);
        fails(none, Status::OutOfRange, "obstacle 0");
        ok(urdd_obstacle_free(base));
        ok(urdd_obstacle_free(ignoring));
        ok(urdd_covering_checker_free(made));
        ok(urdd_robot_free(robot));
    }
}
