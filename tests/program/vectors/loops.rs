//! Loops and spheres: gaps by the library, singular values by nalgebra, and spheres by figures of closed forms of boxes, which the suite's case has.

use std::f64::consts::TAU;

use serde::Deserialize;
use serde_json::Value;
use urdd_conformance::suite::Suite;
use urdd_conformance::tree::Tree;
use urdd_format::loops::{LoopKind, LoopsModule};
use urdd_format::pose::Pose;
use urdd_kinematics::loops::Gap;
use urdd_kinematics::pose::to_isometry;

use super::{assert_near, vectors};

#[derive(Deserialize)]
struct Loops {
    kinds: Vec<Kind>,
    matrices: Vec<Matrix>,
}

#[derive(Deserialize)]
struct Kind {
    kind: LoopKind,
    frame_b_in_frame_a: Pose,
    position_gap: f64,
    rotation_gap: f64,
}

#[derive(Deserialize)]
struct Matrix {
    case: String,
    matrix: Vec<Vec<f64>>,
    singular_values: Vec<f64>,
    rank: usize,
    num_independent: usize,
}

/// The URDD of a case.
fn tree(suite: &Suite, id: &str) -> Tree {
    let case = suite.cases.iter().find(|case| case.id() == id);
    suite.tree(case.unwrap_or_else(|| panic!("no case {id}"))).expect("the case reads")
}

#[test]
fn gaps_of_each_kind() {
    let loops: Loops = vectors("loops.json");
    assert_eq!(loops.kinds.len(), 4 * 7);
    for one in loops.kinds {
        let found = Gap::of(one.kind, &to_isometry(&one.frame_b_in_frame_a).expect("a pose"));
        let place = format!("{:?} {:?}", one.kind, one.frame_b_in_frame_a);
        let (found, expected) =
            ([found.position, found.rotation], [one.position_gap, one.rotation_gap]);
        assert_near(&found, &expected, 1e-14, &place);
    }
}

#[test]
fn matrices_and_their_ranks() {
    let loops: Loops = vectors("loops.json");
    let suite = urdd::suite::carried().expect("the suite reads");
    for one in loops.matrices {
        let tree = tree(&suite, &one.case);
        let module: LoopsModule = read(&tree, "loops_module");
        let num_dofs = module.reference_configuration.len();
        let by_nalgebra =
            nalgebra::DMatrix::from_fn(one.matrix.len(), num_dofs, |i, j| one.matrix[i][j]);
        let values = by_nalgebra.singular_values();
        let mut values: Vec<f64> = values.iter().copied().collect();
        values.sort_by(|a, b| b.total_cmp(a));
        assert_near(&values, &one.singular_values, 1e-9, &one.case);
        let counts = values.iter().filter(|value| **value > 1e-9 && **value > 1e-5 * values[0]);
        assert_eq!(counts.count(), one.rank, "{}", one.case);
        assert_eq!(one.num_independent, num_dofs - one.rank, "{}", one.case);
        assert_eq!(module.independent_dof_idxs.len(), one.num_independent, "{}", one.case);
    }
}

fn read<T: for<'de> Deserialize<'de>>(tree: &Tree, folder: &str) -> T {
    let bytes = tree.file(&format!("{folder}/module.json")).expect("the document");
    serde_json::from_slice(bytes).expect("JSON")
}

#[derive(Deserialize)]
struct Spheres {
    case: String,
    unit_vectors: Vec<[f64; 3]>,
    links: Vec<Link>,
}

#[derive(Deserialize)]
struct Link {
    level: usize,
    link_idx: usize,
    diagonal: f64,
    standoffs_of_first_sphere: Vec<Option<f64>>,
    max_standoff: f64,
    mean_standoff: f64,
    num_parts: Vec<usize>,
    num_centroids_that_count: usize,
    uncovered_fraction: f64,
    max_uncovered: f64,
}

#[test]
fn what_fits_of_spheres_rest_on() {
    let spheres: Spheres = vectors("spheres.json");
    for (k, found) in (0..64_u32).zip(&spheres.unit_vectors) {
        let z = 1.0 - f64::from(2 * k + 1) / 64.0;
        let (s, a) = ((1.0 - z * z).sqrt(), TAU * (0.6180339887498949 * f64::from(k)).fract());
        assert_near(&[s * a.cos(), s * a.sin(), z], found, 1e-14, "unit_vectors");
    }
    // Closed forms of boxes.
    let suite = urdd::suite::carried().expect("the suite reads");
    let module: Value =
        read(&tree(&suite, &spheres.case), "link_shapes_modules/link_shapes_spheres_module");
    let levels = module["levels"].as_array().expect("levels");
    let with_spheres = |level: &Value| {
        level["fits"].as_array().expect("fits").iter().filter(|fit| !fit.is_null()).count()
    };
    assert_eq!(spheres.links.len(), levels.iter().map(with_spheres).sum::<usize>());
    for link in spheres.links {
        let place = format!("level {}, link {}", link.level, link.link_idx);
        let fit = &levels[link.level]["fits"][link.link_idx];
        let stated = |key: &str| fit[key].as_f64().expect("a number");
        let lengths = ["max_standoff", "mean_standoff", "max_uncovered"].map(stated);
        let found = [link.max_standoff, link.mean_standoff, link.max_uncovered];
        assert_near(&found, &lengths, 1e-6 * link.diagonal, &place);
        assert_near(&[link.uncovered_fraction], &[stated("uncovered_fraction")], 1e-4, &place);
        // In the first level there is one sphere, all of whose points count.
        if link.level == 0 {
            let first: Option<Vec<f64>> = link.standoffs_of_first_sphere.into_iter().collect();
            let first = first.expect("all count");
            let (largest, sum) =
                (first.iter().copied().fold(0.0, f64::max), first.iter().sum::<f64>());
            assert_near(&[largest, sum / 64.0], &found[..2], 1e-12, &place);
        }
        // Each triangle is cut into a square number of parts; those inside of another piece do not count.
        assert!(link.num_parts.iter().all(|parts| parts.isqrt().pow(2) == *parts), "{place}");
        assert!(link.num_centroids_that_count <= link.num_parts.iter().sum::<usize>(), "{place}");
    }
}
