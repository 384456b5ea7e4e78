//! Spheres of links: what the validator computes of them, by other ways, and how much work it takes.

use nalgebra::Vector3;
use rayon::ThreadPoolBuilder;
use serde_json::{Value, json};
use testkit::fixture::Fixture;
use testkit::meshes::{Solid as Cuboid, TRIANGLES};
use testkit::spheres::{SPHERES, diagonal, fixture};
use urdd_document::urdd::Urdd;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_geometry::Mesh;
use urdd_validate::code::Code::{self, *};
use urdd_validate::reference::samples::{Budget, Poses};
use urdd_validate::reference::spheres::cells::{Polyhedron, uncovered};
use urdd_validate::reference::spheres::contacts::contacts;
use urdd_validate::reference::spheres::fit::{
    self, Ball, LinkPieces, Solid, standoff, to_triangle,
};
use urdd_validate::rules;
use urdd_validate::settings::Settings;
use urdd_validate::skip;
use urdd_validate::{validate_source, validate_with};

/// Numbers from 0 to 1, the same in each run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn point(&mut self, half: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-half, half))
    }
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12, "{a} {b}");
}

/// A box around the origin as a mesh.
fn cuboid(half: [f64; 3]) -> Mesh {
    let corner =
        |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { -half[axis] } else { half[axis] });
    Mesh {
        vertices: (0..8).map(corner).collect(),
        triangles: TRIANGLES.iter().map(|t| t.map(u32::from)).collect(),
    }
}

#[test]
fn the_distance_of_a_point_from_a_box_is_that_of_its_closed_form() {
    let mut numbers = Numbers(1);
    for _ in 0..200 {
        let half = [0.0; 3].map(|_| numbers.between(0.01, 1.0));
        let solid = Solid::new(&cuboid(half)).expect("a hull");
        for _ in 0..20 {
            let point = numbers.point(1.5);
            let beyond = Vector3::from_fn(|k, _| (point[k].abs() - half[k]).max(0.0));
            close(solid.distance(&point, f64::INFINITY), beyond.norm());
            // Not less than a limit that it is not below.
            let limit = beyond.norm() / 2.0;
            assert!(solid.distance(&point, limit) >= limit);
        }
    }
}

#[test]
fn the_distance_of_a_point_from_a_flat_piece_is_that_from_its_rectangle() {
    let solid = Solid::new(&cuboid([0.5, 0.25, 0.0])).expect("a hull");
    let mut numbers = Numbers(2);
    for k in 0..200 {
        let mut point = numbers.point(1.0);
        // In its plane too, inside of it or not.
        point.z *= f64::from(k % 2);
        let beyond =
            Vector3::new((point.x.abs() - 0.5).max(0.0), (point.y.abs() - 0.25).max(0.0), point.z);
        close(solid.distance(&point, f64::INFINITY), beyond.norm());
    }
}

#[test]
fn the_distance_of_a_point_from_a_triangle() {
    let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(Vector3::from);
    for (point, expected) in [
        ([1.0, 1.0, 2.0], 2.0),
        ([-3.0, -4.0, 12.0], 13.0),
        ([1.0, -2.0, 0.0], 2.0),
        // Beyond the longest edge, 3 x / 5 + 4 y / 5 - ... = 1 further out.
        ([1.5 + 0.8, 2.0 + 0.6, 0.0], 1.0),
        ([3.0 + 3.0, -4.0, 0.0], 5.0),
    ] {
        close(to_triangle(&point.into(), &corners), expected);
    }
    // Without an area.
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(Vector3::from);
    close(to_triangle(&Vector3::new(1.0, 1.0, 0.0), &flat), 1.0);
    close(to_triangle(&Vector3::new(3.0, 0.0, 0.0), &flat), 1.0);
}

