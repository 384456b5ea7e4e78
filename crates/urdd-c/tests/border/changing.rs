//! A robot's handle never changes: each answer is that of the files that were there when it was opened, or `UNUSABLE`.

use std::fs;
use std::path::Path;
use std::ptr::null_mut;

use urdd_c::*;

use crate::interface::{c, ok, said, text};

type Answer = Result<Vec<u64>, Status>;

/// Numbers of an answer, to the bit; a text is its bytes.
fn numbers(status: Status, values: &[f64]) -> Answer {
    match status {
        Status::Ok => Ok(values.iter().map(|value| value.to_bits()).collect()),
        status => Err(status),
    }
}

fn written(
    robot: *const Robot,
    name: unsafe extern "C" fn(*const Robot, usize, *mut Text) -> Status,
) -> Answer {
    let mut found = urdd_version();
    // SAFETY: as the header says.
    match unsafe { name(robot, 1, &mut found) } {
        Status::Ok => Ok(text(found).bytes().map(u64::from).collect()),
        status => Err(status),
    }
}

type Fill = unsafe extern "C" fn(*const Robot, *mut f64, usize) -> Status;

fn filled<const N: usize>(robot: *const Robot, fill: Fill) -> Answer {
    let mut values = [0.0; N];
    // SAFETY: as the header says.
    numbers(unsafe { fill(robot, values.as_mut_ptr(), N) }, &values)
}

const Q: [f64; 6] = [0.3, -0.2, 0.1, 0.4, 0.2, -0.5];
const KINDS: [&str; 6] = ["hulls", "pieces", "boxes", "spheres", "piece-boxes", "piece-spheres"];

fn distances(robot: *const Robot, kind: &str) -> Answer {
    let (mut proximity, mut pairs) = (null_mut(), 0);
    // SAFETY: as the header says.
    unsafe {
        match urdd_robot_proximity(robot, c(kind).as_ptr(), &mut proximity) {
            Status::Ok => {}
            status => return Err(status),
        }
        ok(urdd_proximity_sizes(proximity, null_mut(), &mut pairs, null_mut()));
        let mut all = vec![0.0; pairs];
        let status = urdd_proximity_distances(proximity, Q.as_ptr(), 1, 6, all.as_mut_ptr(), pairs);
        ok(urdd_proximity_free(proximity));
        numbers(status, &all)
    }
}

fn skipped(robot: *const Robot, kind: &str) -> Answer {
    let (mut skips, mut count, mut all) = (null_mut(), 0, Vec::new());
    // SAFETY: as the header says.
    unsafe {
        match urdd_robot_skips(robot, c(kind).as_ptr(), &mut skips) {
            Status::Ok => {}
            status => return Err(status),
        }
        ok(urdd_skips_len(skips, &mut count));
        for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
            let mut is_skipped = false;
            ok(urdd_skips_is_skipped(skips, i, j, &mut is_skipped));
            all.push(u64::from(is_skipped));
        }
        ok(urdd_skips_free(skips));
    }
    Ok(all)
}

