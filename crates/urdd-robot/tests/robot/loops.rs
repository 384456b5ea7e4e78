//! Kinematic loops in use: held to the law of cosines, closed derivatives and central differences.

use urdd_robot::{CloseSettings, Closed, ClosedBatch, Robot, RobotError};

use testkit::looped::{FOUR_BAR, four_bar, four_bar_at, leg, made_with_loops};
use testkit::robots::{made_named, made_of};

pub(super) fn robot_of(urdf: &str) -> (tempfile::TempDir, Robot) {
    let (folder, path) = made_of(urdf);
    (folder, Robot::open(path).expect("a robot"))
}

fn same_angle(a: f64, b: f64) -> bool {
    (a - b).sin().abs() < 1e-9 && (a - b).cos() > 0.0
}

#[test]
fn a_four_bar_closes_as_the_law_of_cosines_has_it() {
    let (_folder, robot) = robot_of(&four_bar(FOUR_BAR, ""));
    let crank = robot.dof("crank").unwrap();
    assert_eq!((crank, robot.independent_dofs().unwrap()), (0, vec![0]));
    for side in [-1.0, 1.0] {
        for step in 0..12 {
            let expected = four_bar_at(FOUR_BAR, 0.5 * f64::from(step), side);
            let errors = robot.loop_errors(&expected).unwrap();
            assert!(errors.is_closed && errors.sums.is_empty(), "{errors:?}");
            // The coupler's end is off by its length times the angle, and its rotation is free.
            let mut q = expected;
            q[1] += 1e-3;
            let errors = robot.loop_errors(&q).unwrap();
            let gap = 2.0 * FOUR_BAR[2] * 0.5e-3_f64.sin();
            assert!(!errors.is_closed && (errors.gaps[0].position - gap).abs() < 1e-15);
            assert!(errors.gaps[0].rotation < 1e-15, "the axes stay parallel");
            q[2] -= 0.1;
            let settings = CloseSettings { held: &[crank], ..Default::default() };
            let found = robot.close(&q, &settings).unwrap();
            assert!(found.is_closed() && found.configuration()[0] == q[0]);
            for (a, b) in found.closed().expect("closed").iter().zip(expected) {
                assert!(same_angle(*a, b), "{a}, not {b}");
            }
        }
    }
}

/// Of coupler and rocker together, 0.45 m, the crank's end can be so far from the rocker's hinge.
pub(super) const ROCKERS: [f64; 4] = [0.4, 0.3, 0.2, 0.25];

#[test]
fn what_cannot_close_is_an_answer_and_bounds_are_kept() {
    let (_folder, robot) = robot_of(&four_bar(ROCKERS, ""));
    let settings = CloseSettings { held: &[0], ..Default::default() };
    let found = robot.close(&[std::f64::consts::PI, 0.0, 3.0], &settings).unwrap();
    let Closed::Apart(nearest) = found.clone() else { panic!("{found:?}") };
    assert_eq!(nearest[0], std::f64::consts::PI);
    // The two point at each other, over 0.7 m.
    let gap = robot.loop_errors(&nearest).unwrap().gaps[0].position;
    assert!((gap - 0.25).abs() < 1e-6, "{gap}");
    assert_eq!(found.closed(), None);

    let start = four_bar_at(ROCKERS, 0.4, 1.0);
    let free = robot.close(&[0.5, start[1], start[2]], &settings).unwrap();
    let rocker = free.closed().expect("closed")[2];
    let tight = [[-9.0, 9.0], [-9.0, 9.0], [-9.0, rocker - 0.05]];
    let bounded = CloseSettings { held: &[], bounds: Some(&tight) };
    let found = robot.close(&[0.5, start[1], rocker], &bounded).unwrap();
    let Closed::Closed(q) = found else { panic!("{found:?}") };
    assert!(q[2] <= rocker - 0.05 && q[0] != 0.5 && robot.loop_errors(&q).unwrap().is_closed);
    let bounded = CloseSettings { held: &[0], bounds: Some(&tight) };
    assert!(!robot.close(&[0.5, start[1], rocker], &bounded).unwrap().is_closed());

    let ask = |q: &[f64], held: &[usize], bounds: Option<&[[f64; 2]]>| {
        robot.close(q, &CloseSettings { held, bounds }).expect_err("refused")
    };
    let wrong = RobotError::OutOfRange { what: "DOF", index: 3, count: 3 };
    assert_eq!(ask(&[0.0; 3], &[3], None), wrong);
    for bounds in [&tight[..2], &[[1.0, 0.0]; 3], &[[f64::NAN, 0.0]; 3]] {
        assert!(matches!(ask(&[0.0; 3], &[], Some(bounds)), RobotError::Setting(_)));
    }
    for q in [&[0.0; 2][..], &[0.0, f64::NAN, 0.0]] {
        assert!(matches!(ask(q, &[], None), RobotError::Configuration(_)));
    }
}