#[test]
fn a_cube_that_is_cut_has_the_corners_of_what_is_left() {
    let mesh = cuboid([1.0; 3]);
    let whole = || {
        let triangles = mesh.triangles.iter();
        Polyhedron::new(triangles.map(|t| mesh.corners(*t).map(Vector3::from)), 2.0)
    };
    let corners = |of: &Polyhedron| {
        let mut found: Vec<[i64; 3]> =
            of.corners().map(|c| [0, 1, 2].map(|k| (c[k] * 1e6).round() as i64)).collect();
        found.sort_unstable();
        found.dedup();
        found.len()
    };
    let diagonal = Vector3::new(1.0, 1.0, 1.0).normalize();
    // One corner is cut off; then half of it, by a hexagon; then all.
    for (offset, count) in [(2.0 / 3.0_f64.sqrt(), 10), (0.0, 10), (-2.0 / 3.0_f64.sqrt(), 4)] {
        let mut cut = whole();
        cut.cut(&diagonal, offset);
        let cut_faces_meet_edges = corners(&cut);
        // The diagonals of the faces are edges of triangles, where there may be corners too.
        assert!(cut_faces_meet_edges >= count, "{cut_faces_meet_edges} {offset}");
        assert!(cut.corners().all(|corner| diagonal.dot(corner) <= offset + 1e-9));
    }
    let mut gone = whole();
    gone.cut(&diagonal, -2.0);
    assert_eq!(gone.corners().count(), 0);
    // Along a face, and through three planes to a point inside.
    let mut part = whole();
    part.cut(&Vector3::x(), 1.0);
    assert_eq!(part.size(), whole().size());
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        part.cut(&axis, 0.25);
    }
    let inner = Vector3::new(0.25, 0.25, 0.25);
    assert!(part.corners().any(|corner| (corner - inner).norm() < 1e-12));
}

/// Random spheres around a box: where the rule finds no point outside, none of very many points is, and where it finds one,
/// the point is in the box and outside of all spheres.
#[test]
fn a_box_is_covered_where_all_its_points_are() {
    let mut numbers = Numbers(3);
    let mut seen = [0, 0];
    for trial in 0..400 {
        let half = [0.0; 3].map(|_| numbers.between(0.05, 0.5));
        let solid = Solid::new(&cuboid(half)).expect("a hull");
        let count = 1 + trial % 12;
        let large = numbers.between(0.2, 0.8);
        let mut balls: Vec<Ball> = Vec::new();
        for k in 0..count {
            let centre = Vector3::from_fn(|axis, _| numbers.between(-half[axis], half[axis]));
            // Some are equal, some have one centre.
            let of = (k % 5 == 4).then(|| balls[k - 1]);
            let radius = large * numbers.between(0.5, 1.0);
            balls.push(match of {
                Some(of) if k % 2 == 0 => of,
                Some(of) => Ball { radius, ..of },
                None => Ball { centre, radius },
            });
        }
        let tolerance = 1e-6;
        let found =
            uncovered(&solid, &balls, tolerance, &Budget::of_spheres(false)).expect("little work");
        let lowest = |point: &Vector3<f64>| {
            balls.iter().map(|ball| ball.height(point)).fold(f64::INFINITY, f64::min)
        };
        seen[usize::from(found.is_some())] += 1;
        if let Some(found) = found {
            close(found.distance, lowest(&found.point));
            assert!(found.distance > tolerance);
            assert!((0..3).all(|k| found.point[k].abs() <= half[k] + 1e-9), "in the box");
        }
        let worst = found.map_or(tolerance, |found| found.distance);
        for _ in 0..2_000 {
            let point = Vector3::from_fn(|axis, _| numbers.between(-half[axis], half[axis]));
            let out = lowest(&point);
            // With one radius, the farthest point is a corner.
            assert!(found.is_some() || out <= worst, "{trial}: {out} {worst}");
        }
    }
    assert!(seen[0] > 40 && seen[1] > 40, "{seen:?}");
}

#[test]
fn centres_that_are_nearly_one_are_no_fault() {
    let solid = Solid::new(&cuboid([0.1; 3])).expect("a hull");
    let radius = 0.1 * 3.0_f64.sqrt();
    for apart in [0.0, 1e-300, 1e-160, 1e-20, 1e-12, 1e-8] {
        let balls = [0.0, apart].map(|x| Ball { centre: Vector3::new(x, 0.0, 0.0), radius });
        for radii in [[1.0, 1.0], [1.0, 0.5], [0.5, 1.0], [1.0, 1.0 - 1e-12]] {
            let of = [0, 1].map(|k| Ball { radius: radius * radii[k], ..balls[k] });
            let found =
                uncovered(&solid, &of, 1e-7, &Budget::of_spheres(false)).expect("little work");
            assert!(found.is_none(), "{apart} {radii:?}");
        }
        let small = balls.map(|ball| Ball { radius: 0.99 * ball.radius, ..ball });
        let found =
            uncovered(&solid, &small, 1e-7, &Budget::of_spheres(false)).expect("little work");
        assert!(found.is_some_and(|found| (found.distance - 0.01 * radius).abs() < 1e-7));
    }
}