/// Every question that a handle can be asked.
fn asked(robot: *const Robot, question: usize) -> Option<Answer> {
    let (q, mut values) = (Q.as_ptr(), [0.0; 8 * 16]);
    let out = values.as_mut_ptr();
    let (mut count, mut model) = (0, null_mut());
    // SAFETY: as the header says.
    Some(unsafe {
        match question {
            0 => numbers(
                urdd_robot_sizes(robot, &mut count, null_mut(), null_mut()),
                &[count as f64],
            ),
            1 => written(robot, urdd_robot_link_name),
            2 => written(robot, urdd_robot_joint_name),
            3 => written(robot, urdd_robot_dof_name),
            4 => written(robot, urdd_robot_dof_unit),
            5 => numbers(urdd_robot_link(robot, c("elbow").as_ptr(), &mut count), &[count as f64]),
            6 => filled::<12>(robot, urdd_robot_bounds),
            7 => filled::<6>(robot, urdd_robot_zero),
            8 => filled::<6>(robot, urdd_robot_middle),
            9 => numbers(urdd_robot_random(robot, 3, out, 1, 6), &values),
            10 => filled::<6>(robot, urdd_robot_velocity_limits),
            11 => filled::<6>(robot, urdd_robot_effort_limits),
            12 => filled::<32>(robot, urdd_robot_link_masses),
            13 => numbers(urdd_robot_centre_of_mass(robot, q, 1, 6, out), &values),
            14 => numbers(urdd_robot_link_poses(robot, q, 1, 6, out, 8 * 16), &values),
            15 => numbers(
                urdd_robot_jacobians(robot, q, 1, 6, 5, [0.0; 3].as_ptr(), out, 36),
                &values,
            ),
            16 => numbers(urdd_robot_num_named_configurations(robot, &mut count), &[count as f64]),
            17 => {
                let status = urdd_robot_collision_model(robot, &mut model);
                ok(urdd_collision_model_free(model));
                numbers(status, &[])
            }
            18..24 => distances(robot, KINDS[question - 18]),
            24..30 => skipped(robot, KINDS[question - 24]),
            30 => {
                let none = std::ptr::null();
                let (q, out) = (Q.as_ptr(), values.as_mut_ptr());
                let status = urdd_robot_gravity_torques(robot, q, 1, 6, none, 0.0, 0, none, out, 6);
                numbers(status, &values)
            }
            _ => return None,
        }
    })
}

fn open(path: &Path) -> *mut Robot {
    let (path, mut robot) = (c(path.to_str().expect("UTF-8")), null_mut());
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_open(path.as_ptr(), &mut robot) });
    robot
}

fn all(robot: *const Robot) -> Vec<Answer> {
    (0..).map_while(|question| asked(robot, question)).collect()
}

fn close(robot: *mut Robot) {
    // SAFETY: as the header says.
    ok(unsafe { urdd_robot_free(robot) });
}

fn in_place(path: &Path) {
    for name in testkit::files::below(path).into_keys() {
        let file = path.join(name);
        let bytes = fs::read(&file).expect("a file").into_iter();
        let other = bytes.map(|byte| if byte == b'1' { b'3' } else { byte });
        fs::write(file, other.collect::<Vec<u8>>()).expect("written");
    }
}

#[test]
fn a_handle_answers_from_the_files_that_were_there() {
    let urdf = testkit::repository().join("conformance/robots/six_axis_arm.urdf");
    let text = fs::read_to_string(&urdf).expect("a robot").replace("0.1", "0.2");
    let (other, second) = testkit::robots::made_of(&text);
    let replace = |path: &Path| {
        fs::remove_dir_all(path).expect("removed");
        fs::rename(&second, path).expect("renamed");
    };
    let remove = |path: &Path| fs::remove_dir_all(path).expect("removed");
    for change in [&in_place as &dyn Fn(&Path), &remove, &replace] {
        let (_folder, path) = testkit::robots::made(&urdf);
        let robot = open(&path);
        let first = all(robot);
        close(robot);
        assert!(first.iter().filter(|answer| answer.is_err()).count() <= 1);
        let robots: Vec<*mut Robot> = (0..first.len())
            .map(|question| {
                let robot = open(&path);
                let _ = asked(robot, question);
                robot
            })
            .collect();
        change(&path);
        let mut refused = 0;
        for (before, robot) in robots.into_iter().enumerate() {
            for (question, first) in first.iter().enumerate() {
                let answer = asked(robot, question).expect("a question");
                if answer == Err(Status::Unusable) {
                    assert!(
                        said().ends_with("it changed on disk since it was opened: open it again")
                    );
                    assert_ne!(question, before, "kept");
                    refused += 1;
                } else {
                    assert_eq!(answer, *first, "{question} after {before}");
                }
            }
            close(robot);
        }
        assert!(refused > 0);
    }
    drop(other);
}
