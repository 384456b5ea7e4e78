//! Convex decomposition, compared with closed forms and its documented guarantees.

use proptest::prelude::*;
use urdd_geometry::Mesh;
use urdd_geometry::decompose::{Settings, decompose};
use urdd_geometry::hull::ConvexHull;

use crate::dice::trials;

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Signed volume by the divergence theorem.
pub(crate) fn volume(m: &Mesh) -> f64 {
    m.triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| m.vertices[i as usize]);
            dot(a, cross(b, c)) / 6.0
        })
        .sum()
}

/// The maximum distance of a point outside a convex mesh's planes: a lower bound of the distance. Flat pieces have
/// their two sides as planes; their rim is not checked here.
fn above(m: &Mesh, p: [f64; 3]) -> f64 {
    m.triangles
        .iter()
        .filter_map(|t| {
            let [a, b, c] = t.map(|i| m.vertices[i as usize]);
            let n = cross(sub(b, a), sub(c, a));
            let l = dot(n, n).sqrt();
            (l > 1e-14).then(|| dot(n, sub(p, a)) / l)
        })
        .fold(f64::NEG_INFINITY, f64::max)
}

pub(crate) fn push_box(m: &mut Mesh, low: [f64; 3], high: [f64; 3]) {
    let base = m.vertices.len() as u32;
    for i in 0..8 {
        m.vertices.push([0, 1, 2].map(|a| if i >> a & 1 == 1 { high[a] } else { low[a] }));
    }
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [0, 1, 4],
        [1, 5, 4],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
        [2, 6, 3],
        [3, 6, 7],
        [4, 5, 6],
        [5, 7, 6],
    ];
    m.triangles.extend(faces.map(|f: [u32; 3]| f.map(|i| i + base)));
}

/// A prism over a simple polygon, given with a triangulation of its own.
pub(crate) fn prism(outline: &[[f64; 2]], ears: &[[u32; 3]], height: f64) -> Mesh {
    let n = outline.len() as u32;
    let mut m = Mesh::default();
    for z in [0.0, height] {
        m.vertices.extend(outline.iter().map(|p| [p[0], p[1], z]));
    }
    for &[a, b, c] in ears {
        m.triangles.push([a, c, b]);
        m.triangles.push([a + n, b + n, c + n]);
    }
    for i in 0..n {
        let j = (i + 1) % n;
        m.triangles.push([i, j, j + n]);
        m.triangles.push([i, j + n, i + n]);
    }
    m
}

/// A torus about z, or the wall of a tube if `profile` is a rectangle: a closed profile, revolved.
pub(crate) fn turned(profile: &[[f64; 2]], steps: u32) -> Mesh {
    let n = profile.len() as u32;
    let mut m = Mesh::default();
    for k in 0..steps {
        let a = std::f64::consts::TAU * f64::from(k) / f64::from(steps);
        m.vertices.extend(profile.iter().map(|p| [p[0] * a.cos(), p[0] * a.sin(), p[1]]));
        for i in 0..n {
            let (j, next) = ((i + 1) % n, (k + 1) % steps * n);
            m.triangles.push([k * n + i, next + i, next + j]);
            m.triangles.push([k * n + i, next + j, k * n + j]);
        }
    }
    m
}

pub(crate) fn ring(r: f64, tube: f64, steps: u32) -> Vec<[f64; 2]> {
    (0..steps)
        .map(|k| {
            let a = -std::f64::consts::TAU * f64::from(k) / f64::from(steps);
            [r + tube * a.cos(), tube * a.sin()]
        })
        .collect()
}

/// Points on the triangles: corners, middles and a few more.
fn surface_points(m: &Mesh) -> Vec<[f64; 3]> {
    let weights = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.4, 0.3, 0.3],
        [0.1, 0.2, 0.7],
        [0.5, 0.5, 0.0],
    ];
    m.triangles
        .iter()
        .flat_map(|t| {
            let [a, b, c] = t.map(|i| m.vertices[i as usize]);
            weights.map(|w| [0, 1, 2].map(|i| w[0] * a[i] + w[1] * b[i] + w[2] * c[i]))
        })
        .collect()
}

