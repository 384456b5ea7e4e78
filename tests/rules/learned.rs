//! LRN: models that flatter themselves, and those that are large.

use serde_json::{Value, json};
use urdd_document::urdd::Urdd;
use urdd_format::self_collision_model::SelfCollisionModelModule;
use urdd_validate::code::Code;
use urdd_validate::code::Code::*;
use urdd_validate::learned::Judge;
use urdd_validate::rule::Rule;
use urdd_validate::settings::Settings;
use urdd_validate::solids::Solids;
use urdd_validate::{rules, validate, validate_with};

use crate::shapes::set_pair;
use crate::{Case, changed, findings_in};
use testkit::fixture::Fixture;
use testkit::model::{MODEL, Said, fixture, fixture_with, trained_on};
use testkit::trials::trials;

/// A case with some values changed.
fn case(code: Code, name: &'static str, caught: bool, changes: &[(&'static str, Value)]) -> Case {
    let changes = changes.to_vec();
    changed(code, name, caught, fixture, move |fixture| {
        for (pointer, value) in &changes {
            fixture.set(MODEL, pointer, value.clone());
        }
    })
}

/// A count of the evaluation, increased.
fn count(key: &str, by: i64) -> Value {
    let count = fixture().get(MODEL, key).as_i64().expect("a count");
    json!(count + by)
}

/// A model padded with rows and columns that nothing depends on, up to this many weights and biases. It starts with 18
/// inputs, 4 hidden values and 5 outputs.
fn padded(numbers: usize) -> impl Fn(&mut Fixture) + Clone {
    move |fixture: &mut Fixture| {
        let before = 18 * 4 + 4 + 4 * 5 + 5;
        // One more hidden value takes 18 weights, a bias, and 5 weights.
        let more = (numbers - before) / 24;
        let layers = fixture.get(MODEL, "/layers").clone();
        let mut layers: Vec<Value> = layers.as_array().expect("layers").clone();
        let list = |value: &mut Value| -> Vec<Value> { value.as_array().expect("a list").clone() };
        for (key, value) in [("weights", json!(vec![0; 18])), ("biases", json!(0))] {
            let mut rows = list(&mut layers[0][key]);
            rows.extend(vec![value; more]);
            layers[0][key] = json!(rows);
        }
        let mut rows = list(&mut layers[1]["weights"]);
        for row in &mut rows {
            let mut of = list(row);
            of.extend(vec![json!(0); more]);
            *row = json!(of);
        }
        layers[1]["weights"] = json!(rows);
        fixture.set(MODEL, "/layers", json!(layers));
    }
}

/// This many test vectors, all alike.
fn vectors(count: usize) -> Value {
    json!(vec![fixture().get(MODEL, "/test_vectors/1"); count])
}

/// The model with the counts of the draft of 0.2.0, over configurations that the producer chose.
fn as_drafted(fixture: &mut Fixture) {
    fixture.remove(MODEL, "/evaluation");
    fixture.set(
        MODEL,
        "/held_out",
        json!({
            "first_sample_idx": 35_257_842, "num_configurations": 24, "num_colliding": 9, "num_missed": 0,
            "num_cleared": 15,
        }),
    );
}

/// The codes found in a model, except infos.
fn codes(fixture: &Fixture) -> Vec<String> {
    findings_in(fixture).into_keys().collect()
}

/// The codes that the rule on the size of a model finds, without those that evaluate it.
fn codes_of_size(fixture: &Fixture) -> Vec<String> {
    let folder = testkit::temporary::folder();
    fixture.write_to(folder.path());
    let size: Vec<&'static Rule> =
        rules::all().into_iter().filter(|rule| rule.code == LRN005).collect();
    let run = validate_with(&[folder.path()], &Settings::default(), &size);
    let urdds = run.expect("a URDD").report.urdds;
    let findings = urdds.iter().flat_map(|urdd| &urdd.findings);
    findings.map(|finding| finding.code.clone()).collect()
}

/// Models that overstate their accuracy, each in a different way. All of them passed in 0.2.0.
mod flattering {
    use super::*;

    /// Weights that nothing depends on made the validator count only some of the configurations.
    #[test]
    fn padded_with_dead_weights() {
        let mut small = fixture();
        padded(65_536)(&mut small);
        small.seal();
        assert_eq!(codes_of_size(&small), [""; 0], "as large as a model may be");
        // Each configuration is counted: with the largest model where much is tried, and with a smaller one here.
        let mut padded_little = fixture();
        padded(if trials(1) > 1 { 65_536 } else { 2_048 })(&mut padded_little);
        padded_little.seal();
        assert_eq!(codes(&padded_little), [""; 0]);
        let few = padded_little.get(MODEL, "/evaluation/num_missed").as_u64();
        let fewer = few.expect("a count").saturating_sub(3);
        padded_little.set(MODEL, "/evaluation/num_missed", json!(fewer));
        padded_little.seal();
        assert_eq!(codes(&padded_little), ["LRN010"]);
        let mut large = fixture();
        padded(65_560)(&mut large);
        large.seal();
        assert_eq!(codes_of_size(&large), ["LRN005"]);
        assert_eq!(codes(&large), ["LRN005"]);
        // Its stated rates do not count as verified.
        large.set(MODEL, "/evaluation/num_missed", json!(0));
        large.set(MODEL, "/evaluation/num_near_contact_missed", json!(0));
        large.seal();
        assert_eq!(codes(&large), ["LRN005"]);
        let folder = testkit::temporary::folder();
        large.write_to(folder.path());
        let run = validate(&[folder.path()], &Settings::default()).expect("a URDD");
        let report = run.report;
        let open = report.urdds[0].model_not_verified.as_ref();
        let open = open.expect("not verified");
        assert_eq!(open.codes, ["LRN010", "LRN011"]);
        assert_eq!(open.reasons, ["LRN005 found a fault"]);
    }

