//! What each format carries of a robot: the table of docs/export.md, and what was lost of one robot.

use std::collections::HashSet;

use crate::urdf_elements::is_kept;
use crate::{Export, ExportError, Format, Note, Subject, order, urdf};
use urdd_format::carried::How::{self, Elsewhere, No, Otherwise, Yes};
use urdd_format::carried::{self, Part, table};
use urdd_format::loops::LoopsModule;
use urdd_format::urdf::{Joint, JointType, Limit, Link};
use urdd_xml::other_parts::OtherPart;

struct Feature {
    name: &'static str,
    count: fn(&Subject) -> usize,
    /// By format, in the order of [`Format::ALL`].
    by_format: [How; 12],
}

const MIMIC: How = Otherwise("as equality constraints, which hold in simulation only");
const CLOSED: How = Otherwise(
    "hinges, balls and welds as `connect` and `weld`, in simulation only; start in the keyframe `closed`",
);
const BALLS: How = Otherwise(
    "hinges, balls and welds as one to three `drake:ball_constraint`, in simulation only",
);
const SECOND: How = Otherwise(
    "those that are closed where all joints are at 0, as joints; no cylinders and planes; Drake refuses the file",
);
const OUTSIDE: How = Otherwise("as joints that are not of the articulation; no universal joints");
const PAIRED: How = Otherwise("welds and balls, and hinges as two balls");
const SOURCES: How = Otherwise("as URDF+'s elements, which the source has");
const RETYPED: How = Otherwise("as hinges that the YAML makes balls");
const SUMS: How = Otherwise("of one joint, or of one as a polynomial of another");
const FOLLOWS: How = Otherwise("where one joint follows another linearly, as a mimic");
const SIDES: How = Otherwise("linear ones of the joints down to two links, without a constant");
const CHAIN: How = Otherwise("as a chain of joints of one DOF, and a ball joint");
const SLIDES: How = Otherwise("as three slides and a ball joint");
const PLANAR: How = Otherwise("as two slides and a hinge");
const NAMES: How = Otherwise("on the shapes of the file, in their order");
const GAZEBO: How = Otherwise("where SDF has what they say; plugins and sensors unchecked");
const RENAMED: How = Otherwise("with `_joint` after the joint's name");
const WHOLE: How = Otherwise("for whole links, also where the URDD checks some of their pieces");
const SPHERES: How = Otherwise("by spheres");
const DRAKE: How = Otherwise("for whole links, and for Drake only");
const EFFORT: How = Otherwise("effort; velocity only of velocity actuators");
const FIRST: How = Otherwise("the first, in the model directive");
const RETRACT: How = Otherwise("one, as the retract configuration");
const CUROBO: How = Otherwise("in the whole robot file");
const NO_FRICTION: How = Otherwise("damping; Drake ignores friction");
const NO_JERK: How = Otherwise("acceleration; Drake ignores jerk");
const ASKED: How = Otherwise("with `--shapes source`; otherwise as the shapes that are chosen");
const PNG: How = Otherwise("JPEG as PNG");
const IGNORED: How = Otherwise("written, and ignored by Drake");
const DRIVEN: How = Otherwise("velocity for Newton and PhysX; effort of drives (`--actuators`)");
const NEWTON: How = Otherwise("by Newton's attributes, which other programs ignore");
const FROM_HARMONIC: How =
    Otherwise("for Gazebo Harmonic, Jetty and Drake; Gazebo Fortress loads the file without them");
const MIMICS: How = Otherwise("by attributes of Newton and of PhysX");
const GENERIC: How = Otherwise("as a generic joint with free axes");
const KEPT: How = Otherwise("for whole links; by piece with `--keep-pairs`");
const MOCK: How = Otherwise("mock hardware for that of `<ros2_control>`");
const CUSTOM: How = Otherwise("as custom data, which programs ignore");