fn codes(fixture: &Fixture) -> Vec<String> {
    let run = validate_source(fixture.in_memory(), "robot", &Settings::default());
    let run = run.expect("not cancelled");
    run.report.urdds[0].findings.iter().map(|finding| finding.code.clone()).collect()
}

/// The codes that a rule alone finds.
fn found_by(code: Code, fixture: &Fixture) -> Vec<String> {
    let folder = testkit::temporary::folder();
    fixture.write_to(folder.path());
    let rules: Vec<_> = rules::all().into_iter().filter(|rule| rule.code == code).collect();
    let run = validate_with(&[folder.path()], &Settings::default(), &rules).expect("a URDD");
    run.report.urdds[0].findings.iter().map(|finding| finding.code.clone()).collect()
}

fn with_samples(samples: u32) -> Fixture {
    let mut fixture = fixture();
    fixture.set(SPHERES, "/num_samples", json!(samples));
    fixture.seal();
    fixture
}

/// The post with this many small spheres in the last level, nearly all equal.
fn crowded(count: usize) -> Fixture {
    let mut fixture = fixture();
    let small = |k: usize| {
        let at = 1e-7 * k as f64;
        json!({ "radius": 0.05, "offset_xyz": [at, 0.0, 0.0], "outer_sphere_idx": 0 })
    };
    let spheres: Vec<Value> = (0..count).map(small).collect();
    let others = fixture.get(SPHERES, "/levels/2/spheres").as_array().expect("links").clone();
    let others: usize = others[1..].iter().map(|of| of.as_array().map_or(0, Vec::len)).sum();
    fixture.set(SPHERES, "/levels/2/spheres/0", json!(spheres[others..]));
    fixture.seal();
    fixture
}

#[test]
fn the_most_samples_and_spheres() {
    assert_eq!(found_by(SPH001, &with_samples(100_000)), [""; 0]);
    assert_eq!(found_by(SPH001, &with_samples(100_001)), ["SPH001"]);
    assert_eq!(found_by(SPH001, &crowded(65_536)), [""; 0]);
    assert_eq!(found_by(SPH001, &crowded(65_537)), ["SPH001"]);
}

/// As many spheres as there may be, all in each other: a budget ends what would take hours.
#[test]
fn too_many_spheres_spend_the_budget() {
    let mesh = cuboid([0.1; 3]);
    let solid = Solid::new(&mesh).expect("a hull");
    let ball = |k: u32| {
        let centre = Vector3::new(1e-7 * f64::from(k), 0.0, 0.0);
        Ball { centre, radius: 0.15 }
    };
    let balls: Vec<Ball> = (0..65_536).map(ball).collect();
    let little = || Budget::of(10_000_000, skip::spheres_take_too_long(false));
    let expected = urdd_validate::skip::spheres_take_too_long(false);
    assert_eq!(uncovered(&solid, &balls, 1e-7, &little()).err(), Some(expected.clone()));
    let pieces = LinkPieces::of(vec![&mesh]).expect("a hull");
    assert_eq!(standoff(&pieces, &balls, &little()).err(), Some(expected.clone()));
    let small: Vec<Ball> = balls.iter().map(|ball| Ball { radius: 0.01, ..*ball }).collect();
    let outside = fit::uncovered(
        &pieces,
        &[small],
        &Budget::of(1_000_000, skip::spheres_take_too_long(false)),
    );
    assert_eq!(outside.err(), Some(expected));
    // Of few spheres, the same work is enough.
    let few = &balls[..8];
    assert!(uncovered(&solid, few, 1e-7, &little()).is_ok_and(|found| found.is_some()));
    assert!(standoff(&pieces, few, &little()).is_ok());
    assert!(fit::uncovered(&pieces, &[few.to_vec()], &little()).is_ok());
}

