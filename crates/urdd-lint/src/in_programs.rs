//! What programs do with the examples of rules, as their readers say it. Written by `cargo xtask update`.

use urdd_findings::code::Code;

/// What programs do with the examples of a rule; empty if that is nothing.
#[rustfmt::skip]
pub const fn in_programs(code: Code) -> &'static str {
    match code {
        Code::LNT006 => "\
            In examples of it:\n\n- joint `more` moves this link, and it has no mass: MuJoCo refuses the robot; Gazebo leaves out \
            the link.\n- no link has a mass: Gazebo refuses the robot.",
        Code::LNT008 => "\
            In an example, `<inertial>` has no ixy: MuJoCo refuses the robot; ROS, Gazebo and Pinocchio leave out the inertial.",
        Code::LNT013 => "\
            In an example, `velocity` is negative: Pinocchio and Drake refuse the robot; Gazebo reads `no limit`.",
        Code::LNT014 => "\
            In examples of it:\n\n- a continuous joint has the limits -2 to 2, which Drake and PyBullet keep to and most programs \
            ignore: Drake reads `a limited joint`.\n- both limits of a continuous joint are 0: Drake and PyBullet hold it there, \
            and in most programs it turns without end: Drake reads `a limited joint`.",
        Code::LNT015 => "\
            In examples of it:\n\n- a link has the same name: Gazebo refuses the robot.\n- MuJoCo takes the link for the world \
            itself: it stands still, with all that hangs on it, while the robot moves: Gazebo Harmonic and Jetty refuse the \
            robot.\n- the name is empty: ROS, Gazebo, Pinocchio, Drake, PyBullet and Isaac and Newton refuse the robot.\n- `world` \
            is the world itself, and this link is fixed to another one: Gazebo Harmonic and Jetty refuse the robot.\n- SDFormat, so \
            Gazebo, keeps `::` and `__NAME__` for itself: Gazebo Harmonic and Jetty refuse the robot.\n- `world` is the world \
            itself, and a joint moves this link: Gazebo and MuJoCo refuse the robot; Drake reads `a joint of the world`.\n- \
            SDFormat, so Gazebo, keeps the name `world` for the world: Gazebo refuses the robot.",
        Code::LNT017 => "\
            In an example, `<limit>` has no velocity: ROS, Gazebo and Pinocchio refuse the robot.",
        Code::LNT026 => "\
            In examples of it:\n\n- after `file://` comes an absolute path, and the first word here is the name of a computer: \
            Pinocchio, Drake and PyBullet refuse the robot; Isaac and Newton leave out the collision.\n- the path is that of one \
            machine: MuJoCo, Pinocchio, Drake and PyBullet refuse the robot; Isaac and Newton leave out the collision.",
        Code::LNT027 => "\
            In an example, only Windows takes a backslash as a separator: Pinocchio, Drake and PyBullet refuse the robot; Isaac and \
            Newton leave out the collision.",
        Code::LNT028 => "\
            In examples of it:\n\n- the file is called `Box.STL`: MuJoCo, Pinocchio, Drake and PyBullet refuse the robot; Isaac and \
            Newton leave out the collision.\n- the file is `meshes/Box.STL` there: MuJoCo, Pinocchio, Drake and PyBullet refuse the \
            robot; Isaac and Newton leave out the collision.\n- the file is `textures/Wood.png` there: Drake refuses the robot; \
            Isaac and Newton leave out the material.",
        Code::LNT029 => "\
            In examples of it:\n\n- the file is not there: MuJoCo, Pinocchio, Drake and PyBullet refuse the robot; Isaac and Newton \
            leave out the collision.\n- the name has no package, which stands after `package://`: Pinocchio, Drake and PyBullet \
            refuse the robot; Isaac and Newton leave out the collision.",
        Code::LNT030 => "\
            In an example, the texture is not there: Drake refuses the robot; Isaac and Newton leave out the material.",
        Code::LNT033 => "\
            In examples of it:\n\n- the box has a size of 0: MuJoCo and Drake refuse the robot.\n- the cylinder has a size of 0: \
            MuJoCo and Drake refuse the robot.",
        Code::LNT034 => "\
            In examples of it:\n\n- the STL is text: MuJoCo refuses the robot; PyBullet leaves out the collision.\n- the STL is cut \
            off: MuJoCo and Pinocchio refuse the robot; PyBullet leaves out the collision.",
        Code::LNT035 => "\
            In an example, the mesh cannot be read: this is a Git LFS pointer: `git lfs pull` fetches the file that it stands for: \
            MuJoCo and Pinocchio refuse the robot; PyBullet and Isaac and Newton leave out the collision.",
        Code::LNT040 => "\
            In examples of it:\n\n- `<inertial>` has no ixz: MuJoCo refuses the robot; ROS, Gazebo and Pinocchio leave out the \
            inertial.\n- the joint has no `<limit>`: ROS, Gazebo, Pinocchio and PyBullet refuse the robot; MuJoCo reads `no limit`; \
            Isaac and Newton and three.js read `locked at 0`.\n- no link has a mass: Gazebo refuses the robot.\n- `<inertial>` has \
            no `<mass>`: MuJoCo and PyBullet refuse the robot; ROS, Gazebo and Pinocchio leave out the inertial; Drake reads `a \
            sphere of water of 1 kg`.\n- `<joint>` does not have a `<parent>`: ROS, Gazebo, MuJoCo, Pinocchio, Drake, PyBullet, \
            Isaac and Newton and three.js refuse the robot.",
        Code::LNT041 => "\
            In an example, material `red` is not defined in `<robot>`, nor in a link before this one: Drake refuses the robot; ROS, \
            Gazebo, Pinocchio and PyBullet leave out the material; Isaac and Newton read `black and transparent`; three.js reads \
            `white`.",
        Code::LNT042 => "\
            In an example, no joint is called `trun`, but there is `turn`: Drake refuses the robot.",
        Code::LNT043 => "\
            In an example, no joint is called `trun`, but there is `turn`: ros2_control jazzy refuses the robot.",
        Code::LNT048 => "\
            In an example, the colour is not red, green, blue and opacity from 0 to 1: Drake refuses the robot; ROS, Gazebo and \
            Pinocchio leave out the material.",
        Code::LNT051 => "\
            In an example, this is a xacro file, and programs take its macros as text: ROS, Gazebo, MuJoCo, Pinocchio, Drake and \
            Isaac and Newton refuse the robot; PyBullet reads `0`; three.js reads `NaN`.",
        _ => "",
    }
}