impl Feature {
    /// What every URDF has in the same way, whichever shapes it has; what Drake, MJCF, SDF and USD make of it; and what other
    /// formats leave to the URDF.
    const fn new(
        name: &'static str,
        count: fn(&Subject) -> usize,
        [urdf, drake, mjcf, sdf, usd]: [How; 5],
    ) -> Self {
        let e = Elsewhere;
        Feature {
            name,
            count,
            by_format: [e, urdf, drake, mjcf, e, e, urdf, urdf, sdf, usd, urdf, urdf],
        }
    }

    /// The same, but for this format.
    const fn but(mut self, format: Format, how: How) -> Self {
        self.by_format[format as usize] = how;
        self
    }
}

const TABLE: [Feature; 25] = [
    Feature::new("masses and inertias", |of| links(of, |it| it.inertial.is_some()), [Yes; 5]),
    Feature::new(
        "colours of visual geometry",
        |of| links(of, |it| !it.visual.is_empty()),
        [Yes; 5],
    ),
    // `collision_geometry` counts what became of it.
    Feature {
        name: COLLISIONS,
        count: |_| 0,
        by_format: [
            Elsewhere, ASKED, ASKED, ASKED, SPHERES, SPHERES, SPHERES, ASKED, ASKED, ASKED, ASKED,
            ASKED,
        ],
    },
    // `textures` counts what became of them.
    Feature::new(TEXTURES, |_| 0, [Yes, PNG, PNG, PNG, Yes]),
    Feature::new("textures that the URDF itself names", |of| links(of, has_texture), [No; 5]),
    Feature::new(
        "limits of position",
        |of| of.view.joints.iter().filter(|joint| joint.position_limits().is_some()).count(),
        [Yes; 5],
    ),
    Feature::new(
        "limits of effort and velocity",
        |of| limits(of, |it| it.effort.or(it.velocity)),
        [Yes, Yes, EFFORT, Yes, DRIVEN],
    ),
    Feature::new(
        "limits of acceleration and jerk",
        |of| limits(of, |it| it.acceleration.or(it.jerk)),
        [Yes, NO_JERK, No, No, No],
    )
    .but(Format::Curobo, CUROBO),
    Feature::new(
        "damping and friction of joints",
        |of| joints(of, |it| it.dynamics.is_some()),
        [Yes, NO_FRICTION, Yes, Yes, NEWTON],
    ),
    Feature::new(
        "safety controllers and calibrations",
        |of| joints(of, |it| it.safety_controller.is_some() || it.calibration.is_some()),
        [Yes, IGNORED, No, No, No],
    ),
    Feature::new(
        "mimic joints",
        |of| of.mimics.by_joint.iter().flatten().count(),
        [Yes, Yes, MIMIC, FROM_HARMONIC, MIMICS],
    ),
    Feature::new("joints with the name of a link", namesakes, [Yes, Yes, Yes, RENAMED, Yes])
        .but(Format::Curobo, Yes),
    Feature::new(
        "planar joints",
        |of| typed(of, JointType::Planar),
        [Yes, Yes, PLANAR, CHAIN, GENERIC],
    ),
    Feature::new(
        "floating joints",
        |of| typed(of, JointType::Floating),
        [Yes, CHAIN, SLIDES, CHAIN, GENERIC],
    ),
    Feature::new("spherical joints", |of| typed(of, JointType::Spherical), [Yes; 5])
        .but(Format::UrdfPlus, Yes)
        .but(Format::ExtendedUrdf, RETYPED),
    Feature::new(
        "names of visual and collision elements",
        named_shapes,
        [NAMES, NAMES, No, No, No],
    ),
    Feature::new(
        "attributes that URDF does not define, outside of shapes and materials",
        |of| others(of, is_kept),
        [Yes, Yes, No, No, No],
    ),
    Feature::new(
        "what URDF does not define in shapes, materials, limits and the like",
        |of| others(of, |part| !is_kept(part)),
        [No; 5],
    ),
    Feature::new(
        "`<gazebo>` elements",
        |of| of_robot(of, |text| is_a(text, GAZEBO_TAG)),
        [Yes, Yes, No, GAZEBO, CUSTOM],
    ),
    Feature::new(
        "hardware of ros2_control",
        |of| of_robot(of, |text| is_a(text, HARDWARE_TAG)),
        [Yes, Yes, No, No, CUSTOM],
    )
    .but(Format::Moveit, MOCK),
    Feature::new(
        "other elements that URDF does not define, such as transmissions",
        other_elements,
        [Yes, Yes, No, No, CUSTOM],
    ),
    Feature::new(
        CHAINS,
        |of| loops(of).map_or(0, |module| module.loops.len()),
        [No, BALLS, CLOSED, SECOND, OUTSIDE],
    )
    .but(Format::UrdfPlus, Yes)
    .but(Format::ExtendedUrdf, PAIRED),
    Feature::new(
        COUPLINGS,
        |of| loops(of).map_or(0, |module| module.couplings.len()),
        [No, FOLLOWS, SUMS, FOLLOWS, FOLLOWS],
    )
    .but(Format::UrdfPlus, SIDES)
    .but(Format::ExtendedUrdf, No),
    // By format, in the order of `Format::ALL`.
    Feature {
        name: "pairs that need no collision check",
        count: |of| of.disabled().count(),
        by_format: [WHOLE, No, WHOLE, Yes, SPHERES, SPHERES, No, WHOLE, DRAKE, KEPT, No, No],
    },
    Feature {
        name: "named configurations",
        count: |of| of.robot.named_configurations().map_or(0, <[_]>::len),
        by_format: [
            Elsewhere, Elsewhere, FIRST, Yes, RETRACT, Elsewhere, Elsewhere, Yes, No, CUSTOM,
            Elsewhere, Elsewhere,
        ],
    },
];

