//! The package of a file for Drake: its `package.xml`, and a model directive that adds it to a scene.

use super::super::names::check_package;
use crate::{DrakeOptions, ExportError, Files, Subject, Yaml};
use urdd_xml::writer::Element;

/// The files, if a package is asked for.
pub(super) fn files(subject: &Subject, options: &DrakeOptions) -> Result<Files, ExportError> {
    let (Some(package), Some(file)) = (&options.package, &options.file) else {
        return Ok(Files::new());
    };
    check_package(package)?;
    let description =
        Element::new("package").with("format", "3").holding(Element::text("name", package));
    let robot = &subject.urdf.name;
    let mut model = vec![
        ("name".to_owned(), Yaml::text(robot)),
        ("file".to_owned(), Yaml::text(&format!("package://{package}/{file}"))),
    ];
    if let Some(named) = subject.robot.named_configurations()?.first() {
        let dofs = subject.dofs()?.into_iter().zip(&subject.view.joints);
        let positions = dofs.filter_map(|(dof, joint)| {
            let position = Yaml::numbers(&[named.configuration[dof?]]);
            Some((joint.name.as_str(), position))
        });
        model.push(("default_joint_positions".to_owned(), Yaml::named(positions)));
    }
    let mut directives = vec![Yaml::map([("add_model", Yaml::Map(model))])];
    let root = subject.tree.root;
    if !subject.is_floating && !subject.is_world(root) {
        let weld = Yaml::map([
            ("parent", Yaml::plain("world")),
            ("child", Yaml::text(&format!("{robot}::{}", subject.links[root]))),
        ]);
        directives.push(Yaml::map([("add_weld", weld)]));
    }
    let directives = Yaml::map([("directives", Yaml::List(directives))]);
    let stem = file.strip_suffix(".urdf").unwrap_or(file);
    Ok(vec![
        ("package.xml".to_owned(), description.document(&[]).into_bytes()),
        (format!("{stem}.dmd.yaml"), directives.document(&subject.origin()?).into_bytes()),
    ])
}
