//! Nearly degenerate inertias, as they are written: plates, rods and points, in any direction and of any size.

use nalgebra::{Matrix3, Rotation3, Vector3};
use urdd_export::Format;
use urdd_export::inertia::held;
use urdd_xml::Node;
use urdd_xml::number::number;

use crate::made::{exported, robot, urdf};

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }
}

/// Moments whose largest is the sum of the others but for the last digits, in a frame that is turned in half of them.
fn degenerate(random: &mut Random) -> [f64; 6] {
    let size = 10_f64.powf(random.next() * 10.0 - 8.0);
    let a = match random.next() {
        few if few < 0.2 => 0.0,
        few if few < 0.4 => 1e-12,
        _ => random.next(),
    };
    let b = random.next() + 0.1;
    let off = (random.next() - 0.5) * 10_f64.powf(random.next() * 6.0 - 16.0);
    let mut moments = Vector3::new(a, b, (a + b) * (1.0 + off)) * size;
    moments.as_mut_slice().rotate_left((random.next() * 3.0) as usize);
    let angles = match random.next() < 0.5 {
        true => [0.0; 3],
        false => [random.next(), random.next(), random.next()],
    };
    let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
    let tensor = turn * Matrix3::from_diagonal(&moments) * turn.inverse();
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| tensor[at])
}

/// Whether each is at most the sum of the others, as a program computes it.
fn is_held(moments: [f64; 3]) -> bool {
    let [a, b, c] = moments;
    a + b >= c && b + c >= a && c + a >= b
}

/// As `is_held` for a diagonal tensor, and otherwise with room for a reader's rounding, relative to the largest.
fn is_tensor_held([xx, xy, xz, yy, yz, zz]: [f64; 6], room: f64) -> bool {
    if [xy, xz, yz] == [0.0; 3] {
        return is_held([xx, yy, zz]);
    }
    // libsdformat 12 refuses what has less than 5e-8.
    let moments = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz).symmetric_eigenvalues();
    moments.sum() - 2.0 * moments.max() > room * moments.max()
}

fn numbers(text: &str) -> Vec<f64> {
    text.split(' ').map(|word| word.parse().expect("a number")).collect()
}

#[test]
fn written_inertias_hold_the_triangle_inequality() {
    let mut random = Random(7);
    let mut parts = String::from("<link name=\"base\"/>");
    let count = 400;
    for index in 0..count {
        let [xx, xy, xz, yy, yz, zz] = degenerate(&mut random).map(number);
        let [roll, pitch] = [0, 1].map(|_| if random.next() < 0.5 { 0.0 } else { random.next() });
        parts += &format!(
            "<link name=\"l{index}\"><inertial><origin rpy=\"{roll} {pitch} 0\"/><mass value=\"1\"/>\
             <inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial></link>\
             <joint name=\"j{index}\" type=\"continuous\"><parent link=\"base\"/><child link=\"l{index}\"/><axis xyz=\"0 0 1\"/></joint>"
        );
    }
    let (_folder, robot) = robot(&urdf(&parts));
    let text = exported(&robot, Format::Mjcf).text;
    assert!(!text.contains("balanceinertia"), "what is rounding is not averaged");
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("XML");
    let mut seen = 0;
    for node in document.descendants().filter(|node| node.has_tag_name("inertial")) {
        if let Some(moments) = node.attribute("diaginertia").map(numbers) {
            assert!(is_held([moments[0], moments[1], moments[2]]), "{moments:?}");
        } else {
            let [xx, yy, zz, xy, xz, yz] =
                numbers(node.attribute("fullinertia").expect("an inertia"))[..].try_into().unwrap();
            assert!(is_tensor_held([xx, xy, xz, yy, yz, zz], 5e-10));
        }
        seen += 1;
    }
    assert_eq!(seen, count);
    const KEYS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    for format in [Format::Urdf, Format::Drake, Format::Sdf] {
        let made = exported(&robot, format);
        let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
        let value = |node: Node, key: &str| -> f64 {
            let child = node.children().find(|child| child.has_tag_name(key));
            let text = node.attribute(key).or_else(|| child?.text()).expect("a value");
            text.parse().expect("a number")
        };
        let links = document.descendants().filter(|node| node.has_tag_name("inertia"));
        let tensors: Vec<[f64; 6]> = links.map(|node| KEYS.map(|key| value(node, key))).collect();
        assert!(
            tensors.len() >= count
                && tensors.into_iter().all(|tensor| is_tensor_held(tensor, 9e-8)),
            "{format:?}"
        );
        assert!(
            !made.notes.iter().any(|note| note.to_string().contains("no body has")),
            "{format:?}"
        );
    }
}

#[test]
fn what_is_right_stays_and_what_is_wrong_is_told() {
    for right in [[0.1, 0.0, 0.0, 0.2, 0.0, 0.3], [1.0, 0.1, 0.0, 1.0, 0.0, 1.0], [0.0; 6]] {
        assert_eq!(held(right, false), Some(right));
    }
    for wrong in [[1.0, 0.0, 0.0, 1.0, 0.0, 2.1], [-1.0, 0.0, 0.0, 1.0, 0.0, 1.0]] {
        assert_eq!(held(wrong, false), None);
    }
    let rod = held([0.0, 0.0, 0.0, 1.0, 0.0, 1.0], true).expect("an inertia");
    assert!(rod[0] > 0.0 && rod[0] < 1e-6 && (rod[3] - 1.0).abs() < 1e-6);
}
