//! The rules on derived core modules and their poses, on arbitrary robots: no finding on a valid URDD, and a finding
//! after any single value has changed.

use std::collections::BTreeMap;

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use rayon::prelude::*;
use serde_json::{Value, json};
use urdd_format::registry::{self, ModuleKind};
use urdd_format::report::{Status, Verdict};
use urdd_validate::code::Code;
use urdd_validate::settings::Settings;

use testkit::dice::Dice;
use testkit::fixture::Fixture;
use testkit::robot::{Robot, arbitrary_robot};
use testkit::trials::trials;

const ROBOTS: u32 = 40;
/// Changes of each robot.
const CHANGES: usize = 3;
const MODULES: [&str; 5] = [
    "dof_module",
    "chain_module",
    "connections_module",
    "bounds_module",
    "kinematics_samples_module",
];

/// The codes found in a URDD, each with its first message, except oddities of the robot.
fn found(urdd: &Fixture) -> BTreeMap<Code, String> {
    let run =
        urdd_validate::validate_source(urdd.in_memory(), "robot", &Settings::default()).unwrap();
    let [urdd] = &run.report.urdds[..] else { panic!("one URDD") };
    assert_ne!(urdd.verdict, Verdict::Unreadable);
    for check in &urdd.checks {
        let crashed = check.status == Status::Crashed;
        assert!(!crashed, "{} crashed: {:?}", check.code, check.reason);
    }
    let mut found = BTreeMap::new();
    for finding in &urdd.findings {
        let code = Code::parse(&finding.code).expect("a code");
        if code.family() != "SRC" {
            let place = finding.pointer.as_deref().unwrap_or_default();
            let first = || format!("{place}: {}", finding.message);
            found.entry(code).or_insert_with(first);
        }
    }
    found
}

fn robots() -> impl Iterator<Item = Robot> {
    let mut runner = TestRunner::deterministic();
    let strategy = arbitrary_robot();
    (0..trials(ROBOTS)).map(move |_| strategy.new_tree(&mut runner).unwrap().current())
}

#[test]
fn valid_urdds_of_any_robot_have_no_finding() {
    let robots: Vec<Robot> = robots().collect();
    robots.par_iter().for_each(|robot| {
        let found = found(&Fixture::core(robot));
        assert!(found.is_empty(), "{found:?}\n{}", robot.to_urdf_xml());
    });
}

#[test]
fn a_single_changed_value_is_found_by_one_rule() {
    let robots: Vec<Robot> = robots().collect();
    let tried: Vec<(String, BTreeMap<Code, String>)> = robots
        .par_iter()
        .enumerate()
        .flat_map_iter(|(number, robot)| {
            let valid = Fixture::core(robot);
            let mut dice = Dice((number as u64) << 32);
            (0..CHANGES).map(move |_| {
                let mut urdd = valid.clone();
                let change = mutate(&mut urdd, &mut dice);
                urdd.seal();
                (change, found(&urdd))
            })
        })
        .collect();

    let survivors = tried.iter().filter(|(_, found)| found.is_empty());
    let survivors: Vec<&str> = survivors.map(|(change, _)| change.as_str()).collect();
    let several: Vec<_> = tried.iter().filter(|(_, found)| found.len() > 1).collect();
    let mut by_code: BTreeMap<Code, usize> = BTreeMap::new();
    for code in tried.iter().flat_map(|(_, found)| found.keys()) {
        *by_code.entry(*code).or_default() += 1;
    }
    println!("{} changes, {} not found", tried.len(), survivors.len());
    println!("{by_code:?}");
    assert!(survivors.is_empty(), "not found: {survivors:#?}");
    assert!(several.is_empty(), "more than one message: {several:#?}");
}

