//! Loops, compared with closed forms: the four-bar, the slider-crank, gears, and what each kind of loop leaves free.

use nalgebra::Vector3;
use testkit::core_modules::{Joint, chain_of};
use urdd_format::index::{DofIdx, LinkIdx};
use urdd_format::loops::{Coupling, CouplingTerm, Loop, LoopKind, LoopsModule};
use urdd_format::pose::Pose;
use urdd_format::urdf::JointType::*;
use urdd_kinematics::ForwardKinematics;
use urdd_kinematics::loops::{Loops, NotClosed, Scratch};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn at(position: [f64; 3]) -> Pose {
    Pose { position, quaternion_wxyz: [1.0, 0.0, 0.0, 0.0] }
}

fn held(kind: LoopKind, (a, frame_a): (u32, Pose), (b, frame_b): (u32, Pose)) -> Loop {
    Loop {
        name: format!("{a}-{b}"),
        kind,
        link_a_idx: LinkIdx(a),
        frame_a,
        link_b_idx: LinkIdx(b),
        frame_b,
        position_tolerance: 0.0,
        rotation_tolerance: 0.0,
    }
}

fn module(loops: Vec<Loop>, couplings: Vec<Coupling>) -> LoopsModule {
    LoopsModule {
        loops,
        couplings,
        independent_dof_idxs: Vec::new(),
        reference_configuration: Vec::new(),
        closed_samples: Vec::new(),
    }
}

/// Kinematics and loops of joints.
fn robot(joints: &[Joint], module: &LoopsModule) -> (ForwardKinematics, Loops) {
    let (chain, dof) = chain_of(joints);
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    let loops = Loops::new(module, &kinematics, &dof, 1.0).unwrap();
    (kinematics, loops)
}

/// A joint from one link to another.
fn between(
    parent: usize,
    child: usize,
    kind: urdd_format::urdf::JointType,
    xyz: [f64; 3],
) -> Joint {
    let joint = Joint::after(parent, kind, Z);
    Joint { child, xyz, name: format!("to_{child}"), ..joint }
}

const GROUND: f64 = 0.4;
const CRANK: f64 = 0.12;
const COUPLER: f64 = 0.35;
const ROCKER: f64 = 0.25;

/// Crank, coupler and rocker on hinges along z, of which the coupler's end and the rocker's are one hinge more.
fn four_bar() -> (ForwardKinematics, Loops) {
    let joints = [
        between(0, 1, Continuous, [0.0; 3]),
        between(1, 2, Continuous, [CRANK, 0.0, 0.0]),
        between(0, 3, Continuous, [GROUND, 0.0, 0.0]),
    ];
    let ends = ((2, at([COUPLER, 0.0, 0.0])), (3, at([ROCKER, 0.0, 0.0])));
    robot(&joints, &module(vec![held(LoopKind::Revolute, ends.0, ends.1)], Vec::new()))
}

/// The rocker's angle: the circles about the end of the crank and about the second ground pivot meet in two points.
fn rocker_angle(crank: f64, side: f64) -> f64 {
    let (x, y) = (GROUND - CRANK * crank.cos(), -CRANK * crank.sin());
    let distance = x.hypot(y);
    let cosine =
        (ROCKER * ROCKER + distance * distance - COUPLER * COUPLER) / (2.0 * ROCKER * distance);
    // From the pivot, the crank's end is in the direction of (-x, -y).
    (-y).atan2(-x) + side * cosine.acos()
}

fn same_angle(a: f64, b: f64) -> bool {
    (a - b).sin().abs() < 1e-9 && (a - b).cos() > 0.0
}

#[test]
fn a_four_bar_closes_as_two_circles_meet() {
    let (kinematics, loops) = four_bar();
    let mut scratch = Scratch::default();
    for side in [-1.0, 1.0] {
        for step in 0..24 {
            let crank = f64::from(step) * 0.25;
            let rocker = rocker_angle(crank, side);
            // From near the branch.
            let end = Vector3::new(GROUND + ROCKER * rocker.cos(), ROCKER * rocker.sin(), 0.0);
            let along = end - Vector3::new(CRANK * crank.cos(), CRANK * crank.sin(), 0.0);
            let coupler = along.y.atan2(along.x) - crank;
            let mut q = [crank, coupler + 0.2, rocker - 0.2];
            let closing = loops.close(&kinematics, &mut q, &[ANY; 3], |dof| dof == 0, &mut scratch);
            let steps = closing.expect("closed");
            assert!(steps < 12, "{steps} steps at {crank}");
            assert_eq!(q[0], crank);
            assert!(same_angle(q[2], rocker), "{q:?}, not {rocker}");
            assert!(same_angle(q[1], coupler), "{q:?}, not {coupler}");
            assert!(loops.is_closed(&q, scratch.poses()));
        }
    }
}

