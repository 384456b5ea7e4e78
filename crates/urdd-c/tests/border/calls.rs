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
}

fn handles() -> &'static Handles {
    static HANDLES: OnceLock<Handles> = OnceLock::new();
    HANDLES.get_or_init(|| {
        let urdf = testkit::repository().join("conformance/robots/planar_base_arm.urdf");
        let (_guard, folder) = testkit::robots::made(&urdf);
        let path = CString::new(folder.to_str().expect("UTF-8")).expect("no zero byte");
        let (mut robot, mut proximity, mut ball, mut world) =
            (null_mut(), null_mut(), null_mut(), null_mut());
        let centre = [1.0, 0.0, 0.5];
        // SAFETY: as the header says.
        unsafe {
            let ok = |status| assert_eq!(status, Status::Ok);
            ok(urdd_robot_open(path.as_ptr(), &mut robot));
            ok(urdd_robot_proximity(robot, c"pieces".as_ptr(), &mut proximity));
            ok(urdd_obstacle_sphere(c"ball".as_ptr(), centre.as_ptr(), 0.2, &mut ball));
            let obstacles = [ball.cast_const()];
            ok(urdd_proximity_world_proximity(proximity, obstacles.as_ptr(), 1, &mut world));
            ok(urdd_obstacle_free(ball));
            // Kinematics is read before the folder goes.
            let mut bounds = [0.0; 12];
            ok(urdd_robot_bounds(robot, bounds.as_mut_ptr(), 12));
        }
        Handles {
            robot: robot.expose_provenance(),
            proximity: proximity.expose_provenance(),
            world: world.expose_provenance(),
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
            match call % 11 {
                0 => urdd_robot_link_poses(robot, data, rows, dofs, room, length),
                1 => {
                    let (link, point) = (stream.size(5), stream.array(1, 3));
                    urdd_robot_jacobians(robot, data, rows, dofs, link, at(&point), room, length)
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
                    let status =
                        urdd_robot_of_archive(c"a".as_ptr(), rest.as_ptr(), rest.len(), &mut made);
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
            }
        };
        assert_ne!(status, Status::Internal);
        assert!(status == Status::Ok || urdd_error_message().length > 0);
    }
}