/// Changes one value anywhere in a document. Each kind of place is equally likely, however large its table. Returns a
/// description of the change.
fn mutate(urdd: &mut Fixture, dice: &mut Dice) -> String {
    loop {
        let module = MODULES[dice.below(MODULES.len())];
        let valid = urdd.doc(module).clone();
        let mut pointer = String::new();
        let mut place = urdd.doc_mut(module);
        loop {
            let keys: Vec<String> = match &*place {
                Value::Object(map) => map.keys().cloned().collect(),
                Value::Array(list) if dice.below(5) > 0 => {
                    (0..list.len()).map(|index| index.to_string()).collect()
                }
                _ => Vec::new(),
            };
            if keys.is_empty() {
                break;
            }
            let key = &keys[dice.below(keys.len())];
            pointer = format!("{pointer}/{key}");
            place = match place {
                Value::Object(map) => &mut map[key],
                Value::Array(list) => &mut list[key.parse::<usize>().unwrap()],
                _ => unreachable!(),
            };
        }
        let before = place.clone();
        if !change(place, dice) || *place == before {
            continue;
        }
        let after = place.clone();
        if pointer == "/samples" && is_start(&after, &before) {
            // A producer may write any number of samples.
            *place = before;
            continue;
        }
        // The columns of `bounds` repeat the values: half of the time, the fault is in both.
        let parts: Vec<&str> = pointer.split('/').collect();
        if let ["", "bounds", dof, end] = parts[..]
            && dice.below(2) == 0
        {
            let column = ["dof_lower_bounds", "dof_upper_bounds"][end.parse::<usize>().unwrap()];
            urdd.set(module, &format!("/{column}/{dof}"), after.clone());
        }
        let text = |value: &Value| value.to_string().chars().take(60).collect::<String>();
        if fits_schema(module, urdd.doc(module)) {
            return format!("{module}{pointer}: {} -> {}", text(&before), text(&after));
        }
        // SCH001 finds what breaks the schema; that is tested elsewhere.
        *urdd.doc_mut(module) = valid;
    }
}

/// Whether a list is a prefix of another one.
fn is_start(list: &Value, of: &Value) -> bool {
    let (Some(list), Some(of)) = (list.as_array(), of.as_array()) else {
        return false;
    };
    of.starts_with(list)
}

fn fits_schema(module: &str, document: &Value) -> bool {
    let kind = ModuleKind::ALL.iter().find(|kind| kind.name() == module);
    let spec = registry::find(*kind.unwrap(), "1.0.0").unwrap();
    spec.read(document).is_ok()
}

/// Changes a value; the change is at least ten times any tolerance.
fn change(place: &mut Value, dice: &mut Dice) -> bool {
    let way = dice.below(4);
    match place {
        Value::Null => *place = [json!(0), json!(1), json!([0]), json!(0.5)][way].clone(),
        Value::Bool(flag) => *flag = !*flag,
        Value::Number(number) if number.is_f64() => {
            let x = number.as_f64().unwrap();
            let small = 1e-6 * (1.0 + x.abs());
            *place = match way {
                0 => json!(-x),
                1 => json!(x + small),
                2 => json!(x - small),
                _ => json!(0.0),
            };
        }
        Value::Number(number) => {
            let x = number.as_u64().unwrap();
            *place = match way {
                0 => Value::Null,
                1 if x > 0 => json!(x - 1),
                2 => json!(4_294_967_295_u32),
                _ => json!(x + 1),
            };
        }
        Value::String(text) => {
            let kinds = ["Revolute", "Prismatic", "Continuous", "Fixed", "Floating"];
            let quantities = ["Angle", "Length"];
            *text = match text.as_str() {
                kind if kinds.contains(&kind) => kinds[dice.below(kinds.len())].to_owned(),
                kind if quantities.contains(&kind) => quantities[way % 2].to_owned(),
                name => format!("{name}x"),
            };
        }
        Value::Array(list) if list.is_empty() => list.push(json!(0)),
        Value::Array(list) => {
            let at = dice.below(list.len());
            match way {
                0 => drop(list.remove(at)),
                1 => list.insert(at, list[at].clone()),
                2 => list.swap(0, at),
                _ => drop(list.pop()),
            }
        }
        Value::Object(_) => return false,
    }
    true
}
