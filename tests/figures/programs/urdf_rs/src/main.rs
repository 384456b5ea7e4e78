//! Driver: urdf-rs 0.10.0, `read_file`. Protocol: paths on stdin, JSON lines on stdout.
//! Build: nice cargo build --offline -j1 (in this folder); the program is target/debug/drive_urdfrs
use std::collections::BTreeMap;
use std::io::{BufRead, Write};
use urdf_rs::{Geometry, JointType, Pose};

fn num(v: f64) -> String {
    // '%.7g'
    if v == 0.0 {
        return "0".into();
    }
    if !v.is_finite() {
        return if v.is_nan() { "nan".into() } else if v > 0.0 { "inf".into() } else { "-inf".into() };
    }
    let e = format!("{v:.6e}");
    let (m, x) = e.split_once('e').unwrap();
    let x: i32 = x.parse().unwrap();
    let trim = |s: &str| -> String {
        if s.contains('.') { s.trim_end_matches('0').trim_end_matches('.').to_string() } else { s.to_string() }
    };
    if !(-4..7).contains(&x) {
        format!("{}e{}{:02}", trim(m), if x < 0 { '-' } else { '+' }, x.abs())
    } else {
        trim(&format!("{v:.*}", (6 - x).max(0) as usize))
    }
}
fn nums(v: &[f64]) -> String {
    v.iter().map(|x| num(*x)).collect::<Vec<_>>().join(" ")
}
fn quat(rpy: &[f64; 3]) -> [f64; 4] {
    let (sr, cr) = (rpy[0] / 2.).sin_cos();
    let (sp, cp) = (rpy[1] / 2.).sin_cos();
    let (sy, cy) = (rpy[2] / 2.).sin_cos();
    let q = [
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ];
    let neg = q.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0);
    if neg { q.map(|x| -x) } else { q }
}
fn pose(p: &Pose) -> String {
    let q = quat(&p.rpy);
    nums(&[p.xyz[0], p.xyz[1], p.xyz[2], q[0], q[1], q[2], q[3]])
}
fn geometry(g: &Geometry) -> String {
    match g {
        Geometry::Box { size } => format!("box {}", nums(&size[..])),
        Geometry::Cylinder { radius, length } => format!("cylinder {} {}", num(*radius), num(*length)),
        Geometry::Capsule { radius, length } => format!("capsule {} {}", num(*radius), num(*length)),
        Geometry::Sphere { radius } => format!("sphere {}", num(*radius)),
        Geometry::Mesh { filename, scale } => {
            let f = filename.rsplit('/').next().unwrap_or("");
            format!("mesh {} {}", f, scale.map_or("1 1 1".into(), |s| nums(&s[..])))
        }
    }
}
fn json(s: &str) -> String {
    let mut o = String::from("\"");
    for c in s.chars() {
        match c {
            '"' => o.push_str("\\\""),
            '\\' => o.push_str("\\\\"),
            c if (c as u32) < 0x20 => o.push_str(&format!("\\u{:04x}", c as u32)),
            c => o.push(c),
        }
    }
    o.push('"');
    o
}
fn material(f: &mut BTreeMap<String, String>, k: &str, m: &urdf_rs::Material) {
    if let Some(c) = &m.color {
        f.insert(format!("{k}/color"), nums(&c.rgba[..]));
    }
    if let Some(t) = &m.texture {
        f.insert(format!("{k}/texture"), t.filename.clone());
    }
}
fn facts(r: &urdf_rs::Robot) -> BTreeMap<String, String> {
    let mut f = BTreeMap::new();
    f.insert("robot".into(), r.name.clone());
    for l in &r.links {
        let k = format!("link/{}", l.name);
        f.insert(k.clone(), "1".into());
        let i = &l.inertial;
        f.insert(format!("{k}/inertial"), "1".into());
        f.insert(format!("{k}/inertial/mass"), num(i.mass.value));
        f.insert(format!("{k}/inertial/com"), nums(&i.origin.xyz[..]));
        // in link axes: R I R^T
        let q = quat(&i.origin.rpy);
        let (w, x, y, z) = (q[0], q[1], q[2], q[3]);
        let m = [
            [1. - 2. * (y * y + z * z), 2. * (x * y - w * z), 2. * (x * z + w * y)],
            [2. * (x * y + w * z), 1. - 2. * (x * x + z * z), 2. * (y * z - w * x)],
            [2. * (x * z - w * y), 2. * (y * z + w * x), 1. - 2. * (x * x + y * y)],
        ];
        let t = &i.inertia;
        let a = [[t.ixx, t.ixy, t.ixz], [t.ixy, t.iyy, t.iyz], [t.ixz, t.iyz, t.izz]];
        let at = |r: usize, c: usize| -> f64 {
            (0..3).map(|p| (0..3).map(|s| m[r][p] * a[p][s] * m[c][s]).sum::<f64>()).sum()
        };
        f.insert(
            format!("{k}/inertial/inertia"),
            nums(&[at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)]),
        );
        f.insert(format!("{k}/visual"), l.visual.len().to_string());
        for (n, v) in l.visual.iter().enumerate() {
            let k = format!("{k}/visual/{n}");
            f.insert(format!("{k}/geometry"), geometry(&v.geometry));
            f.insert(format!("{k}/origin"), pose(&v.origin));
            if let Some(n) = &v.name {
                f.insert(format!("{k}/name"), n.clone());
            }
            if let Some(m) = &v.material {
                material(&mut f, &k, m);
            }
        }
        f.insert(format!("{k}/collision"), l.collision.len().to_string());
        for (n, v) in l.collision.iter().enumerate() {
            let k = format!("{k}/collision/{n}");
            f.insert(format!("{k}/geometry"), geometry(&v.geometry));
            f.insert(format!("{k}/origin"), pose(&v.origin));
            if let Some(n) = &v.name {
                f.insert(format!("{k}/name"), n.clone());
            }
        }
    }
    for j in &r.joints {
        let k = format!("joint/{}", j.name);
        let t = match j.joint_type {
            JointType::Revolute => "revolute",
            JointType::Continuous => "continuous",
            JointType::Prismatic => "prismatic",
            JointType::Fixed => "fixed",
            JointType::Floating => "floating",
            JointType::Planar => "planar",
            JointType::Spherical => "spherical",
        };
        f.insert(k.clone(), t.into());
        f.insert(format!("{k}/parent"), j.parent.link.clone());
        f.insert(format!("{k}/child"), j.child.link.clone());
        f.insert(format!("{k}/origin"), pose(&j.origin));
        f.insert(format!("{k}/axis"), nums(&j.axis.xyz[..]));
        let l = &j.limit;
        for (n, v) in [
            ("lower", l.lower),
            ("upper", l.upper),
            ("effort", l.effort),
            ("velocity", l.velocity),
            ("acceleration", l.acceleration),
            ("deceleration", l.deceleration),
            ("jerk", l.jerk),
        ] {
            f.insert(format!("{k}/{n}"), num(v));
        }
        if let Some(d) = &j.dynamics {
            f.insert(format!("{k}/damping"), num(d.damping));
            f.insert(format!("{k}/friction"), num(d.friction));
        }
        if let Some(m) = &j.mimic {
            f.insert(
                format!("{k}/mimic"),
                format!("{} {} {}", m.joint, num(m.multiplier.unwrap_or(1.)), num(m.offset.unwrap_or(0.))),
            );
        }
        if let Some(s) = &j.safety_controller {
            f.insert(
                format!("{k}/safety"),
                nums(&[s.soft_lower_limit, s.soft_upper_limit, s.k_position, s.k_velocity]),
            );
        }
        if let Some(c) = &j.calibration {
            let o = |v: Option<f64>| v.map_or("-".into(), num);
            f.insert(format!("{k}/calibration"), format!("{} {}", o(c.rising), o(c.falling)));
        }
    }
    for m in &r.materials {
        let v = m
            .color
            .as_ref()
            .map(|c| nums(&c.rgba[..]))
            .or(m.texture.as_ref().map(|t| t.filename.clone()))
            .unwrap_or_default();
        f.insert(format!("material/{}", m.name), v);
    }
    f
}
fn main() {
    let mut out = std::io::stdout().lock();
    for path in std::io::stdin().lock().lines() {
        let path = path.unwrap();
        let line = match urdf_rs::read_file(&path) {
            Ok(r) => {
                let f = facts(&r)
                    .iter()
                    .map(|(k, v)| format!("{}:{}", json(k), json(v)))
                    .collect::<Vec<_>>()
                    .join(",");
                format!("{{\"verdict\":\"loads\",\"why\":\"\",\"facts\":{{{f}}},\"said\":[]}}")
            }
            Err(e) => {
                let e = e.to_string();
                format!(
                    "{{\"verdict\":\"refuses\",\"why\":{},\"facts\":{{}},\"said\":[]}}",
                    json(e.lines().next().unwrap_or(""))
                )
            }
        };
        writeln!(out, "{line}").unwrap();
        out.flush().unwrap();
    }
}
