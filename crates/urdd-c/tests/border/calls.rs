//! Calls of the C interface, as bytes decide: any numbers in arrays that have their stated length.

use std::ffi::CString;
use std::ptr::{null, null_mut};
use std::sync::OnceLock;

use urdd_c::*;

/// Handles for all inputs, by their addresses.
struct Handles {
    robot: usize,
    proximity: usize,
    world: usize,
    checker: usize,
}

fn handles() -> &'static Handles {
    static HANDLES: OnceLock<Handles> = OnceLock::new();
    HANDLES.get_or_init(|| {
        let urdf = testkit::repository().join("conformance/robots/planar_base_arm.urdf");
        let (_guard, folder) = testkit::robots::made(&urdf);
        let path = CString::new(folder.to_str().expect("UTF-8")).expect("no zero byte");
        let (mut robot, mut proximity, mut ball, mut world, mut checker) =
            (null_mut(), null_mut(), null_mut(), null_mut(), null_mut());
        let centre = [1.0, 0.0, 0.5];
        // SAFETY: as the header says.
        unsafe {
            let ok = |status| assert_eq!(status, Status::Ok);
            ok(urdd_robot_open(path.as_ptr(), &mut robot));
            ok(urdd_robot_proximity(robot, c"pieces".as_ptr(), &mut proximity));
            ok(urdd_obstacle_sphere(c"ball".as_ptr(), centre.as_ptr(), 0.2, &mut ball));
            let obstacles = [ball.cast_const()];
            ok(urdd_proximity_world_proximity(proximity, obstacles.as_ptr(), 1, &mut world));
            let sphere = |link| LinkSphere { level: 0, link, centre: [0.0; 3], radius: 0.1 };
            let (spheres, pair) = ([sphere(0), sphere(3)], LinkPair { links: [0, 3] });
            let (of, mut alone) = (spheres.as_ptr(), null_mut());
            ok(urdd_robot_covering_checker_of(robot, of, 2, &pair, 1, &mut alone));
            ok(urdd_covering_checker_around(alone, obstacles.as_ptr(), 1, &mut checker));
            ok(urdd_obstacle_free(ball));
            // Kinematics is read before the folder goes.
            let mut bounds = [0.0; 12];
            ok(urdd_robot_bounds(robot, bounds.as_mut_ptr(), 12));
        }
        Handles {
            robot: robot.expose_provenance(),
            proximity: proximity.expose_provenance(),
            world: world.expose_provenance(),
            checker: checker.expose_provenance(),
        }
    })
}

/// Numbers from bytes; zeros after their end.
struct Stream<'a>(&'a [u8]);

impl Stream<'_> {
    fn byte(&mut self) -> u8 {
        self.0.split_off_first().copied().unwrap_or_default()
    }

    /// A small number, or one that no memory has.
    fn size(&mut self, usual: usize) -> usize {
        match self.byte() {
            byte @ 0..=9 => usize::from(byte),
            250 => usize::MAX,
            251 => usize::MAX / 8,
            252 => isize::MAX as usize,
            _ => usual,
        }
    }

    fn number(&mut self) -> f64 {
        match self.byte() {
            255 => f64::NAN,
            254 => f64::INFINITY,
            253 => f64::from_bits(u64::from_le_bytes([(); 8].map(|()| self.byte()))),
            byte => (f64::from(byte) - 126.0) / 40.0,
        }
    }

    /// As many as a call that says this many rows and columns has to have; none where no memory has them.
    fn array(&mut self, rows: usize, columns: usize) -> Vec<f64> {
        let length = rows.checked_mul(columns).filter(|length| *length <= 4096);
        (0..length.unwrap_or_default()).map(|_| self.number()).collect()
    }
}

fn at(values: &[f64]) -> *const f64 {
    match values {
        [] => null(),
        _ => values.as_ptr(),
    }
}

