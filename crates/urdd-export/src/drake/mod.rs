//! URDF for Drake: convex OBJ meshes, joints that Drake's parser accepts, and pairs of links that need no check as
//! collision filter groups.

mod joints;

use std::collections::BTreeMap;

use crate::names::check_package;
use crate::urdf::is_of_loops;
use crate::urdf_elements::{
    Geometry, IN_JOINT, IN_LINK, IN_ROBOT, add_attributes, empty_robot, links, push_unknown,
};
use crate::{Export, ExportError, Files, Format, Note, Structure, Subject, Taken, Yaml};
use joints::Driven;
use urdd_format::urdf::UrdfModule;
use urdd_xml::other_parts::Owner;
use urdd_xml::writer::Element;

pub(super) use joints::is_free;

const WORLD: &str = "the root link is called `world`, which is Drake's own; Drake's collision filter groups do not hold it, so that pairs with it are checked";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let urdf = &subject.urdf;
    let mut robot = empty_robot(subject).with("xmlns:drake", "http://drake.mit.edu");
    let mut notes = Vec::new();
    let shapes = subject.shapes_by_link()?;
    let (links, mut files) = links(subject, Geometry::Drake, shapes, &mut notes)?;
    let joints = joints::joints(subject, &mut notes)?;
    let mut lost = 0;
    let bodies = links.into_iter().zip(&urdf.links).enumerate();
    for (_, (mut element, link)) in bodies.filter(|(index, _)| !subject.is_frame(*index)) {
        lost += push_unknown(&mut element, &link.unknown_elements, IN_LINK);
        robot.push(element);
    }
    robot.extend(joints.links.into_iter().map(|link| Element::new("link").with("name", link)));
    for (mut element, joint) in joints.elements {
        add_attributes(subject, &Owner::Joint(joint.name.clone()), &mut element);
        lost += push_unknown(&mut element, &joint.unknown_elements, IN_JOINT);
        robot.push(element);
    }
    robot.extend(joints.frames);
    robot.extend(joints::constraints(subject, &mut notes)?);
    let others = urdf.unknown_elements.iter().filter(|text| !is_of_loops(text)).cloned();
    let others: Vec<String> = others.collect();
    let mut kept = joints::kept(&others, &joints.driven, &mut notes);
    lost += push_unknown(&mut robot, &kept.texts, IN_ROBOT);
    robot.extend(kept.others(&subject.structure));
    if lost > 0 {
        notes.push(Note::Elements(lost));
    }
    robot.extend(groups(subject, &mut Taken::default()));
    if subject.disabled().any(|pair| pair.links.iter().any(|link| subject.is_world(*link))) {
        notes.push(Note::Robot(WORLD));
    }
    notes.extend(subject.notes());
    let what = format!("Collision geometry, and pairs that are filtered: {}.", subject.shapes);
    files.extend(package_files(subject)?);
    let text = robot.document(&subject.comments(what, &notes)?);
    Ok(Export::of(text, files, notes))
}

/// The names of the actuators, in their order.
pub(super) fn actuators(urdf: &UrdfModule, of: &Structure) -> Vec<String> {
    let names = |is_wanted: &dyn Fn(usize) -> bool| {
        let joints = of.view.joints.iter().enumerate().filter(|(index, _)| is_wanted(*index));
        joints.map(|(_, joint)| joint.name.clone()).collect()
    };
    let is_fixed = |joint: usize| of.view.joints[joint].num_dofs() == 0 || of.follows_fixed(joint);
    let is_of_one = |joint: usize| {
        let view = &of.view.joints[joint];
        view.num_dofs() == 1 && !joints::is_weak(view)
    };
    let of_one = names(&|joint| is_of_one(joint) && !is_fixed(joint));
    let driven = Driven { of_one, fixed: names(&is_fixed) };
    let mut kept = joints::kept(&urdf.unknown_elements, &driven, &mut Vec::new());
    kept.others(of);
    kept.order
}

/// One collision filter group for each link in a pair. It ignores the groups of its partners with a higher index. SDF has
/// names as text, URDF as attributes. In SDF, they share the names of links and joints.
pub(super) fn groups(subject: &Subject, taken: &mut Taken) -> Vec<Element> {
    let mut partners: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for pair in subject.disabled() {
        let [a, b] = pair.links;
        // The world has no group: it belongs to no model.
        if subject.is_world(a) || subject.is_world(b) {
            continue;
        }
        partners.entry(a).or_default().push(b);
        partners.entry(b).or_default();
    }
    let names: BTreeMap<usize, String> =
        partners.keys().map(|link| (*link, taken.free(format!("link_{link}")))).collect();
    let saying = |tag: &'static str, key: &'static str, name: &str| match subject.format {
        Format::Sdf => Element::text(tag, name),
        _ => Element::new(tag).with(key, name),
    };
    let group = |(link, ignored): (usize, Vec<usize>)| {
        let member = saying("drake:member", "link", &subject.links[link]);
        let mut group =
            Element::new("drake:collision_filter_group").with("name", names[&link].as_str());
        group.push(member);
        for other in ignored {
            group.push(saying("drake:ignored_collision_filter_group", "name", &names[&other]));
        }
        group
    };
    partners.into_iter().map(group).collect()
}

fn package_files(subject: &Subject) -> Result<Files, ExportError> {
    let (Some(package), Some(file)) = (&subject.options.package, &subject.options.file) else {
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
