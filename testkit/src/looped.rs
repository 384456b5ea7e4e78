//! Robots with kinematic loops, as URDF+.

use std::f64::consts::TAU;
use std::path::PathBuf;

/// The lengths of a four-bar, m: between the ground's hinges, of crank, coupler and rocker.
pub const FOUR_BAR: [f64; 4] = [0.4, 0.12, 0.35, 0.25];

/// A link of a box, so that it has a shape and a mass.
fn link(name: &str, size: [f64; 3], at: [f64; 3]) -> String {
    let [[a, b, c], [x, y, z]] = [size, at];
    format!(
        r#"<link name="{name}"><inertial><origin xyz="{x} {y} {z}"/><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
<visual><origin xyz="{x} {y} {z}"/><geometry><box size="{a} {b} {c}"/></geometry></visual></link>
"#
    )
}

fn joint(
    name: &str,
    kind: &str,
    [parent, child]: [&str; 2],
    xyz: [f64; 3],
    (axis, limits): (&str, Option<[f64; 2]>),
) -> String {
    let [x, y, z] = xyz;
    let limit = limits.map_or_else(String::new, |[lower, upper]| {
        format!(r#"<limit lower="{lower}" upper="{upper}" effort="100" velocity="2"/>"#)
    });
    format!(
        r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{x} {y} {z}"/><axis xyz="{axis}"/>{limit}</joint>
"#
    )
}

/// A four-bar of hinges along z, whose bars are boxes one above the other. Its DOFs are `crank`, `coupler` and `rocker`, of
/// which the first is independent; `more` is added to the robot.
pub fn four_bar([ground, crank, coupler, rocker]: [f64; 4], more: &str) -> String {
    let bar =
        |name: &str, length: f64, z: f64| link(name, [length, 0.02, 0.02], [0.5 * length, 0.0, z]);
    let turns = |name: &str, parent: &str, x: f64| {
        let child = format!("{name}_link");
        joint(name, "continuous", [parent, &child], [x, 0.0, 0.0], ("0 0 1", None))
    };
    [
        r#"<robot name="four_bar">"#.to_owned(),
        bar("ground", ground, -0.05),
        bar("crank_link", crank, 0.0),
        bar("coupler_link", coupler, 0.05),
        bar("rocker_link", rocker, 0.1),
        turns("crank", "ground", 0.0),
        turns("coupler", "crank_link", crank),
        turns("rocker", "ground", ground),
        format!(
            r#"<loop name="pin" type="revolute"><predecessor link="coupler_link"><origin xyz="{coupler} 0 0"/></predecessor>
<successor link="rocker_link"><origin xyz="{rocker} 0 0"/></successor><axis xyz="0 0 1"/></loop>"#
        ),
        format!("{more}</robot>"),
    ]
    .concat()
}

/// The angles of coupler and rocker of a four-bar at one of its crank, by the law of cosines: the circles about the crank's
/// end and about the rocker's hinge meet in two points, of which `side` (1 or -1) chooses one. NaN where they do not meet.
pub fn four_bar_at([ground, crank, coupler, rocker]: [f64; 4], angle: f64, side: f64) -> [f64; 3] {
    let [x, y] = [ground - crank * angle.cos(), -crank * angle.sin()];
    let far = x.hypot(y);
    let cosine = (rocker * rocker + far * far - coupler * coupler) / (2.0 * rocker * far);
    let turned = (-y).atan2(-x) + side * cosine.acos();
    let along = [
        ground + rocker * turned.cos() - crank * angle.cos(),
        rocker * turned.sin() - crank * angle.sin(),
    ];
    [angle, along[1].atan2(along[0]) - angle, turned]
}

/// A leg of six rods that grow and shrink, between a hip and a foot: a Stewart platform. The foot is on the first rod, by a
/// ball; five balls more close its loops. The lengths `rod_K` are independent; there are 21 DOFs.
pub fn leg() -> String {
    let round = |k: usize, radius: f64, aside: f64| {
        // Pairs of rods are together at the hip and apart at the foot.
        let angle = TAU * ((k / 2) as f64 / 3.0) + if k.is_multiple_of(2) { -aside } else { aside };
        [radius * angle.cos(), radius * angle.sin(), 0.0]
    };
    let mut all = vec![r#"<robot name="leg">"#.to_owned()];
    all.push(link("hip", [0.3, 0.3, 0.02], [0.0, 0.0, 0.03]));
    all.push(link("foot", [0.2, 0.2, 0.02], [0.0, 0.0, 0.03]));
    for k in 0..6 {
        let names = ["tilt", "swing", "rod"].map(|name| format!("{name}_{k}"));
        let links = names.each_ref().map(|name| format!("{name}_link"));
        all.extend(links[..2].iter().map(|name| link(name, [0.01; 3], [0.0; 3])));
        all.push(link(&links[2], [0.01, 0.01, 0.2], [0.0, 0.0, -0.1]));
        let (turns, slides) = (Some([-1.0, 1.0]), Some([0.35, 0.75]));
        let at = round(k, 0.2, 0.2);
        all.push(joint(&names[0], "revolute", ["hip", &links[0]], at, ("1 0 0", turns)));
        let pair = [&*links[0], &links[1]];
        all.push(joint(&names[1], "revolute", pair, [0.0; 3], ("0 1 0", turns)));
        let pair = [&*links[1], &links[2]];
        all.push(joint(&names[2], "prismatic", pair, [0.0; 3], ("0 0 1", slides)));
        let [x, y, _] = round(k, 0.12, 0.8);
        all.push(if k == 0 {
            // The ball is in the foot's frame where the rod ends.
            let ball = joint("ball", "spherical", [&*links[2], "ball_link"], [0.0; 3], ("0 0 1", None));
            let held = joint("held", "fixed", ["ball_link", "foot"], [-x, -y, 0.0], ("0 0 1", None));
            format!("<link name=\"ball_link\"/>{ball}{held}")
        } else {
            format!(
                r#"<loop name="ball_{k}" type="spherical"><predecessor link="{}"/><successor link="foot"><origin xyz="{x} {y} 0"/></successor></loop>
"#,
                links[2]
            )
        });
    }
    all.push("</robot>".to_owned());
    let follows = |kind: &str| format!("type=\"{kind}\" independent=\"false\"");
    let all = all.concat().replace("type=\"revolute\"", &follows("revolute"));
    all.replacen(
        "name=\"ball\" type=\"spherical\"",
        &format!("name=\"ball\" {}", follows("spherical")),
        1,
    )
}

/// As [`made_of`](crate::robots::made_of), with a `.loops.toml` beside the URDF.
pub fn made_with_loops(urdf: &str, toml: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = crate::temporary::folder();
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, urdf).expect("a file");
    std::fs::write(folder.path().join("robot.loops.toml"), toml).expect("a file");
    let target = folder.path().join("robot");
    urdd_generate::generate(&file, &target, &Default::default(), &()).expect("a URDD");
    (folder, target)
}