/// Runs calls until the bytes end.
pub fn border(bytes: &[u8]) {
    let handles = handles();
    let robot = std::ptr::with_exposed_provenance::<Robot>(handles.robot);
    let proximity = std::ptr::with_exposed_provenance::<Proximity>(handles.proximity);
    let world = std::ptr::with_exposed_provenance::<WorldProximity>(handles.world);
    let checker = std::ptr::with_exposed_provenance::<CoveringChecker>(handles.checker);
    let mut stream = Stream(bytes);
    while !stream.0.is_empty() {
        let call = stream.byte();
        let (rows, dofs) = (stream.size(1), stream.size(6));
        let q = stream.array(rows, dofs);
        // An array that is too long for any memory is null, which is found first or later.
        let known = q.len() == rows.saturating_mul(dofs);
        let data = if known { at(&q) } else { null() };
        let length = stream.size(96).min(4096);
        let mut out = vec![f64::NAN; length];
        let (room, rows_here) = (out.as_mut_ptr(), if known { rows.min(4096) } else { 0 });
        let mut touches = vec![false; rows_here];
        // SAFETY: arrays have their stated lengths, or are null.
        let status = unsafe {
            match call {
                // What was found before stays the call that it was.
                SPHERES.. => of_spheres(
                    call - SPHERES,
                    (robot, checker),
                    (data, rows_here, dofs),
                    &mut stream,
                ),
                _ => match call % 11 {
                    0 => urdd_robot_link_poses(robot, data, rows, dofs, room, length),
                    1 => {
                        let (link, point) = (stream.size(5), stream.array(1, 3));
                        urdd_robot_jacobians(
                            robot,
                            data,
                            rows,
                            dofs,
                            link,
                            at(&point),
                            room,
                            length,
                        )
                    }
                    2 if known => urdd_proximity_in_collision(
                        proximity,
                        data,
                        rows_here,
                        dofs,
                        touches.as_mut_ptr(),
                    ),
                    3 => urdd_proximity_distances(proximity, data, rows, dofs, room, length),
                    4 if known => {
                        let mut least = vec![0.0; rows_here];
                        urdd_world_proximity_min_distance(
                            world,
                            data,
                            rows_here,
                            dofs,
                            least.as_mut_ptr(),
                        )
                    }
                    5 if known => urdd_world_proximity_in_collision(
                        world,
                        data,
                        rows_here,
                        dofs,
                        touches.as_mut_ptr(),
                    ),
                    6 => {
                        let (pose, half) = (stream.array(1, 16), stream.array(1, 3));
                        let mut made = null_mut();
                        let status =
                            urdd_obstacle_cuboid(c"o".as_ptr(), at(&pose), at(&half), &mut made);
                        assert_eq!(status == Status::Ok, !made.is_null());
                        assert_eq!(urdd_obstacle_free(made), Status::Ok);
                        status
                    }
                    7 => {
                        let mut made = null_mut();
                        let rest = stream.0;
                        stream.0 = &[];
                        let status = urdd_robot_of_archive(
                            c"a".as_ptr(),
                            rest.as_ptr(),
                            rest.len(),
                            &mut made,
                        );
                        if status == Status::Ok {
                            urdd_robot_sizes(made, null_mut(), null_mut(), null_mut());
                        }
                        assert_eq!(urdd_robot_free(made), Status::Ok);
                        status
                    }
                    8 if known => urdd_proximity_is_within(
                        proximity,
                        data,
                        rows_here,
                        dofs,
                        stream.number(),
                        touches.as_mut_ptr(),
                    ),
                    9 if known && rows_here <= 8 => {
                        let mut blocked = vec![0.0; rows_here];
                        // No finer than what a fuzzer has time for.
                        let resolution = match stream.number() {
                            number if number.abs() < 0.01 => 0.0,
                            number => number,
                        };
                        urdd_world_proximity_blocked_edge(
                            world,
                            data,
                            data,
                            rows_here,
                            dofs,
                            stream.number(),
                            resolution,
                            blocked.as_mut_ptr(),
                        )
                    }
                    _ => urdd_robot_bounds(robot, room, length),
                },
            }
        };
        assert_ne!(status, Status::Internal);
        assert!(status == Status::Ok || urdd_error_message().length > 0);
    }
}