/// Every surface point is in a piece to within the tolerance; each piece is convex, closed and in the link's hull.
pub(crate) fn check(m: &Mesh, settings: &Settings) -> Vec<Mesh> {
    let d = decompose(m, settings);
    assert!(d.pieces.len() <= settings.max_pieces.max(1), "{} pieces", d.pieces.len());
    let size = m.vertices.iter().flatten().fold(0.0_f64, |s, x| s.max(x.abs()));
    let rounding = 1e-6 * size; // some units of f32 at this size
    for p in surface_points(m) {
        let out = d.pieces.iter().map(|q| above(q, p)).fold(f64::INFINITY, f64::min);
        assert!(out <= d.surface_tolerance + rounding, "{p:?} is {out} outside");
    }
    let all = ConvexHull::new(&m.vertices).expect("a hull").into_mesh();
    for q in &d.pieces {
        let mut edges: Vec<[u32; 2]> =
            q.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        let mut twins: Vec<[u32; 2]> = edges.iter().map(|&[a, b]| [b, a]).collect();
        edges.sort_unstable();
        twins.sort_unstable();
        assert_eq!(edges, twins, "not closed");
        for &v in &q.vertices {
            assert!(above(q, v) <= rounding, "not convex: {}", above(q, v));
            assert!(above(&all, v) <= rounding, "out of the hull by {}", above(&all, v));
        }
    }
    d.pieces
}

pub(crate) fn exact() -> Settings {
    Settings { surface_tolerance: 0.0, ..Settings::default() }
}

#[test]
fn a_convex_link_is_one_piece() {
    let mut cube = Mesh::default();
    push_box(&mut cube, [0.0; 3], [0.1, 0.2, 0.3]);
    let pieces = check(&cube, &exact());
    assert_eq!(pieces.len(), 1);
    assert!((volume(&pieces[0]) - 0.006).abs() < 1e-9);
    let n = 32;
    let half: Vec<[f64; 2]> = (0..=n / 2)
        .map(|k| std::f64::consts::PI * (f64::from(k) / f64::from(n / 2) - 0.5))
        .map(|a| [0.05 * a.cos(), 0.05 * a.sin()])
        .collect();
    assert_eq!(check(&turned(&half, n), &Settings::default()).len(), 1);
}

#[test]
fn an_l_is_two_boxes() {
    let outline = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.1, 0.1], [0.1, 0.3], [0.0, 0.3]];
    let l = prism(&outline, &[[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]], 0.05);
    assert!((volume(&l) - 0.002).abs() < 1e-12, "the test's own mesh");
    let pieces = check(&l, &exact());
    assert_eq!(pieces.len(), 2);
    let sum: f64 = pieces.iter().map(volume).sum();
    assert!((sum - 0.002).abs() < 1e-8, "{sum}");
}

#[test]
fn two_bodies_are_two_pieces() {
    let mut two = Mesh::default();
    push_box(&mut two, [0.0; 3], [0.1; 3]);
    push_box(&mut two, [0.3, 0.0, 0.0], [0.4, 0.1, 0.1]);
    let pieces = check(&two, &exact());
    assert_eq!(pieces.len(), 2);
    assert!(pieces.iter().all(|p| (volume(p) - 0.001).abs() < 1e-8));
}

#[test]
fn a_ring_keeps_its_hole() {
    let torus = turned(&ring(0.1, 0.02, 16), 48);
    let settings = Settings { max_pieces: 12, ..Settings::default() };
    let pieces = check(&torus, &settings);
    assert!(pieces.iter().all(|p| above(p, [0.0; 3]) > 0.0), "the hole is filled");
    // 2 pi^2 R r^2, and the hull's: a disc with a rounded rim, pi (R+r)^2 2r less the rim's corners.
    let (solid, sum) =
        (2.0 * std::f64::consts::PI.powi(2) * 0.1 * 0.0004, pieces.iter().map(volume).sum::<f64>());
    assert!(sum < 1.35 * solid, "{} times the solid", sum / solid);
}