#[test]
fn velocities_of_a_four_bar_are_those_of_the_textbook() {
    let (_folder, robot) = robot_of(&four_bar(FOUR_BAR, ""));
    let [_, crank, coupler, rocker] = FOUR_BAR;
    for step in 0..12 {
        let q = four_bar_at(FOUR_BAR, 0.5 * f64::from(step), -1.0);
        let along = q[0] + q[1];
        let of_rocker = crank * (q[0] - along).sin() / (rocker * (q[2] - along).sin());
        let of_coupler = crank * (q[0] - q[2]).sin() / (coupler * (q[2] - along).sin());
        let found = robot.loop_velocities(&q, &[2.0]).unwrap().expect("they follow");
        for (a, b) in found.iter().zip([2.0, 2.0 * (of_coupler - 1.0), 2.0 * of_rocker]) {
            assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{found:?}, not {b}");
        }
        let moved = robot.loop_jacobian(&q).unwrap() * nalgebra::DVector::from_vec(found);
        assert!(moved.len() == 5 && moved.norm() < 1e-9, "{moved}");
    }
    // Where coupler and rocker are in a line, the crank cannot go on, and either of them may lead.
    let (_folder, robot) = robot_of(&four_bar(ROCKERS, ""));
    let dead = ((0.45_f64.powi(2) - 0.25) / (-2.0 * 0.4 * 0.3)).acos();
    let y = 0.3 * dead.sin();
    let rocker = y.atan2(0.3 * dead.cos() - 0.4);
    let q = [dead, rocker - std::f64::consts::PI - dead, rocker];
    assert!(robot.loop_errors(&q).unwrap().is_closed);
    assert_eq!(robot.loop_velocities(&q, &[1.0]), Ok(None));
    let free = robot.free_dofs(&q).unwrap();
    assert_eq!((free.independent.len(), free.dependent.contains(&0)), (1, true), "{free:?}");
    assert!(robot.loop_velocities(&four_bar_at(ROCKERS, 0.5, 1.0), &[1.0]).unwrap().is_some());
}

/// Every kind of loop between a body that floats and the base, and a coupling with all powers.
const KINDS: &str = r#"
[[coupling]]
name = "cam"
constant = 0.25
terms = { slide = [0.5, -0.25, 0.125, 2.0], turn = [2.0] }
"#;

#[test]
fn jacobians_are_the_derivatives_of_the_residuals() {
    let urdf = r#"<robot name="kinds"><link name="base"/><link name="body"/><link name="arm"/><link name="tool"/>
        <joint name="float" type="floating"><parent link="base"/><child link="body"/></joint>
        <joint name="turn" type="continuous"><parent link="body"/><child link="arm"/><origin xyz="0.2 0.1 0"/><axis xyz="0.6 0 0.8"/></joint>
        <joint name="slide" type="prismatic"><parent link="arm"/><child link="tool"/><axis xyz="1 0 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
        </robot>"#;
    let at = [0.3, -0.2, 0.4, 0.0, 0.0, 0.0];
    for (kind, equations) in [
        ("Fixed", 6),
        ("Revolute", 5),
        ("Prismatic", 5),
        ("Cylindrical", 4),
        ("Universal", 4),
        ("Spherical", 3),
        ("Planar", 3),
    ] {
        let turned = if kind == "Universal" { "1.5707963267948966" } else { "0" };
        let toml = format!(
            "{KINDS}\n[[loop]]\nname = \"one\"\nkind = \"{kind}\"\nlink_a = \"base\"\nframe_a = {{ xyz = [0.3, -0.2, 0.4], rpy = [0.4, -0.5, 0.6] }}\nlink_b = \"body\"\nframe_b = {{ xyz = [0.0, 0.0, 0.0], rpy = [{turned}, 0, 0] }}\n"
        );
        let (_folder, path) = made_with_loops(urdf, &toml);
        let robot = Robot::open(path).expect("a robot");
        let start = [&at[..], &[0.1, 0.2]].concat();
        let closed = robot.close(&start, &Default::default()).unwrap();
        let q = closed.closed().unwrap_or_else(|| panic!("{kind} closes"));
        let residuals = |q: &[f64]| robot.loop_residuals(q).expect("residuals");
        assert_eq!(robot.num_loop_equations(), Ok(equations + 1), "{kind}");
        assert!(residuals(&q).iter().all(|row| row.abs() < 1e-9), "{kind}");
        let jacobian = robot.loop_jacobian(&q).unwrap();
        assert_eq!(jacobian.shape(), (equations + 1, 8), "{kind}");
        let least = jacobian.clone().singular_values().min();
        assert!(least > 1e-2, "each equation holds something: {kind}, {least}");
        let step = 1e-6;
        for dof in 0..8 {
            let moved = |by: f64| {
                let mut q = q.clone();
                q[dof] += by;
                residuals(&q)
            };
            for (row, (a, b)) in moved(step).iter().zip(moved(-step)).enumerate() {
                let expected = (a - b) / (2.0 * step);
                let found = jacobian[(row, dof)];
                assert!((found - expected).abs() < 1e-8, "{kind}: {found}, not {expected}");
            }
        }
    }
}