fn loops<'s>(subject: &'s Subject) -> Option<&'s LoopsModule> {
    subject.robot.loops().ok().flatten()
}

const GAZEBO_TAG: &str = "gazebo";
const HARDWARE_TAG: &str = "ros2_control";

fn is_a(text: &str, tag: &str) -> bool {
    let text = urdd_xml::element::wrapped(text);
    let document = urdd_xml::parse(&text, urdd_xml::Kind::Other);
    document.is_ok_and(|document| {
        let first = document.root_element().first_element_child();
        first.is_some_and(|first| first.has_tag_name(tag))
    })
}

fn links(subject: &Subject, has: impl Fn(&Link) -> bool) -> usize {
    subject.urdf.links.iter().filter(|link| has(link)).count()
}

fn joints(subject: &Subject, has: impl Fn(&Joint) -> bool) -> usize {
    subject.urdf.joints.iter().filter(|joint| has(joint)).count()
}

fn typed(subject: &Subject, joint_type: JointType) -> usize {
    joints(subject, |joint| joint.joint_type == joint_type)
}

fn limits(subject: &Subject, has: impl Fn(&Limit) -> Option<f64>) -> usize {
    joints(subject, |joint| joint.limit.as_ref().and_then(&has).is_some())
}

fn namesakes(subject: &Subject) -> usize {
    let links: HashSet<&String> = subject.links.iter().collect();
    joints(subject, |joint| links.contains(&joint.name))
}

fn named_shapes(subject: &Subject) -> usize {
    let names = |link: &Link| {
        let visuals = link.visual.iter().filter(|visual| visual.name.is_some()).count();
        visuals + link.collision.iter().filter(|it| it.name.is_some()).count()
    };
    subject.urdf.links.iter().map(names).sum()
}

fn others(subject: &Subject, is_wanted: impl Fn(&OtherPart) -> bool) -> usize {
    subject.other_parts.values().flatten().filter(|part| is_wanted(part)).count()
}

fn other_elements(subject: &Subject) -> usize {
    let of_links = subject.urdf.links.iter().map(|link| link.unknown_elements.len());
    let of_joints = subject.urdf.joints.iter().map(|joint| joint.unknown_elements.len());
    let is_other = |text: &str| {
        !is_a(text, GAZEBO_TAG) && !is_a(text, HARDWARE_TAG) && !urdf::is_of_loops(text)
    };
    of_links.chain(of_joints).sum::<usize>() + of_robot(subject, is_other)
}