#[test]
fn a_tube_is_not_a_rod() {
    let tube = turned(&[[0.08, 0.1], [0.1, 0.1], [0.1, -0.1], [0.08, -0.1]], 48);
    let pieces = check(&tube, &Settings { max_pieces: 12, ..Settings::default() });
    assert!(pieces.iter().all(|p| above(p, [0.0; 3]) > 0.0), "the bore is filled");
}

#[test]
fn odd_meshes_are_taken() {
    let flat = Mesh {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    assert_eq!(check(&flat, &exact()).len(), 1);
    let none = decompose(&Mesh::default(), &Settings::default());
    assert!(none.pieces.is_empty());
    let bad = Mesh { vertices: vec![[f64::NAN; 3]; 3], triangles: vec![[0, 1, 2], [7, 8, 9]] };
    assert_eq!(
        (
            decompose(&bad, &Settings::default()).pieces.len(),
            decompose(&bad, &Settings::default()).ignored_triangles
        ),
        (0, 2)
    );
    for scale in [1e-9, 1e-3, 1e6, 1e30] {
        let mut m = Mesh::default();
        push_box(&mut m, [0.0; 3], [scale; 3]);
        assert_eq!(decompose(&m, &Settings::default()).pieces.len(), 1, "at {scale}");
    }
    // A point, a line, and a needle's tip.
    for v in [
        [[1.0; 3]; 3],
        [[0.0; 3], [1.0; 3], [2.0; 3]],
        [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1e-12, 0.0]],
    ] {
        decompose(&Mesh { vertices: v.to_vec(), triangles: vec![[0, 1, 2]] }, &Settings::default());
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let mut m = turned(&ring(0.1, 0.02, 24), 96);
    push_box(&mut m, [-0.05; 3], [0.05; 3]);
    let run = |n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| decompose(&m, &Settings::default()))
    };
    let one = run(1);
    assert!(one.pieces.len() > 1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(8));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: trials(10), failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn soups_are_covered(
        corners in prop::collection::vec([-1.0_f32..1.0, -1.0_f32..1.0, -0.3_f32..0.3], 9..120),
        scale in prop::sample::select(vec![0.01, 0.1, 1.0]),
        pieces in 1_usize..10,
    ) {
        let vertices: Vec<[f64; 3]> = corners.iter().map(|c| c.map(|x| f64::from(x * scale))).collect();
        let n = vertices.len() as u32;
        let triangles = (0..n / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        check(&Mesh { vertices, triangles }, &Settings { max_pieces: pieces, ..Settings::default() });
    }
}

/// A box of these half sides, turned about the three axes and moved.
fn turned_box(half: [f64; 3], rpy: [f64; 3], xyz: [f64; 3]) -> Mesh {
    let mut m = Mesh::default();
    push_box(&mut m, half.map(|h| -h), half);
    let rotation = nalgebra::Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
    for v in &mut m.vertices {
        *v = (rotation * nalgebra::Vector3::from(*v) + nalgebra::Vector3::from(xyz)).into();
    }
    m
}

proptest! {
    #![proptest_config(ProptestConfig { cases: trials(80), failure_persistence: None, ..ProptestConfig::default() })]
    /// Cuts in any direction through bodies with an interior: vertices added at a cut stay in the hull.
    #[test]
    fn pieces_of_boxes_that_cross_are_in_their_hull(
        boxes in proptest::collection::vec(
            ([0.05..1.0, 0.05..1.0, 0.05..1.0], [-3.0..3.0, -1.5..1.5, -3.0..3.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0]),
            2..5,
        ),
    ) {
        let mut m = Mesh::default();
        for (half, rpy, xyz) in boxes {
            let other = turned_box(half, rpy, xyz);
            let base = m.vertices.len() as u32;
            m.vertices.extend(other.vertices);
            m.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + base)));
        }
        check(&m, &Settings::default());
    }
}
