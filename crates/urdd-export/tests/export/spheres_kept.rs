//! Spheres that the URDD has: exports write them, and lists of people become them.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value, json};
use testkit::robots::made_bars;
use testkit::temporary;
use urdd_directory::account::Account;
use urdd_export::{
    Choices, Format, ListError, SphereFault, SphereList, SpheresError, Unnamed, import_spheres,
    read_spheres,
};
use urdd_format::link_shapes_spheres::SphereOrigin;
use urdd_robot::Robot;

use crate::made::export;

fn with_spheres(folder: &Path) -> Robot {
    Robot::open(made_bars(folder, &["all", "spheres"])).expect("a robot")
}

/// Writes the changed files of a URDD, and opens it again.
fn edited(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Robot {
    for (path, bytes) in files {
        std::fs::write(folder.join("bars").join(path), bytes).expect("a file");
    }
    Robot::open(folder.join("bars")).expect("a robot")
}

fn foam(robot: &Robot, choices: &Choices) -> Value {
    let choices = Choices { samples: 100, ..choices.clone() };
    serde_json::from_str(&export(robot, Format::Foam, &choices).expect("an export").text)
        .expect("JSON")
}

fn spheres(document: &Value, link: &str) -> Vec<([f64; 3], f64)> {
    let one = |of: &Value| {
        let centre = serde_json::from_value(of["origin"].clone()).expect("a point");
        (centre, of["radius"].as_f64().expect("a number"))
    };
    document["links"][link]["spheres"].as_array().expect("a list").iter().map(one).collect()
}

#[test]
fn exports_write_the_level_that_the_urdd_has() {
    let folder = temporary::folder();
    let robot = with_spheres(folder.path());
    let module = robot.spheres_module().expect("readable").expect("a module");
    for (choices, level) in
        [(Choices::default(), 3), (Choices { cover: true, ..Choices::default() }, 2)]
    {
        let document = foam(&robot, &choices);
        let own = module.levels[level].spheres[1].iter();
        let own: Vec<_> = own.map(|of| (of.offset_xyz, of.radius)).collect();
        assert_eq!(spheres(&document, "b"), own);
        let said = document["about"].to_string();
        assert!(said.contains(&format!("level {level} of link_shapes_spheres_module")), "{said}");
    }
    // Another number is another fit.
    let few = foam(&robot, &Choices { spheres: Some(2), ..Choices::default() });
    assert_eq!(spheres(&few, "b").len(), 2);
    assert!(!few["about"].to_string().contains("link_shapes_spheres_module"));
}

fn read(text: &str) -> Result<SphereList, ListError> {
    read_spheres(text, &Account::default())
}

#[test]
fn a_list_becomes_the_last_level_in_each_form() {
    let folder = temporary::folder();
    let mut robot = with_spheres(folder.path());
    let curobo = "robot_cfg:\n  kinematics:\n    collision_sphere_buffer: 0.005\n    collision_spheres:\n      b:\n        - {center: [0.1, 0.0, 0.0], radius: 0.04}\n        - {center: [0.3, 0, 0], radius: 0.05}\n      c:\n        - {center: [0.2, 0.0, 0.0], radius: -0.01}\n      hand:\n        - {center: [0, 0, 0], radius: 1}\n";
    let foam = json!({ "links": { "b": { "mean": 0.0, "spheres": [
        { "origin": [0.1, 0.0, 0.0], "radius": 0.04 }, { "origin": [0.3, 0.0, 0.0], "radius": 0.05 },
    ] } } });
    for (text, left_out) in [(curobo.to_owned(), 3), (foam.to_string(), 0)] {
        let list = read(&text).expect("a list");
        let imported =
            import_spheres(&robot, &list, Unnamed::Clear, &Account::default()).expect("spheres");
        assert_eq!(
            (imported.taken, imported.left_out.len()),
            (2, left_out),
            "{:?}",
            imported.left_out
        );
        let last = imported.module.levels.last().expect("a level");
        assert_eq!(last.origin, SphereOrigin::Given);
        let own: Vec<_> =
            last.spheres.iter().flatten().map(|of| (of.offset_xyz, of.radius)).collect();
        assert_eq!(own, [([0.1, 0.0, 0.0], 0.04), ([0.3, 0.0, 0.0], 0.05)]);
        // A sphere of 0.05 m on the axis of a bar whose half sides are 0.025 m.
        let fit = last.fits[1].as_ref().expect("of b");
        assert!(fit.max_standoff < 0.025 && fit.max_standoff > 0.022, "{fit:?}");
        robot = edited(folder.path(), &imported.files);
        let document = self::foam(&robot, &Choices::default());
        assert!(document["about"].to_string().contains("which a person gave"));
        assert_eq!(spheres(&document, "b").len(), 2);
        let metadata = std::fs::read(folder.path().join("bars/urdd.json")).expect("metadata");
        let metadata: Value = serde_json::from_slice(&metadata).expect("JSON");
        assert_eq!(metadata["urdd_version"], "1.1.0");
    }
}

#[test]
fn a_urdd_without_the_module_gets_it_and_its_version() {
    let folder = temporary::folder();
    let robot = Robot::open(made_bars(folder.path(), &["all"])).expect("a robot");
    let list = SphereList {
        links: vec![(
            "c".to_owned(),
            vec![urdd_export::Sphere { centre: [0.2, 0.0, 0.0], radius: 0.1 }],
        )],
        left_out: Vec::new(),
    };
    let imported =
        import_spheres(&robot, &list, Unnamed::Clear, &Account::default()).expect("spheres");
    let metadata: Value = serde_json::from_slice(&imported.files["urdd.json"]).expect("JSON");
    assert_eq!(metadata["urdd_version"], "1.1.0");
    let names = metadata["modules"].as_array().expect("modules").iter();
    assert!(names.clone().any(|of| of["name"] == "link_shapes_spheres_module"));
    let report = {
        let files = &imported.files;
        for (path, bytes) in files {
            let path = folder.path().join("bars").join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(path, bytes).expect("a file");
        }
        Robot::open(folder.path().join("bars")).expect("a robot").spheres_module()
    };
    assert_eq!(report.expect("readable").expect("a module").levels.len(), 4);
}

#[test]
fn what_is_no_list_of_this_robot_is_refused() {
    let list = |radius: &str, centre: &str| {
        format!("collision_spheres: {{b: [{{center: {centre}, radius: {radius}}}]}}")
    };
    let of_foam = |radius: &str| {
        read(&format!(
            "{{\"b\": {{\"spheres\": [{{\"origin\": [0, 0, 0], \"radius\": {radius}}}]}}}}"
        ))
    };
    let fault = |found: Result<SphereList, ListError>| match found {
        Err(ListError::Sphere { fault, .. }) => fault,
        other => panic!("{other:?}"),
    };
    for radius in ["0", "-1"] {
        assert!(matches!(fault(of_foam(radius)), SphereFault::Radius(_)));
    }
    assert_eq!(fault(of_foam("1e300")), SphereFault::Range(1e300));
    assert_eq!(fault(read(&list("1", "[0, 0]"))), SphereFault::Key("center"));
    assert_eq!(fault(read(&list(".nan", "[0, 0, 0]"))), SphereFault::Key("radius"));
    assert_eq!(fault(read(&list("1", "[2e9, 0, 0]"))), SphereFault::Range(2e9));
    for text in ["", "[]", "links: 3", "{}", "collision_spheres: 3", "a: {spheres: 3}"] {
        assert_eq!(read(text), Err(ListError::NoSpheres), "{text}");
    }
    assert!(matches!(read("collision_spheres: spheres/a.yml"), Err(ListError::Elsewhere(_))));
    assert!(matches!(read("a: [unclosed"), Err(ListError::Text(_))));
    let one = "{\"origin\": [0, 0, 0], \"radius\": 1},";
    let many =
        format!("{{\"b\": {{\"spheres\": [{}]}}}}", one.repeat(65_537).trim_end_matches(','));
    assert_eq!(read(&many), Err(ListError::TooMany));
    let long = " ".repeat((16 << 20) + 1);
    assert_eq!(read(&long), Err(ListError::TooLong));
    // Aliases that would make gigabytes of a kilobyte.
    let bomb: String =
        (1..30).map(|k| format!("k{k}: &k{k} [*k{p}, *k{p}, *k{p}, *k{p}]\n", p = k - 1)).collect();
    assert!(matches!(read(&format!("k0: &k0 [1]\n{bomb}")), Err(ListError::Text(_))));

    let folder = temporary::folder();
    let robot = with_spheres(folder.path());
    let other = read(
        "collision_spheres: {hand: [{center: [0, 0, 0], radius: 1}], frame: [{center: [0, 0, 0], radius: 1}]}",
    );
    let refused =
        import_spheres(&robot, &other.expect("a list"), Unnamed::Clear, &Account::default());
    let Err(SpheresError::OtherRobot(said)) = refused else { panic!("{refused:?}") };
    assert!(said.contains("`hand`") && said.contains("`frame` has no shape"), "{said}");
    // Of very many, few are named.
    let one = vec![urdd_export::Sphere { centre: [0.0; 3], radius: 0.1 }];
    let links = (0..30_000).map(|k| (format!("link_{k}"), one.clone())).collect();
    let many = SphereList { links, left_out: Vec::new() };
    let refused = import_spheres(&robot, &many, Unnamed::Clear, &Account::default());
    let Err(SpheresError::OtherRobot(said)) = refused else { panic!("{refused:?}") };
    assert!(said.ends_with("; 29980 more of the list") && said.len() < 2000, "{said}");
}

/// Of each kind of list what multiplies: aliases, brackets, links, and spheres around the same points.
#[test]
fn lists_that_multiply_are_refused_before_they_do() {
    let place = |text: &str| match read(text) {
        Err(ListError::Text(said)) => said,
        other => panic!("{:?}", other.map(|list| list.count())),
    };
    // One that is open is looked for at each bracket that follows: the scanner's own limit is 255.
    let said = place(&format!("a:\n  {}", "[".repeat(200_000)));
    assert_eq!(said, "recursion limit exceeded at line 2 column 258");
    let said = place(&format!("a:\n{}", "- ".repeat(110)));
    assert!(said.starts_with("it is nested too deep at line 2 column"), "{said}");
    let said = place(&"{a: ".repeat(200_000));
    assert!(said.contains(" at line 1 column "), "{said}");
    // A list of many, or one long word, by a short name.
    let numbers = "1,".repeat(10_000);
    let lists = "*a,".repeat(1000);
    let said = place(&format!("x: &a [{numbers}]\ny:\n  - [{lists}]\n"));
    assert!(said.contains("memory or work") && said.contains("at line 3"), "{said}");
    let said = place(&format!("x: &a {}\ny: [{}]\n", "x".repeat(1 << 20), "*a,".repeat(200)));
    assert!(said.contains("memory or work") && said.contains("at line 2"), "{said}");
    // Aliases that make little are read.
    let list = read("x: &a {center: [0, 0, 0], radius: 0.1}\ncollision_spheres: {a: [*a, *a]}");
    assert_eq!(list.expect("a list").count(), 2);
    // So are very many links without a sphere.
    let links: String = (0..60_000).map(|k| format!("l{k}: [],")).collect();
    assert_eq!(read(&format!("collision_spheres: {{{links}}}")).expect("a list").count(), 0);

    let folder = temporary::folder();
    let robot = with_spheres(folder.path());
    let spheres = |apart: f64| {
        let one =
            |k: u32| urdd_export::Sphere { centre: [0.1, 0.0, apart * f64::from(k)], radius: 0.04 };
        SphereList {
            links: vec![("b".to_owned(), (0..5000).map(one).collect())],
            left_out: Vec::new(),
        }
    };
    let taken = import_spheres(&robot, &spheres(0.0), Unnamed::Clear, &Account::default());
    assert_eq!(taken.expect("equal ones are looked at once").taken, 5000);
    let refused = import_spheres(&robot, &spheres(1e-12), Unnamed::Clear, &Account::default());
    let said = refused.map(|found| found.taken).expect_err("64 times 25 million").to_string();
    assert!(said.starts_with("the spheres of `b`: ") && said.contains("memory or work"), "{said}");
}