#[test]
fn a_budget_that_is_spent_fails_whoever_spends() {
    let budget = Budget::of(100, skip::spheres_take_too_long(false));
    assert!(budget.spend(60).is_ok());
    assert!(budget.spend(40).is_ok());
    assert!(budget.spend(1).is_err());
    assert!(Budget::of(100, skip::spheres_take_too_long(true)).spend(u64::MAX).is_err());
    let spent = Budget::of(100, skip::spheres_take_too_long(false));
    assert!(spent.spend(u64::MAX).is_err());
    assert!(spent.spend(u64::MAX).is_err());
    assert!(spent.spend(1).is_err());
}

/// Contacts do not depend on the number of threads.
#[test]
fn contacts_are_the_same_for_any_threads() {
    let folder = testkit::temporary::folder();
    fixture().write_to(folder.path());
    let urdd = Urdd::read(folder.path()).expect("a URDD");
    let Some(ModuleDocument::LinkShapesSpheres(module)) =
        urdd.document(ModuleKind::LinkShapesSpheres)
    else {
        panic!("no spheres");
    };
    let mut module = (**module).clone();
    // More than what is looked at at once.
    module.num_samples.0 = 1_000;
    let poses = Poses::new(&urdd).expect("poses");
    let found = [1, 2].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let of = || contacts(&module, &poses, 2e-9, |_, _| true, &Budget::of_spheres(false));
        let levels = pool.install(of).expect("little work");
        let pairs = |pairs: &[_]| format!("{pairs:?}");
        levels.iter().map(|level| (pairs(&level.pairs), level.touches.clone())).collect::<Vec<_>>()
    });
    assert_eq!(found[0], found[1]);
    assert_eq!(found[0][0].1.len(), 1_000);
    // Settled pairs are asked again: the first level touches in as many configurations as all pairs at once.
    let touches = found[0][0].1.iter().filter(|touches| **touches == [true; 2]).count();
    assert_eq!(touches, 1_000, "arm and tip are always in contact");
}

/// Figures of turned boxes, by the closed form.
#[test]
fn figures_of_the_base_are_those_of_boxes() {
    assert_eq!(codes(&fixture()), [""; 0]);
    let meshes = testkit::meshes::Meshes::new(&testkit::spheres::robot());
    let tip: &[Cuboid] = &meshes.solids[2].as_ref().expect("a tip").pieces;
    let balls = &testkit::spheres::levels()[2].balls[2];
    let [max, mean, fraction, farthest] = testkit::spheres::fit(tip, balls);
    assert!(max > 0.0 && mean > 0.0 && farthest > 0.0 && diagonal(tip) > 0.3);
    assert!((0.5..1.0).contains(&fraction));
}

/// Of the post and the camera, which do not move to each other.
#[test]
fn a_touch_that_rounding_decides_may_be_counted_either_way() {
    let folder = testkit::temporary::folder();
    fixture().write_to(folder.path());
    let urdd = Urdd::read(folder.path()).expect("a URDD");
    let Some(ModuleDocument::LinkShapesSpheres(module)) =
        urdd.document(ModuleKind::LinkShapesSpheres)
    else {
        panic!("no spheres");
    };
    let poses = Poses::new(&urdd).expect("poses");
    for (larger, expected) in [(0.0, [false, true]), (1e-8, [true; 2]), (-1e-8, [false; 2])] {
        let mut module = (**module).clone();
        let level = &mut module.levels[2];
        // Its sphere of 0.105 m is at (0, 0, 0.01), and the camera's frame at (-0.8, 0, 0).
        let mut camera = level.spheres[0][0].clone();
        camera.offset_xyz = [0.8 - 0.105 - 0.045, 0.0, 0.01];
        camera.radius = 0.045 + larger;
        level.spheres[1..5].iter_mut().for_each(Vec::clear);
        level.spheres[5] = vec![camera];
        let asked = |level: usize, _| level == 2;
        let found = contacts(&module, &poses, 2e-9, asked, &Budget::of_spheres(false));
        let found = found.expect("little work");
        assert!(found[2].touches.iter().all(|touches| *touches == expected), "{larger}");
    }
}