#[test]
fn a_leg_of_six_rods_follows_its_lengths() {
    let (_folder, robot) = robot_of(&leg());
    let rods: Vec<usize> = (0..6).map(|k| robot.dof(&format!("rod_{k}")).unwrap()).collect();
    let mut q = robot.loops().unwrap().expect("loops").reference_configuration.clone();
    assert_eq!((q.len(), robot.num_loop_equations()), (21, Ok(15)));
    assert_eq!(robot.independent_dofs(), Ok(rods.clone()));
    assert_eq!(robot.num_independent_dofs(), Ok(6));
    assert_eq!(robot.free_dofs(&q).unwrap().independent.len(), 6);
    // The points of hip and foot that a rod connects are as far apart as it is long.
    for rod in &rods {
        q[*rod] += 0.003;
    }
    let settings = CloseSettings { held: &rods, ..Default::default() };
    let closed = robot.close(&q, &settings).unwrap().closed().expect("closed");
    let poses = robot.link_poses(&closed).unwrap();
    let foot = robot.link("foot").unwrap();
    for (k, rod) in rods.iter().enumerate() {
        let link = robot.link(&format!("tilt_{k}_link")).unwrap();
        let angle = std::f64::consts::TAU * ((k / 2) as f64 / 3.0);
        let angle = angle + if k % 2 == 0 { -0.8 } else { 0.8 };
        let end = nalgebra::Point3::new(0.12 * angle.cos(), 0.12 * angle.sin(), 0.0);
        let length =
            (poses[foot] * end - nalgebra::Point3::from(poses[link].translation.vector)).norm();
        assert!((length - q[*rod]).abs() < 1e-9, "{k}: {length}");
    }
    // Many at once, whatever the number of threads.
    let mut many = Vec::new();
    for k in 0..40 {
        let mut other = closed.clone();
        rods.iter().for_each(|rod| other[*rod] += 1e-3 * f64::from(k % 7) * (*rod as f64 - 9.0));
        many.extend(other);
    }
    let batch = |threads: usize| -> ClosedBatch {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| robot.close_batch(&many, &settings).expect("answers"))
    };
    let found = batch(1);
    assert_eq!(found, batch(3));
    for (k, row) in many.chunks(21).enumerate() {
        let one = robot.close(row, &settings).unwrap();
        assert_eq!(one.is_closed(), found.is_closed[k]);
        assert_eq!(one.configuration(), &found.configurations[21 * k..21 * (k + 1)]);
    }
    assert!(found.is_closed.iter().filter(|closed| **closed).count() > 20);
    let short = RobotError::Batch { found: 20, dofs: 21 };
    assert_eq!(robot.close_batch(&many[..20], &settings), Err(short));
}

#[test]
fn a_tree_is_closed_everywhere() {
    let (_folder, path) = made_named("planar_base_arm");
    let robot = Robot::open(path).expect("a robot");
    let dofs = robot.dof_names().unwrap().len();
    let known = robot.configurations().unwrap();
    let q: Vec<f64> = known.bounds().iter().map(|[_, upper]| upper + 1.0).collect();
    let errors = robot.loop_errors(&q).unwrap();
    assert!(errors.is_closed && errors.gaps.is_empty() && errors.sums.is_empty());
    assert_eq!(robot.independent_dofs(), Ok((0..dofs).collect()));
    assert_eq!(robot.free_dofs(&q).unwrap().dependent, [0; 0]);
    assert_eq!(robot.loop_jacobian(&q).unwrap().shape(), (0, dofs));
    assert_eq!(robot.loop_residuals(&q), Ok(Vec::new()));
    assert_eq!(robot.loop_velocities(&q, &q), Ok(Some(q.clone())));
    // What is limited goes to its bound, unless it is held.
    let limited = known.dof_is_limited().iter().rposition(|limited| *limited).expect("one");
    assert!(known.dof_is_limited().contains(&false));
    let mut expected: Vec<f64> = q.clone();
    for (dof, value) in expected.iter_mut().enumerate() {
        *value -= if known.dof_is_limited()[dof] && dof != limited { 1.0 } else { 0.0 };
    }
    let settings = CloseSettings { held: &[limited], ..Default::default() };
    let Closed::Closed(found) = robot.close(&q, &settings).unwrap() else { panic!("closed") };
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() < 1e-12, "{found:?}, not {expected:?}");
    }
    assert!(matches!(robot.loop_errors(&q[1..]), Err(RobotError::Configuration(_))));
    let batch = robot.close_batch(&[], &settings).expect("no configuration");
    assert_eq!((batch.configurations.len(), batch.is_closed.len()), (0, 0));
}
