//! What the caller's sizes take of memory.

use std::ffi::CString;
use std::ptr::{null, null_mut};

use urdd_c::*;

use crate::allocations::{LEFT, UNLIMITED};

/// Points on a sphere: all are corners of their hull. Triangles between them, as on a globe.
fn globe(rings: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    use std::f64::consts::{PI, TAU};
    let around = 2 * rings;
    let point = |k: u32| {
        let (ring, place) = (f64::from(k / around) + 0.5, f64::from(k % around));
        let (polar, angle) = (PI * ring / f64::from(rings), TAU * place / f64::from(around));
        [polar.sin() * angle.cos(), polar.sin() * angle.sin(), polar.cos()]
    };
    let face = |k: u32| {
        let next = k / around * around + (k + 1) % around;
        [[k, k + around, next], [next, k + around, next + around]]
    };
    let points = (0..rings * around).map(point).collect();
    (points, (0..(rings - 1) * around).flat_map(face).collect())
}

/// With less and less memory, each call answers or says that there is not enough: none ends the process.
#[test]
fn too_little_memory_for_what_the_caller_sends_is_a_status() {
    // What runs on the pool runs on this thread.
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
    let _one = one.expect("a pool of this thread");
    let place = testkit::temporary::folder();
    let folder = place.path().join("robot");
    testkit::model::fixture().write_to(&folder);
    let known = urdd_robot::Robot::open(&folder).expect("a robot");
    let known = known.collision_model().expect("a model");
    let path = CString::new(folder.to_str().expect("UTF-8")).expect("no zero byte");
    let (mut robot, mut model) = (null_mut(), null_mut());
    let (points, _) = globe(60);
    let (corners, faces) = globe(12);
    let inside: Vec<[f64; 3]> = (0..50_000u32)
        .map(|k| [0.7548777, 0.5698403, 0.4301597].map(|step| (f64::from(k) * step).fract()))
        .collect();
    let bytes = vec![b'P'; 20 << 20];
    let name = CString::new(vec![b'n'; 20 << 20]).expect("no zero byte");
    let rows = 100_000;
    // SAFETY: as the header says.
    unsafe {
        assert_eq!(urdd_robot_open(path.as_ptr(), &mut robot), Status::Ok);
        assert_eq!(urdd_robot_collision_model(robot, &mut model), Status::Ok);
        let (mut shapes, mut ball) = (null_mut(), null_mut());
        assert_eq!(urdd_robot_proximity(robot, c"hulls".as_ptr(), &mut shapes), Status::Ok);
        let centre = [5.0; 3];
        assert_eq!(
            urdd_obstacle_sphere(c"b".as_ptr(), centre.as_ptr(), 0.1, &mut ball),
            Status::Ok
        );
        let obstacles = vec![ball.cast_const(); 20_000];
        let (mut pairs, mut dofs, mut links) = (0, 0, 0);
        assert_eq!(urdd_robot_sizes(robot, &mut links, null_mut(), null_mut()), Status::Ok);
        assert_eq!(urdd_collision_model_sizes(model, &mut pairs, &mut dofs), Status::Ok);
        let q: Vec<f64> = (0..rows * dofs).map(|k| (k as f64 * 0.618).fract()).collect();
        // On each link many spheres, and many levels.
        let sphere = |k: usize, level| {
            let centre = inside[k % inside.len()];
            LinkSphere { level, link: k % links, centre, radius: 0.1 }
        };
        let deep = (0..50).map(|k| sphere(k, k));
        let levels: Vec<LinkSphere> = deep.chain((0..20_000).map(|k| sphere(k, 49))).collect();
        let links_of_pairs = vec![LinkPair { links: [0, 1] }; 50_000];
        let mut checker = null_mut();
        let first = sphere(0, 0);
        let none = links_of_pairs.as_ptr();
        assert_eq!(
            urdd_robot_covering_checker_of(robot, &first, 1, none, 0, &mut checker),
            Status::Ok
        );
        let (mut clearances, mut poses) = (vec![0.0; rows * pairs], vec![0.0; rows * 16 * links]);
        let hull = |points: &[[f64; 3]], name: &CString| {
            let mut made = null_mut();
            let at = points.as_ptr().cast();
            let status = urdd_obstacle_hull(name.as_ptr(), null(), at, points.len(), &mut made);
            urdd_obstacle_free(made);
            status
        };
        type Call<'a> = (&'a str, Box<dyn FnMut() -> Status + 'a>);
        let mut calls: Vec<Call> = vec![
            ("a hull of corners", Box::new(|| hull(&points, &CString::default()))),
            ("a hull of points inside", Box::new(|| hull(&inside, &CString::default()))),
            ("a name", Box::new(|| hull(&points[..9], &name))),
            (
                "a cloud",
                Box::new(|| {
                    let (mut made, at) = (null_mut(), inside.as_ptr().cast());
                    let count = inside.len();
                    let status =
                        urdd_obstacle_points(c"c".as_ptr(), null(), at, count, 0.1, &mut made);
                    urdd_obstacle_free(made);
                    status
                }),
            ),
            (
                "a field",
                Box::new(|| {
                    let (mut made, at) = (null_mut(), inside.as_ptr().cast());
                    let (name, cell) = (c"f".as_ptr(), [0.1, 0.1]);
                    let (rows, cell) = (inside.len() / 10, cell.as_ptr());
                    let status = urdd_obstacle_height_field(
                        name,
                        null(),
                        at,
                        rows,
                        10,
                        cell,
                        0.1,
                        &mut made,
                    );
                    urdd_obstacle_free(made);
                    status
                }),
            ),
            (
                "spheres",
                Box::new(|| {
                    let (mut made, mut answer) = (null_mut(), CoveringAnswer::Maybe);
                    let (at, count) = (levels.as_ptr(), levels.len());
                    let status =
                        urdd_robot_covering_checker_of(robot, at, count, null(), 0, &mut made);
                    if status == Status::Ok {
                        let asked = urdd_covering_checker_in_collision(
                            made,
                            q.as_ptr(),
                            1,
                            dofs,
                            &mut answer,
                        );
                        assert_eq!(asked, Status::Ok);
                    }
                    urdd_covering_checker_free(made);
                    status
                }),
            ),
            (
                "pairs of spheres",
                Box::new(|| {
                    let (mut made, of) = (null_mut(), links_of_pairs.as_ptr());
                    let count = links_of_pairs.len();
                    let status =
                        urdd_robot_covering_checker_of(robot, &first, 1, of, count, &mut made);
                    urdd_covering_checker_free(made);
                    status
                }),
            ),
            (
                "obstacles of spheres",
                Box::new(|| {
                    let (mut made, at) = (null_mut(), obstacles.as_ptr());
                    let status =
                        urdd_covering_checker_around(checker, at, obstacles.len(), &mut made);
                    urdd_covering_checker_free(made);
                    status
                }),
            ),
            (
                "a mesh",
                Box::new(|| {
                    let mut made = null_mut();
                    let (vertices, triangles) = (corners.as_ptr().cast(), faces.as_ptr().cast());
                    let status = urdd_obstacle_mesh(
                        c"m".as_ptr(),
                        null(),
                        vertices,
                        corners.len(),
                        triangles,
                        faces.len(),
                        &mut made,
                    );
                    urdd_obstacle_free(made);
                    status
                }),
            ),
            (
                "an archive",
                Box::new(|| {
                    let mut made = null_mut();
                    let (at, length) = (bytes.as_ptr(), bytes.len());
                    match urdd_robot_of_archive(c"a".as_ptr(), at, length, &mut made) {
                        // It is none.
                        Status::Open => Status::Ok,
                        status => status,
                    }
                }),
            ),
            (
                "obstacles",
                Box::new(|| {
                    let (mut made, at) = (null_mut(), obstacles.as_ptr());
                    let status =
                        urdd_proximity_world_proximity(shapes, at, obstacles.len(), &mut made);
                    urdd_world_proximity_free(made);
                    status
                }),
            ),
            (
                "clearances",
                Box::new(|| {
                    let (at, length) = (clearances.as_mut_ptr(), clearances.len());
                    urdd_collision_model_clearances(model, q.as_ptr(), rows, dofs, at, length)
                }),
            ),
            (
                "poses",
                Box::new(|| {
                    let (at, length) = (poses.as_mut_ptr(), poses.len());
                    urdd_robot_link_poses(robot, q.as_ptr(), rows, dofs, at, length)
                }),
            ),
        ];
        for (what, call) in &mut calls {
            assert_eq!(call(), Status::Ok, "{what}");
            let mut smallest = usize::MAX;
            for power in 38..62 {
                let bytes = 1.4f64.powi(power) as usize;
                LEFT.set(bytes);
                let status = call();
                LEFT.set(UNLIMITED);
                match status {
                    Status::Ok => smallest = smallest.min(bytes),
                    status => assert_eq!(status, Status::Memory, "{what} with {bytes} bytes"),
                }
            }
            assert!(smallest < 300 << 20, "{what}");
        }
        drop(calls);
        // Blocks of rows are joined as the whole.
        assert_eq!(clearances, known.clearances_batch(&q).expect("clearances"));
        assert_eq!(urdd_obstacle_free(ball), Status::Ok);
        assert_eq!(urdd_covering_checker_free(checker), Status::Ok);
        assert_eq!(urdd_proximity_free(shapes), Status::Ok);
        assert_eq!(urdd_collision_model_free(model), Status::Ok);
        assert_eq!(urdd_robot_free(robot), Status::Ok);
    }
}