    /// A model that has memorised what it would miss states that it misses nothing, which is true where it counted.
    #[test]
    fn overfitted_to_the_evaluation() {
        let said = Said { margin: 0.1, by_heart: true, ..Said::default() };
        let mut model = fixture_with(said);
        assert_eq!(*model.get(MODEL, "/evaluation/num_missed"), json!(0));
        let known = model.get(MODEL, "/layers/1/weights/0").as_array();
        let known = known.expect("a row").len() - 4;
        let honest = fixture_with(Said { by_heart: false, ..said });
        assert_eq!(*honest.get(MODEL, "/evaluation/num_missed"), json!(known));
        let found = findings_in(&model);
        assert_eq!(found.keys().collect::<Vec<_>>(), ["LRN011"], "{known} known");
        assert!(found["LRN011"].contains("misses more collisions on sampled configurations"));
        assert_eq!(codes(&honest), [""; 0]);

        // Weights that nothing depends on change the second confirmation, but not the first.
        for dead in 1..=3 {
            model.set(MODEL, "/layers/0/weights/3/0", json!(dead));
            model.seal();
            assert_eq!(codes(&model), ["LRN011"]);
        }
    }

    /// Where hardly any configuration collides, a model that clears all of them is nearly always right.
    #[test]
    fn rare_collisions() {
        let rare = fixture_with(Said { reach: RARE, ..Said::default() });
        let colliding = rare.get(MODEL, "/evaluation/num_colliding").as_u64();
        assert_eq!(colliding, Some(130));
        assert_eq!(codes(&rare), ["LRN012"]);
    }

    /// 300 configurations, chosen such that none of their collisions is missed.
    #[test]
    fn a_window_of_its_own() {
        let mut window = fixture();
        window.set(
            MODEL,
            "/evaluation",
            json!({
                "num_colliding": 20, "num_missed": 0, "num_near_contact": 0, "num_near_contact_missed": 0,
                "num_free": 280, "num_cleared": 270,
            }),
        );
        window.seal();
        assert_eq!(codes(&window), ["LRN009"]);
    }

    /// The counts from another position in the sequence, as 0.2.0 chose it: no key states the position.
    #[test]
    fn a_start_of_its_own() {
        let mut draft = fixture();
        as_drafted(&mut draft);
        draft.seal();
        assert_eq!(codes(&draft), ["DIR030"], "and no flood of schema errors");
        let mut both = fixture();
        both.set(MODEL, "/evaluation/first_sample_idx", json!(35_257_842));
        both.seal();
        assert_eq!(codes(&both), ["SCH001"]);
    }

    /// A network beyond all limits, on ten configurations: the amount of work decides, not the clock or the threads.
    #[test]
    fn too_much_work() {
        let mut large = fixture();
        padded(1_000_000)(&mut large);
        let model: SelfCollisionModelModule =
            serde_json::from_value(large.get(MODEL, "").clone()).expect("a model");
        let folder = testkit::temporary::folder();
        fixture().write_to(folder.path());
        let urdd = Urdd::read(folder.path()).expect("a URDD");
        let solids = Solids::read(&urdd);
        for (deep, enough) in [(false, false), (true, true)] {
            let judge = Judge::new(&urdd, &solids, &model, deep).expect("a judge");
            for threads in [1, 2] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
                let found = pool.expect("threads").install(|| judge.count(0, 10));
                assert_eq!(found.is_ok(), enough, "{deep}, {threads} threads");
                if let Err(reason) = found {
                    assert_eq!(reason, urdd_validate::skip::counting_takes_too_long(deep));
                }
            }
        }
    }

    /// Misses understated by an amount that a tolerance relative to configurations, rather than to collisions, would
    /// accept.
    #[test]
    fn off_by_the_tolerance_of_a_count() {
        for (by, expected) in [(-3, vec!["LRN010"]), (-2, vec![])] {
            let mut off = fixture();
            off.set(MODEL, "/evaluation/num_missed", count("/evaluation/num_missed", by));
            off.seal();
            assert_eq!(codes(&off), expected, "{by}");
        }
    }
}

/// A robot that hardly moves: 130 of its 50,000 configurations collide, and 203 if the slider goes a centimetre higher.
/// A count with numpy agrees.
const RARE: [f64; 2] = [0.3, -0.02];
const ENOUGH: [f64; 2] = [0.3, -0.01];

pub fn cases() -> Vec<Case> {
    vec![
        case(LRN005, "a-hundred-and-one-test-vectors", true, &[("/test_vectors", vectors(101))]),
        case(LRN005, "a-hundred-test-vectors", false, &[("/test_vectors", vectors(100))]),
        changed(LRN007, "pieces-of-one-link-not-skipped", false, fixture, |f| {
            let reasons = json!(["Always", "Adjacent", "Default"]);
            f.set("link_shapes_skips_module", "/skipped_reasons", reasons);
            for shape in ["convex_hulls", "obbs", "bounding_spheres"] {
                let matrix = format!("/decomposition_{shape}_skips");
                for pair in [(0, 1), (3, 4), (6, 7)] {
                    set_pair(f, "link_shapes_skips_module", &matrix, pair, json!(false));
                }
            }
            f.seal();
            let digest = trained_on(f);
            f.set(MODEL, "/trained_on", json!(digest));
        }),
        changed(
            LRN011,
            "learned-by-heart",
            true,
            || fixture_with(Said { margin: 0.1, by_heart: true, ..Said::default() }),
            |_| {},
        ),
        changed(
            LRN012,
            "just-enough-collisions",
            false,
            || fixture_with(Said { reach: ENOUGH, ..Said::default() }),
            |_| {},
        ),
    ]
}
