//! What fits which format is said once, in the library.

use std::collections::BTreeSet;

use urdd_export::{ActuatorKind, CHOICES, Choices, Fit, Format, Ros};

/// Each option that only some formats have is refused by all others, and named.
#[test]
fn what_a_format_does_not_have_is_refused() {
    let none = Choices::default;
    let tree = "srdf, urdf, drake, mjcf, moveit, sdf, usd, urdf-plus and extended-urdf";
    let cases = [
        ("merge_fixed", Choices { merge_fixed: true, ..none() }, tree),
        ("fit", Choices { fit: Some(Fit::default()), ..none() }, tree),
        ("root", Choices { root: Some("a".to_owned()), ..none() }, tree),
        ("actuators", Choices { actuators: Some(ActuatorKind::Motor), ..none() }, "mjcf and usd"),
        ("sensors", Choices { sensors: true, ..none() }, "mjcf"),
        ("scene", Choices { scene: true, ..none() }, "mjcf"),
        ("floating_base", Choices { floating_base: true, ..none() }, "mjcf, sdf and usd"),
        ("robot_file", Choices { robot_file: Some("r.urdf".to_owned()), ..none() }, "curobo"),
        ("ros", Choices { ros: Some(Ros::Humble), ..none() }, "moveit"),
        ("package", Choices { package: Some("r".to_owned()), ..none() }, "moveit and drake"),
    ];
    let few = CHOICES.iter().filter(|choice| choice.of.len() < Format::ALL.len());
    let few: BTreeSet<&str> = few.map(|choice| choice.name).collect();
    assert_eq!(few, cases.iter().map(|(option, ..)| *option).collect());
    for format in Format::ALL {
        assert_eq!(none().options(*format).map(|options| options.format), Ok(*format));
        for (option, choices, formats) in &cases {
            let said = choices.options(*format).map_err(|misfit| misfit.to_string());
            match formats.replace(" and ", ", ").split(", ").any(|word| word == format.word()) {
                true => assert_eq!(said.map(|options| options.format), Ok(*format)),
                false => assert_eq!(said, Err(format!("{option} is for {formats} only"))),
            }
        }
    }
}

/// Meshes and packages are named after what is written.
#[test]
fn names_follow_the_output() {
    let choices = Choices { output: Some("a/My-Robot v1.2".into()), ..Choices::default() };
    let names = |choices: &Choices, format: Format| {
        let options = choices.options(format).expect("options of the format");
        (options.package, options.mesh_folder)
    };
    let (package, folder) = names(&choices, Format::Moveit);
    assert_eq!(package.as_deref(), Some("my_robot_v1_2"));
    assert_eq!(folder, "package://my_robot_v1_2/meshes");
    assert_eq!(names(&choices, Format::Urdf), (None, "My-Robot v1_meshes".to_owned()));
    let of_none = (Some(Choices::PACKAGE.to_owned()), "meshes".to_owned());
    assert_eq!(names(&Choices::default(), Format::Moveit), of_none);
}
