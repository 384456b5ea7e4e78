//! SPEC 8.8: the output of a network, by numpy.

use serde_json::json;
use urdd_format::rate::Rate;
use urdd_format::self_collision_model::{
    ModelEvaluation, ModelInput, ModelLayer, ModelPair, SelfCollisionModelModule,
};
use urdd_robot::CollisionModel;

use super::{assert_near, vectors};

#[derive(serde::Deserialize)]
struct Network {
    num_dofs: usize,
    inputs: Vec<ModelInput>,
    layers: Vec<ModelLayer>,
    pairs: Vec<ModelPair>,
    vectors: Vec<Vector>,
}

#[derive(serde::Deserialize)]
struct Vector {
    configuration: Vec<f64>,
    clearances: Vec<f64>,
}

fn network() -> (CollisionModel, SelfCollisionModelModule, Vec<Vector>) {
    let file: Network = vectors("self_collision_model.json");
    let range = json!({ "first_sample_idx": 0, "num_configurations": 1 });
    let evaluation = ModelEvaluation::NOTHING;
    let module = json!({
        "trained_on": "0".repeat(64), "clip_distance": 1.0, "inputs": file.inputs, "layers": file.layers,
        "pairs": file.pairs, "other_pairs": [], "training": range, "calibration": range, "evaluation": evaluation,
        "test_vectors": [],
    });
    let module: SelfCollisionModelModule = serde_json::from_value(module).unwrap();
    let model = CollisionModel::new(&module, file.num_dofs).unwrap();
    (model, module, file.vectors)
}

#[derive(serde::Deserialize)]
struct Intervals {
    intervals: Vec<Interval>,
}

#[derive(serde::Deserialize)]
struct Interval {
    count: u32,
    of: u32,
    lower: f64,
    upper: f64,
}

/// SPEC 8.8.11, by scipy.
#[test]
fn intervals() {
    let file: Intervals = vectors("self_collision_model.json");
    assert!(file.intervals.len() > 8);
    for of in file.intervals {
        let rate = Rate::new(of.count, of.of);
        let what = format!("{} of {}", of.count, of.of);
        assert_near(&[rate.lower, rate.upper], &[of.lower, of.upper], 1e-14, &what);
    }
}

#[test]
fn clearances() {
    let (model, module, vectors) = network();
    let judge = urdd_validate::learned::Network::new(&module);
    let mut all = Vec::new();
    for (k, vector) in vectors.iter().enumerate() {
        let found = model.clearances(&vector.configuration).unwrap();
        assert_near(&found, &vector.clearances, 1e-13, &format!("vector {k}"));
        let judged = judge.clearances(&vector.configuration);
        assert_near(&judged, &vector.clearances, 1e-13, &format!("vector {k}, the validator"));
        all.extend(found);
    }
    // In a batch, the bits are the same.
    let configurations: Vec<f64> = vectors.iter().flat_map(|of| of.configuration.clone()).collect();
    assert_eq!(model.clearances_batch(&configurations).unwrap(), all);
    let many: Vec<f64> = configurations.repeat(9);
    assert_eq!(model.clearances_batch(&many).unwrap(), all.repeat(9));
}

#[test]
fn derivatives_are_those_of_differences() {
    let (model, _, vectors) = network();
    for vector in &vectors {
        let q = &vector.configuration;
        for pair in 0..model.pairs().len() {
            let found = model.gradient(q, pair).unwrap().unwrap();
            let step = 1e-5;
            let difference = |dof: usize| {
                let at = |by: f64| {
                    let mut moved = q.clone();
                    moved[dof] += by;
                    model.clearances(&moved).unwrap()[pair]
                };
                (at(step) - at(-step)) / (2.0 * step)
            };
            let expected: Vec<f64> = (0..q.len()).map(difference).collect();
            assert_near(&found, &expected, 1e-7, &format!("{q:?}, pair {pair}"));
        }
        let least = model.min_clearance(q).unwrap().unwrap();
        let smallest = vector.clearances.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((least.value - smallest).abs() < 1e-13);
        assert_eq!(Some(least.gradient), model.gradient(q, least.pair).unwrap());
    }
}

#[test]
fn bad_input_is_an_error() {
    let (model, mut module, _) = network();
    assert!(model.clearances(&[0.0; 4]).is_err());
    assert!(model.may_collide(&[0.0, 0.0, f64::NAN, 0.0, 0.0]).is_err());
    assert!(model.clearances_batch(&[f64::INFINITY; 5]).is_err());
    assert_eq!(model.gradient(&[0.0; 5], 3).unwrap(), None);
    assert!(CollisionModel::new(&module, 4).is_err(), "a DOF beyond the last");
    module.layers[1].weights[2].pop();
    assert!(CollisionModel::new(&module, 5).is_err(), "a row too short");
    module.layers.clear();
    assert!(CollisionModel::new(&module, 5).is_err(), "no layer");
}