/// From this byte on, calls are about spheres and the obstacles that they brought.
const SPHERES: u8 = 242;

unsafe fn of_spheres(
    call: u8,
    (robot, checker): (*const Robot, *const CoveringChecker),
    (data, rows, dofs): (*const f64, usize, usize),
    stream: &mut Stream,
) -> Status {
    // SAFETY: guaranteed by the caller; arrays here have their stated lengths.
    unsafe {
        match call % 4 {
            0 => {
                let mut answers = vec![CoveringAnswer::Maybe; rows];
                let (margin, out) = (stream.number(), answers.as_mut_ptr());
                urdd_covering_checker_is_within(checker, data, rows, dofs, margin, out)
            }
            1 => {
                let rows = rows.min(8);
                let (mut contacts, margin) = (vec![0.0; 2 * rows], stream.number());
                // No finer than what a fuzzer has time for.
                let resolution = match stream.number() {
                    number if number.abs() < 0.01 => 0.0,
                    number => number,
                };
                let (out, ends) = (contacts.as_mut_ptr(), stream.array(rows, dofs));
                let to = if ends.len() == rows * dofs.min(4096) { at(&ends) } else { null() };
                urdd_covering_checker_first_contact(
                    checker,
                    data,
                    to,
                    rows,
                    dofs,
                    margin,
                    resolution,
                    call & 4 != 0,
                    out,
                    2 * rows,
                )
            }
            2 => {
                let (count, mut made) = (stream.size(6) % 64, null_mut());
                let points = stream.array(count, 3);
                let pose = stream.array(1, 16);
                let status = match call & 4 {
                    0 => {
                        let radius = stream.number();
                        let (pose, points) = (at(&pose), at(&points));
                        urdd_obstacle_points(c"o".as_ptr(), pose, points, count, radius, &mut made)
                    }
                    _ => {
                        let (cell, thickness) =
                            ([stream.number(), stream.number()], stream.number());
                        let (name, heights, cell) = (c"o".as_ptr(), at(&points), cell.as_ptr());
                        urdd_obstacle_height_field(
                            name,
                            null(),
                            heights,
                            count,
                            3,
                            cell,
                            thickness,
                            &mut made,
                        )
                    }
                };
                if status == Status::Ok {
                    let (mut around, obstacle, q) = (null_mut(), made.cast_const(), [0.0; 6]);
                    let mut answer = CoveringAnswer::Maybe;
                    let status = urdd_covering_checker_around(checker, &obstacle, 1, &mut around);
                    assert_eq!(status, Status::Ok);
                    let (at, out) = (q.as_ptr(), &mut answer);
                    let status = urdd_covering_checker_in_collision(around, at, 1, 6, out);
                    assert_eq!(status, Status::Ok);
                    assert_eq!(urdd_covering_checker_free(around), Status::Ok);
                }
                assert_eq!(urdd_obstacle_free(made), Status::Ok);
                status
            }
            _ => {
                let mut made = null_mut();
                let spheres: Vec<LinkSphere> = (0..stream.size(4) % 64)
                    .map(|_| LinkSphere {
                        level: stream.size(1),
                        link: stream.size(2),
                        centre: [stream.number(), stream.number(), stream.number()],
                        radius: stream.number(),
                    })
                    .collect();
                let pair = LinkPair { links: [stream.size(0), stream.size(3)] };
                let (of, count) = (spheres.as_ptr(), spheres.len());
                let status = urdd_robot_covering_checker_of(robot, of, count, &pair, 1, &mut made);
                assert_eq!(status == Status::Ok, !made.is_null());
                assert_eq!(urdd_covering_checker_free(made), Status::Ok);
                status
            }
        }
    }
}