#[test]
fn a_planar_four_bar_has_one_freedom_though_it_holds_five_numbers() {
    let (kinematics, loops) = four_bar();
    let mut q = [0.5, 0.4, 2.0];
    let mut scratch = Scratch::default();
    loops.close(&kinematics, &mut q, &[ANY; 3], |_| false, &mut scratch).expect("closed");
    for dof in 0..3 {
        let mobility =
            loops.mobility(&kinematics, &q, scratch.poses(), |other| u8::from(other == dof));
        assert_eq!(mobility.independent, [dof], "the preferred one moves freely");
        assert_eq!(mobility.dependent.len(), 2);
    }
}

#[test]
fn closing_ends_once_its_work_is_spent() {
    let (kinematics, loops) = four_bar();
    let steps = |most: u64| {
        let mut q = [0.5, 0.4, 2.0];
        let mut scratch = Scratch::within(most);
        let closed = loops.close(&kinematics, &mut q, &[ANY; 3], |_| false, &mut scratch);
        (closed, scratch.is_spent())
    };
    let of_step = loops.work(&kinematics) as u64;
    let (needed, is_spent) = steps(u64::MAX);
    let needed = needed.expect("closed") as u64;
    assert!(needed > 2 && !is_spent);
    // All steps are counted, and no more.
    assert_eq!(steps(needed * of_step), (Ok(needed as usize), false));
    assert_eq!(steps(of_step), (Err(NotClosed::Apart), true));
}

/// Each term is a polynomial, its derivative and its largest value: 14,000 couplings of two joints took seconds for nothing.
#[test]
fn the_work_of_a_step_counts_the_terms_of_couplings() {
    let joints = [between(0, 1, Continuous, [0.0; 3]), between(1, 2, Continuous, [0.1, 0.0, 0.0])];
    let term = |dof| CouplingTerm { dof_idx: DofIdx(dof), coefficients: [1.0, 0.0, 0.0, 0.0] };
    let one = Coupling { name: "c".to_owned(), constant: 0.0, terms: vec![term(0), term(1)] };
    let work = |couplings: usize| {
        let (kinematics, loops) = robot(&joints, &module(Vec::new(), vec![one.clone(); couplings]));
        loops.work(&kinematics)
    };
    // Two terms, and a row of two DOFs.
    assert_eq!(work(1001) - work(1), 1000 * (2 * 400 + 2 * 2));
}

#[test]
fn a_slider_crank_slides_as_its_triangle_says() {
    // A crank, a rod on it, and a slide along x that the rod's end is a ball on.
    let slide = Joint { axis: X, ..between(0, 3, Prismatic, [0.0; 3]) };
    let joints =
        [between(0, 1, Continuous, [0.0; 3]), between(1, 2, Continuous, [0.1, 0.0, 0.0]), slide];
    let ends = ((2, at([0.3, 0.0, 0.0])), (3, at([0.0; 3])));
    let (kinematics, loops) =
        robot(&joints, &module(vec![held(LoopKind::Spherical, ends.0, ends.1)], Vec::new()));
    let mut scratch = Scratch::default();
    for step in 0..20 {
        let crank = f64::from(step) * 0.3;
        let mut q = [crank, -crank, 0.35];
        let closing = loops.close(&kinematics, &mut q, &[ANY; 3], |dof| dof == 0, &mut scratch);
        closing.expect("closed");
        let expected = 0.1 * crank.cos() + (0.09 - 0.01 * crank.sin().powi(2)).sqrt();
        assert!((q[2] - expected).abs() < 1e-9, "{} at {crank}, not {expected}", q[2]);
    }
}

#[test]
fn gears_and_cams_hold_and_bounds_stop_them() {
    let joints = [between(0, 1, Continuous, [0.0; 3]), between(0, 2, Continuous, [0.0; 3])];
    // b = 0.5 + a^3 - 2 a
    let cam = Coupling {
        name: "cam".to_owned(),
        constant: 0.5,
        terms: vec![
            CouplingTerm { dof_idx: DofIdx(0), coefficients: [-2.0, 0.0, 1.0, 0.0] },
            CouplingTerm { dof_idx: DofIdx(1), coefficients: [-1.0, 0.0, 0.0, 0.0] },
        ],
    };
    let (kinematics, loops) = robot(&joints, &module(Vec::new(), vec![cam]));
    let mut scratch = Scratch::default();
    let mut q = [0.7, 0.0];
    let bounds = [ANY, [-0.6, 0.6]];
    loops.close(&kinematics, &mut q, &bounds, |dof| dof == 0, &mut scratch).expect("closed");
    let expected = 0.5 + 0.7_f64.powi(3) - 1.4;
    assert!((q[1] - expected).abs() < 1e-12);
    // At 2 the cam is at 4.5, which its bounds do not allow.
    let mut q = [2.0, 0.0];
    let closing = loops.close(&kinematics, &mut q, &bounds, |dof| dof == 0, &mut scratch);
    assert_eq!(closing, Err(NotClosed::Apart));
    assert_eq!(q, [2.0, 0.6], "as near as the bounds allow");
    assert!((loops.sums(&q).next().expect("a coupling") - 3.9).abs() < 1e-12);
}