/// How many elements of the robot itself that URDF does not define are of a kind.
fn of_robot(subject: &Subject, is_of: impl Fn(&str) -> bool) -> usize {
    subject.urdf.unknown_elements.iter().filter(|text| is_of(text)).count()
}

fn has_texture(link: &Link) -> bool {
    let materials = link.visual.iter().filter_map(|visual| visual.material.as_ref());
    let mut textures = materials.filter_map(|material| material.texture.as_ref());
    textures.any(|texture| !texture.filename.is_empty())
}

const CHAINS: &str = "closed chains";
const COUPLINGS: &str = "couplings of joints";
const TEXTURES: &str = "textures of meshes";
const COLLISIONS: &str = "collision geometry of the source";

/// What became of it.
fn collision_geometry(made: &Export) -> impl Iterator<Item = (&'static str, usize, How)> {
    made.notes.iter().filter_map(|note| match note {
        Note::SourceShapes(counts) => Some((COLLISIONS, counts.total(), Yes)),
        Note::NotOfSource { elements, .. } => Some((COLLISIONS, elements.total(), ASKED)),
        _ => None,
    })
}

/// What became of the textures of meshes.
fn textures(made: &Export) -> impl Iterator<Item = (&'static str, usize, How)> {
    let count = |of: fn(&Note) -> usize| made.notes.iter().map(of).sum();
    let lost: usize = count(|note| usize::from(matches!(note, Note::LostTexture { .. })));
    let converted: usize = count(|note| match note {
        Note::ConvertedTextures(textures) => textures.len(),
        _ => 0,
    });
    let is_image = |path: &str| path.ends_with(".png") || path.ends_with(".jpg");
    let written = made.files.iter().filter(|(path, _)| is_image(path)).count();
    let all = [(written.saturating_sub(converted), Yes), (converted, PNG), (lost, No)];
    let all = all.into_iter().filter(|(count, _)| *count > 0);
    all.map(|(count, how)| (TEXTURES, count, how))
}

fn carried<'s>(subject: &'s Subject) -> impl Iterator<Item = (&'static str, usize, How)> + 's {
    TABLE.iter().filter_map(move |feature| {
        let count = (feature.count)(subject);
        let mut how = feature.by_format[subject.format as usize];
        let is_of_loops = [CHAINS, COUPLINGS].contains(&feature.name);
        // The file has URDF+'s elements as the source has them.
        if how == No
            && is_of_loops
            && urdf::keeps_loops(subject)
            && of_robot(subject, urdf::is_of_loops) > 0
        {
            how = SOURCES;
        }
        (count > 0 && how != Elsewhere).then_some((feature.name, count, how))
    })
}

pub(super) fn lost(subject: &Subject) -> Option<Note> {
    let lost: Vec<String> = carried(subject)
        .filter(|(_, _, how)| *how == No)
        .map(|(name, count, _)| format!("{name} ({count})"))
        .collect();
    (!lost.is_empty()).then(|| Note::Lost(lost.join(", ")))
}

/// The report of an export, as JSON: what is carried, what otherwise, what is lost, and the notes.
pub(super) fn report(subject: &Subject, made: &Export) -> Result<String, ExportError> {
    let parts = carried(subject).chain(collision_geometry(made)).chain(textures(made));
    let parts: Vec<Part> = parts.map(|(name, count, how)| (name.to_owned(), count, how)).collect();
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    let more = [("order", order::report(subject)?)];
    let format = subject.format.name();
    Ok(carried::report_with(&subject.urdf.name, format, &parts, &notes, more))
}

/// The table of docs/export.md, in Markdown.
#[must_use]
pub fn carried_table() -> String {
    let formats: Vec<&str> = Format::ALL.iter().map(|format| format.name()).collect();
    table(&formats, TABLE.iter().map(|feature| (feature.name, feature.by_format)))
}