#[test]
fn what_cannot_close_is_an_answer_with_its_gap() {
    // A rod of 0.1 m cannot reach a point 0.3 m away.
    let joints = [between(0, 1, Continuous, [0.0; 3])];
    let ends = ((0, at([0.3, 0.0, 0.0])), (1, at([0.1, 0.0, 0.0])));
    let (kinematics, loops) =
        robot(&joints, &module(vec![held(LoopKind::Spherical, ends.0, ends.1)], Vec::new()));
    let mut scratch = Scratch::default();
    let mut q = [1.0];
    let closing = loops.close(&kinematics, &mut q, &[ANY], |_| false, &mut scratch);
    assert_eq!(closing, Err(NotClosed::Apart));
    assert!(q[0].abs() < 1e-6, "it points at it: {}", q[0]);
    assert!((loops.gaps(scratch.poses()).next().expect("a loop").position - 0.2).abs() < 1e-9);
    let mut q = [f64::NAN];
    let closing = loops.close(&kinematics, &mut q, &[ANY], |_| false, &mut scratch);
    assert!(matches!(closing, Err(NotClosed::Unusable(_))));
}

#[test]
fn each_kind_leaves_free_what_its_name_says() {
    let joints = [Joint { child: 1, ..Joint::after(0, Floating, Z) }];
    let half = 0.5_f64.sqrt();
    for (kind, free) in [
        (LoopKind::Fixed, 0),
        (LoopKind::Revolute, 1),
        (LoopKind::Prismatic, 1),
        (LoopKind::Cylindrical, 2),
        (LoopKind::Universal, 2),
        (LoopKind::Spherical, 3),
        (LoopKind::Planar, 3),
    ] {
        let mut frame = at([0.0; 3]);
        if kind == LoopKind::Universal {
            frame.quaternion_wxyz = [half, half, 0.0, 0.0];
        }
        let one = held(kind, (0, at([0.1, 0.2, 0.3])), (1, frame));
        let (kinematics, loops) = robot(&joints, &module(vec![one], Vec::new()));
        let mut scratch = Scratch::default();
        let mut q = [0.4, -0.1, 0.2, 0.3, -0.2, 0.5];
        loops.close(&kinematics, &mut q, &[ANY; 6], |_| false, &mut scratch).expect("closed");
        let mobility = loops.mobility(&kinematics, &q, scratch.poses(), |_| 0);
        assert_eq!(mobility.independent.len(), free, "{kind}");
        let gap = loops.gaps(scratch.poses()).next().expect("a loop");
        assert!(gap.position < 1e-9 && gap.rotation < 1e-9, "{kind}: {gap:?}");
    }
}

#[test]
fn a_hinge_does_not_close_upside_down() {
    let joints = [Joint { child: 1, ..Joint::after(0, Floating, Z) }];
    let one = held(LoopKind::Revolute, (0, at([0.0; 3])), (1, at([0.0; 3])));
    let (kinematics, loops) = robot(&joints, &module(vec![one], Vec::new()));
    let poses = kinematics.link_poses(&[0.0, 0.0, 0.0, std::f64::consts::PI, 0.0, 0.0]).unwrap();
    assert!((loops.gaps(&poses).next().expect("a loop").rotation - 2.0).abs() < 1e-12);
}

#[test]
fn what_is_not_there_is_said_with_its_place() {
    let joints = [between(0, 1, Continuous, [0.0; 3])];
    let (chain, dof) = chain_of(&joints);
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    let pointer = |module: &LoopsModule| {
        Loops::new(module, &kinematics, &dof, 1.0).expect_err("a fault").pointer
    };
    let ends = ((0, at([0.0; 3])), (2, at([0.0; 3])));
    let no_link = module(vec![held(LoopKind::Fixed, ends.0, ends.1)], Vec::new());
    assert_eq!(pointer(&no_link), "/loops/0/link_b_idx");
    let zeros = Pose { position: [0.0; 3], quaternion_wxyz: [0.0; 4] };
    let no_pose = module(vec![held(LoopKind::Fixed, (0, zeros), (1, at([0.0; 3])))], Vec::new());
    assert_eq!(pointer(&no_pose), "/loops/0/frame_a");
    let term = CouplingTerm { dof_idx: DofIdx(7), coefficients: [1.0, 0.0, 0.0, 0.0] };
    let coupling = Coupling { name: "c".to_owned(), constant: 0.0, terms: vec![term] };
    assert_eq!(pointer(&module(Vec::new(), vec![coupling])), "/couplings/0/terms/0/dof_idx");
}
