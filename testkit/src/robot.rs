//! A robot as in its URDF, its XML, and arbitrary robots.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

use proptest::prelude::*;
use proptest::sample::{Index, select};
use urdd_format::urdf::*;

/// A robot: the content of its URDF, the layout of the file, and the available meshes.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    /// The content of the URDF. Links and joints are in the order of the file.
    pub urdf: UrdfModule,
    /// The order of links and joints in the file.
    pub layout: Layout,
    /// The available meshes: file name in the URDF -> side lengths of the box in the mesh file, which is centred at its
    /// origin. Other mesh references have no file.
    pub meshes: BTreeMap<String, [f64; 3]>,
    /// How far each half of a link, where it has two pieces, reaches beyond the middle, m.
    pub overlap: f64,
}

/// The order of links and joints in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    LinksFirst,
    JointsFirst,
    Alternating,
}

impl Robot {
    /// A robot without links.
    pub fn new(name: &str) -> Robot {
        Robot {
            urdf: UrdfModule {
                name: name.to_owned(),
                version: None,
                links: Vec::new(),
                joints: Vec::new(),
                materials: Vec::new(),
                unknown_elements: Vec::new(),
            },
            layout: Layout::LinksFirst,
            meshes: BTreeMap::new(),
            overlap: 0.0,
        }
    }

    /// Index of a link.
    pub fn link_idx(&self, name: &str) -> usize {
        let found = self.urdf.links.iter().position(|link| link.name == name);
        found.unwrap_or_else(|| panic!("no link {name:?}"))
    }

    /// Index of a joint.
    pub fn joint_idx(&self, name: &str) -> usize {
        let found = self.urdf.joints.iter().position(|joint| joint.name == name);
        found.unwrap_or_else(|| panic!("no joint {name:?}"))
    }

    /// A link, mutable.
    pub fn link_mut(&mut self, name: &str) -> &mut Link {
        let idx = self.link_idx(name);
        &mut self.urdf.links[idx]
    }

    /// A joint, mutable.
    pub fn joint_mut(&mut self, name: &str) -> &mut Joint {
        let idx = self.joint_idx(name);
        &mut self.urdf.joints[idx]
    }

    /// The text of the URDF file.
    pub fn to_urdf_xml(&self) -> String {
        let urdf = &self.urdf;
        let mut xml = Xml(String::from(
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- A robot for tests. -->\n",
        ));
        xml.open("robot", [text("name", &urdf.name)]);
        if let Some(version) = &urdf.version {
            xml.0.truncate(xml.0.len() - 2); // Re-open the start tag.
            writeln!(xml.0, " version=\"{}\">", escape(version)).expect("a String");
        }
        for material in &urdf.materials {
            xml.material(material);
        }
        let (links, joints) = (urdf.links.len(), urdf.joints.len());
        let order: Vec<(bool, usize)> = match self.layout {
            Layout::LinksFirst => (0..links).map(|i| (true, i)).collect(),
            Layout::JointsFirst => (0..joints).map(|i| (false, i)).collect(),
            Layout::Alternating => {
                (0..joints.min(links)).flat_map(|i| [(false, i), (true, i)]).collect()
            }
        };
        let rest = (0..links).map(|i| (true, i));
        let rest = rest.chain((0..joints).map(|i| (false, i)));
        let done: BTreeSet<_> = order.iter().copied().collect();
        for (is_link, i) in order.into_iter().chain(rest.filter(|e| !done.contains(e))) {
            if is_link {
                xml.link(&urdf.links[i]);
            } else {
                xml.joint(&urdf.joints[i]);
            }
        }
        xml.unknown(&urdf.unknown_elements);
        xml.close("robot");
        xml.0
    }
}

/// A link with only a name.
pub fn link(name: &str) -> Link {
    Link::new(name)
}

/// A joint with only the required parts.
pub fn joint(name: &str, joint_type: JointType, parent: &str, child: &str) -> Joint {
    Joint::new(name, joint_type, parent, child)
}

/// An `<origin>` with position and rotation.
pub fn origin(xyz: [f64; 3], rpy: [f64; 3]) -> Option<Origin> {
    Some(Origin { xyz: Some(xyz), rpy: Some(rpy), quat_xyzw: None })
}

/// A `<limit>` with both limits, effort and velocity.
pub fn limit(lower: f64, upper: f64) -> Option<Limit> {
    Some(Limit {
        lower: Some(lower),
        upper: Some(upper),
        effort: Some(10.0),
        velocity: Some(1.5),
        acceleration: None,
        deceleration: None,
        jerk: None,
    })
}

/// A `<visual>` with this geometry.
pub fn visual(origin: Option<Origin>, geometry: Geometry) -> Visual {
    Visual { name: None, origin, geometry: Some(geometry), material: None }
}

/// A `<collision>` with this geometry.
pub fn collision(origin: Option<Origin>, geometry: Geometry) -> Collision {
    Collision { name: None, origin, geometry: Some(geometry) }
}

/// A box.
pub fn cuboid(size: [f64; 3]) -> Geometry {
    Geometry::Box(Cuboid { size })
}

/// A mesh.
pub fn mesh(filename: &str, scale: Option<[f64; 3]>) -> Geometry {
    Geometry::Mesh(Mesh { filename: filename.to_owned(), scale })
}

/// The inertial of a solid box.
pub fn solid_box(mass: f64, [x, y, z]: [f64; 3]) -> Inertial {
    let moment = |a: f64, b: f64| Some(mass * (a * a + b * b) / 12.0);
    Inertial {
        origin: None,
        mass: Some(Mass { value: mass }),
        inertia: Some(Inertia {
            ixx: moment(y, z),
            ixy: Some(0.0),
            ixz: Some(0.0),
            iyy: moment(x, z),
            iyz: Some(0.0),
            izz: moment(x, y),
        }),
    }
}

/// The number of DOFs of a joint type.
pub fn num_dofs(joint_type: JointType) -> usize {
    match joint_type {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

// ---- XML

type Attribute<'a> = Option<(&'a str, String)>;

fn text<'a>(key: &'a str, value: &str) -> Attribute<'a> {
    Some((key, escape(value)))
}

fn maybe<'a>(key: &'a str, value: Option<f64>) -> Attribute<'a> {
    value.map(|value| (key, value.to_string()))
}

fn numbers<'a>(key: &'a str, values: Option<&[f64]>) -> Attribute<'a> {
    let values: Vec<String> = values?.iter().map(f64::to_string).collect();
    Some((key, values.join(" ")))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

struct Xml(String);

impl Xml {
    fn start<const N: usize>(&mut self, tag: &str, attributes: [Attribute; N], end: &str) {
        write!(self.0, "<{tag}").expect("a String");
        for (key, value) in attributes.into_iter().flatten() {
            write!(self.0, " {key}=\"{value}\"").expect("a String");
        }
        self.0.push_str(end);
    }

    fn open<const N: usize>(&mut self, tag: &str, attributes: [Attribute; N]) {
        self.start(tag, attributes, ">\n");
    }

    fn empty<const N: usize>(&mut self, tag: &str, attributes: [Attribute; N]) {
        self.start(tag, attributes, "/>\n");
    }

    fn close(&mut self, tag: &str) {
        writeln!(self.0, "</{tag}>").expect("a String");
    }

    fn unknown(&mut self, elements: &[String]) {
        for element in elements {
            writeln!(self.0, "{element}").expect("a String");
        }
    }

    fn origin(&mut self, origin: &Option<Origin>) {
        if let Some(Origin { xyz, rpy, quat_xyzw }) = origin {
            self.empty(
                "origin",
                [
                    numbers("xyz", xyz.as_ref().map(|v| &v[..])),
                    numbers("rpy", rpy.as_ref().map(|v| &v[..])),
                    numbers("quat_xyzw", quat_xyzw.as_ref().map(|v| &v[..])),
                ],
            );
        }
    }

    fn geometry(&mut self, geometry: &Option<Geometry>) {
        let Some(geometry) = geometry else { return };
        self.open("geometry", []);
        match geometry {
            Geometry::Mesh(Mesh { filename, scale }) => {
                let scale = numbers("scale", scale.as_ref().map(|v| &v[..]));
                self.empty("mesh", [text("filename", filename), scale]);
            }
            Geometry::Box(Cuboid { size }) => self.empty("box", [numbers("size", Some(size))]),
            Geometry::Cylinder(Cylinder { radius, length }) => self.empty(
                "cylinder",
                [maybe("radius", Some(*radius)), maybe("length", Some(*length))],
            ),
            Geometry::Capsule(Capsule { radius, length }) => self
                .empty("capsule", [maybe("radius", Some(*radius)), maybe("length", Some(*length))]),
            Geometry::Sphere(Sphere { radius }) => {
                self.empty("sphere", [maybe("radius", Some(*radius))]);
            }
        }
        self.close("geometry");
    }

    fn material(&mut self, material: &Material) {
        let name = material.name.as_ref().and_then(|name| text("name", name));
        self.open("material", [name]);
        if let Some(Color { rgba }) = &material.color {
            self.empty("color", [numbers("rgba", Some(rgba))]);
        }
        if let Some(Texture { filename }) = &material.texture {
            self.empty("texture", [text("filename", filename)]);
        }
        self.close("material");
    }

    fn link(&mut self, link: &Link) {
        self.open("link", [text("name", &link.name)]);
        if let Some(inertial) = &link.inertial {
            self.open("inertial", []);
            self.origin(&inertial.origin);
            if let Some(Mass { value }) = inertial.mass {
                self.empty("mass", [maybe("value", Some(value))]);
            }
            if let Some(i) = &inertial.inertia {
                self.empty(
                    "inertia",
                    [
                        maybe("ixx", i.ixx),
                        maybe("ixy", i.ixy),
                        maybe("ixz", i.ixz),
                        maybe("iyy", i.iyy),
                        maybe("iyz", i.iyz),
                        maybe("izz", i.izz),
                    ],
                );
            }
            self.close("inertial");
        }
        for visual in &link.visual {
            let name = visual.name.as_ref().and_then(|name| text("name", name));
            self.open("visual", [name]);
            self.origin(&visual.origin);
            self.geometry(&visual.geometry);
            if let Some(material) = &visual.material {
                self.material(material);
            }
            self.close("visual");
        }
        for collision in &link.collision {
            let name = collision.name.as_ref().and_then(|name| text("name", name));
            self.open("collision", [name]);
            self.origin(&collision.origin);
            self.geometry(&collision.geometry);
            self.close("collision");
        }
        self.unknown(&link.unknown_elements);
        self.close("link");
    }

    fn joint(&mut self, joint: &Joint) {
        let joint_type = joint.joint_type.as_str().to_lowercase();
        self.open("joint", [text("name", &joint.name), text("type", &joint_type)]);
        self.origin(&joint.origin);
        self.empty("parent", [text("link", &joint.parent.link)]);
        self.empty("child", [text("link", &joint.child.link)]);
        if let Some(axis) = &joint.axis {
            self.empty("axis", [numbers("xyz", axis.xyz.as_ref().map(|v| &v[..]))]);
        }
        if let Some(l) = &joint.limit {
            self.empty(
                "limit",
                [
                    maybe("lower", l.lower),
                    maybe("upper", l.upper),
                    maybe("effort", l.effort),
                    maybe("velocity", l.velocity),
                    maybe("acceleration", l.acceleration),
                    maybe("deceleration", l.deceleration),
                    maybe("jerk", l.jerk),
                ],
            );
        }
        if let Some(d) = &joint.dynamics {
            self.empty("dynamics", [maybe("damping", d.damping), maybe("friction", d.friction)]);
        }
        if let Some(m) = &joint.mimic {
            self.empty(
                "mimic",
                [
                    text("joint", &m.joint),
                    maybe("multiplier", m.multiplier),
                    maybe("offset", m.offset),
                ],
            );
        }
        if let Some(s) = &joint.safety_controller {
            self.empty(
                "safety_controller",
                [
                    maybe("soft_lower_limit", s.soft_lower_limit),
                    maybe("soft_upper_limit", s.soft_upper_limit),
                    maybe("k_position", s.k_position),
                    maybe("k_velocity", s.k_velocity),
                ],
            );
        }
        if let Some(c) = &joint.calibration {
            self.empty("calibration", [maybe("rising", c.rising), maybe("falling", c.falling)]);
        }
        self.unknown(&joint.unknown_elements);
        self.close("joint");
    }
}

// ---- Arbitrary robots

/// An arbitrary robot that a URDF can describe: a tree of 1 to 30 links in any order, all joint types, chained mimic
/// joints, unusual names, missing parts, every kind of geometry. Its URDD is valid; the robot itself may be
/// questionable (missing or crossed limits, mimic joints that leave their range).
pub fn arbitrary_robot() -> impl Strategy<Value = Robot> {
    robots(any_geometry(true).boxed(), 2, 30)
}

/// Like [`arbitrary_robot`], restricted to the geometry that [`super::shapes`] supports: at most one visual and one
/// collision element per link, each a box or a mesh; and at most 8 links, since shapes are paired.
pub fn arbitrary_box_robot() -> impl Strategy<Value = Robot> {
    robots(any_geometry(false).boxed(), 1, 8)
}

const FOUND: [(&str, [f64; 3]); 3] = [
    ("package://robot_description/meshes/part.stl", [0.2, 0.1, 0.3]),
    ("package://other/päckchen 1.STL", [1.0, 2.0, 0.5]),
    ("meshes/part.stl", [0.1, 0.1, 0.1]),
];
const MISSING: &str = "file:///nowhere/gone.dae";

fn robots(
    geometry: BoxedStrategy<Geometry>,
    most_elements: usize,
    most_links: usize,
) -> impl Strategy<Value = Robot> {
    let parts = (arbitrary_link(geometry, most_elements), arbitrary_joint());
    (
        name(),
        option(select(vec!["1.0", "1.1", "1.2"]).prop_map(str::to_owned)),
        prop::collection::vec(parts, 1..=most_links),
        prop::collection::vec(material(), 0..3),
        unknown(),
        select(vec![Layout::LinksFirst, Layout::JointsFirst, Layout::Alternating]),
    )
        .prop_map(|(name, version, parts, materials, unknown_elements, layout)| {
            let (links, joints) = parts.into_iter().unzip();
            let (links, joints) = assemble(links, joints);
            let urdf = UrdfModule { name, version, links, joints, materials, unknown_elements };
            let meshes = FOUND.iter().map(|(f, s)| ((*f).to_owned(), *s)).collect();
            Robot { urdf, layout, meshes, overlap: 0.0 }
        })
}

/// A joint before it has its position in a tree.
#[derive(Debug, Clone)]
struct LooseJoint {
    place: u32,
    joint: Joint,
    parent: Index,
    mimic: Option<(Index, Option<f64>, Option<f64>)>,
}

/// Builds a tree: joint i connects link i to an earlier link; joint 0 is dropped. Then sorts links and joints by their
/// places.
fn assemble(links: Vec<(u32, Link)>, joints: Vec<LooseJoint>) -> (Vec<Link>, Vec<Joint>) {
    let mut links = links;
    make_unique(links.iter_mut().map(|(_, link)| &mut link.name));
    let mut joints = joints;
    make_unique(joints.iter_mut().map(|loose| &mut loose.joint.name));
    let mut built: Vec<(u32, Joint)> = Vec::new();
    for (i, loose) in joints.into_iter().enumerate().skip(1) {
        let mut joint = loose.joint;
        joint.parent.link = links[loose.parent.index(i)].1.name.clone();
        joint.child.link = links[i].1.name.clone();
        let can_drive: Vec<&Joint> = built
            .iter()
            .map(|(_, joint)| joint)
            .filter(|joint| num_dofs(joint.joint_type) <= 1)
            .collect();
        if let Some((driver, multiplier, offset)) = loose.mimic
            && num_dofs(joint.joint_type) <= 1
            && !can_drive.is_empty()
        {
            joint.mimic = Some(Mimic {
                joint: can_drive[driver.index(can_drive.len())].name.clone(),
                multiplier,
                offset,
            });
        }
        built.push((loose.place, joint));
    }
    links.sort_by_key(|(place, _)| *place);
    built.sort_by_key(|(place, _)| *place);
    (
        links.into_iter().map(|(_, link)| link).collect(),
        built.into_iter().map(|(_, joint)| joint).collect(),
    )
}

fn make_unique<'a>(names: impl Iterator<Item = &'a mut String>) {
    let mut seen = BTreeSet::new();
    for (i, name) in names.enumerate() {
        if !seen.insert(name.clone()) {
            name.push_str(&format!("_{i}"));
            seen.insert(name.clone());
        }
    }
}

fn arbitrary_link(
    geometry: BoxedStrategy<Geometry>,
    most_elements: usize,
) -> impl Strategy<Value = (u32, Link)> {
    let visual = (option(name()), option(arbitrary_origin()), geometry.clone(), option(material()))
        .prop_map(|(name, origin, geometry, material)| Visual {
            name,
            origin,
            geometry: Some(geometry),
            material,
        });
    let collision = (option(name()), option(arbitrary_origin()), geometry)
        .prop_map(|(name, origin, geometry)| Collision { name, origin, geometry: Some(geometry) });
    let lone_missing = most_elements == 1;
    (
        any::<u32>(),
        name(),
        option(inertial()),
        prop::collection::vec(visual, 0..=most_elements),
        prop::collection::vec(collision, 0..=most_elements),
        unknown(),
    )
        .prop_map(
            move |(place, name, inertial, visual, mut collision, unknown_elements)| {
                // SPEC leaves open which geometry replaces a mesh that cannot be found.
                let missing = |g: &Option<Geometry>| matches!(g, Some(Geometry::Mesh(m)) if m.filename == MISSING);
                if lone_missing && visual.iter().any(|v| missing(&v.geometry)) {
                    collision.clear();
                }
                (
                    place,
                    Link {
                        name,
                        inertial,
                        visual,
                        collision,
                        unknown_elements,
                    },
                )
            },
        )
}

fn arbitrary_joint() -> impl Strategy<Value = LooseJoint> {
    let joint_type = prop_oneof![
        4 => Just(JointType::Revolute),
        2 => Just(JointType::Continuous),
        2 => Just(JointType::Prismatic),
        2 => Just(JointType::Fixed),
        1 => Just(JointType::Floating),
        1 => Just(JointType::Planar),
        1 => Just(JointType::Spherical),
    ];
    let dynamics = (option(positive()), option(positive()))
        .prop_map(|(damping, friction)| Dynamics { damping, friction });
    let safety_controller = prop::array::uniform4(option(number())).prop_map(|v| {
        let [soft_lower_limit, soft_upper_limit, k_position, k_velocity] = v;
        SafetyController { soft_lower_limit, soft_upper_limit, k_position, k_velocity }
    });
    let calibration = (option(number()), option(number()))
        .prop_map(|(rising, falling)| Calibration { rising, falling });
    let mimic = prop_oneof![
        2 => Just(None),
        1 => (any::<Index>(), option(number()), option(number())).prop_map(Some),
    ];
    (
        (any::<u32>(), name(), joint_type, any::<Index>(), mimic),
        option(joint_origin()),
        axis(),
        arbitrary_limit(),
        rarely(dynamics),
        rarely(safety_controller),
        rarely(calibration),
        unknown(),
    )
        .prop_map(
            |(
                (place, name, joint_type, parent, mimic),
                origin,
                axis,
                limit,
                dynamics,
                safety_controller,
                calibration,
                unknown_elements,
            )| LooseJoint {
                place,
                joint: Joint {
                    origin,
                    axis,
                    limit,
                    dynamics,
                    safety_controller,
                    calibration,
                    unknown_elements,
                    ..joint(&name, joint_type, "", "")
                },
                parent,
                mimic,
            },
        )
}

fn option<T: std::fmt::Debug + Clone>(
    strategy: impl Strategy<Value = T>,
) -> impl Strategy<Value = Option<T>> {
    prop::option::weighted(0.75, strategy)
}

fn rarely<T: std::fmt::Debug + Clone>(
    strategy: impl Strategy<Value = T>,
) -> impl Strategy<Value = Option<T>> {
    prop::option::weighted(0.2, strategy)
}

fn name() -> impl Strategy<Value = String> {
    let traps = [
        "no",
        "1:30",
        "0x1",
        "null",
        "~",
        "1e-7",
        "2024-01-01",
        "true",
        "- a",
        "a: b",
        "<<",
        "12",
        "1.0",
        "#a",
        "",
        "Link",
        "link",
        "con",
    ];
    prop_oneof![
        4 => "[a-z][a-zA-Z0-9_]{0,10}",
        1 => "[a-z]{1,4}[äößλ日🤖\u{a0}\u{2028} /:.&<>\"'#%*\\\\-]{1,6}[a-z]{1,4}",
        1 => select(traps.to_vec()).prop_filter("a name", |name| !name.is_empty()).prop_map(str::to_owned),
    ]
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -2.0..2.0,
        4 => (-2000..2000).prop_map(|n| f64::from(n) / 1000.0),
        2 => select(vec![0.0, -0.0, 1.0, -1.0, FRAC_PI_2, -FRAC_PI_2, PI, -PI, 1e-7, -3.5e-12]),
    ]
}

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![3 => 0.01..2.0, 1 => select(vec![0.05, 1.0, 2.5])]
}

fn vector() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(number())
}

fn arbitrary_origin() -> impl Strategy<Value = Origin> {
    (option(vector()), option(vector())).prop_map(|(xyz, rpy)| Origin { xyz, rpy, quat_xyzw: None })
}

/// The origin of a joint: with a rotation in one of the two forms, or none.
fn joint_origin() -> impl Strategy<Value = Origin> {
    let quaternion = prop::array::uniform4(number())
        .prop_filter("a length", |q| q.iter().any(|c| c.abs() > 1e-3))
        .prop_map(Some);
    (arbitrary_origin(), prop_oneof![2 => Just(None), 1 => quaternion]).prop_map(
        |(origin, quat_xyzw)| Origin {
            rpy: origin.rpy.filter(|_| quat_xyzw.is_none()),
            quat_xyzw,
            ..origin
        },
    )
}

fn axis() -> impl Strategy<Value = Option<Axis>> {
    let xyz = prop_oneof![
        3 => select(vec![
            [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, -3.0, 0.0],
            [0.0, 0.0, 1e-3], [1.0, 1.0, 0.0], [1e-3, 0.0, -1.0], [2e-11, -3e-11, -1.0],
            [3e-9, 4e-9, -1.0],
        ]),
        2 => vector().prop_filter("an axis", |v| v.iter().any(|c| c.abs() > 1e-3)),
    ];
    option(option(xyz).prop_map(|xyz| Axis { xyz }))
}

fn arbitrary_limit() -> impl Strategy<Value = Option<Limit>> {
    let range = prop_oneof![
        5 => (number(), positive()).prop_map(|(lower, width)| (Some(lower), Some(lower + width))),
        1 => number().prop_map(|at| (Some(at), Some(at))),
        1 => number().prop_map(|lower| (Some(lower), None)),
        1 => number().prop_map(|upper| (None, Some(upper))),
        1 => Just((None, None)),
    ];
    let more = || option(positive());
    option((range, more(), more(), more(), more(), more()).prop_map(
        |((lower, upper), effort, velocity, acceleration, deceleration, jerk)| Limit {
            lower,
            upper,
            effort,
            velocity,
            acceleration,
            deceleration,
            jerk,
        },
    ))
}

/// Physically valid: the inertia of a point cloud, in an arbitrary rotation.
fn inertial() -> impl Strategy<Value = Inertial> {
    let spread = prop::array::uniform3(0.01..1.0f64);
    (option(arbitrary_origin()), positive(), spread, vector()).prop_map(
        |(origin, mass, spread, rpy)| {
            let [x, y, z] = spread.map(|s| mass * s);
            let moments = [y + z, x + z, x + y];
            let r = super::transform::rotation_of_rpy(rpy);
            let element = |i: usize, j: usize| {
                Some((0..3).map(|k| r[i][k] * moments[k] * r[j][k]).sum::<f64>())
            };
            Inertial {
                origin,
                mass: Some(Mass { value: mass }),
                inertia: Some(Inertia {
                    ixx: element(0, 0),
                    ixy: element(0, 1),
                    ixz: element(0, 2),
                    iyy: element(1, 1),
                    iyz: element(1, 2),
                    izz: element(2, 2),
                }),
            }
        },
    )
}

fn any_geometry(round: bool) -> impl Strategy<Value = Geometry> {
    let files: Vec<String> = FOUND.iter().map(|(file, _)| (*file).to_owned()).collect();
    let found = (select(files), rarely(prop::array::uniform3(positive())))
        .prop_map(|(filename, scale)| mesh(&filename, scale));
    let angular = prop_oneof![
        4 => prop::array::uniform3(positive()).prop_map(cuboid),
        3 => found,
        1 => Just(mesh(MISSING, None)),
    ];
    let rounded = prop_oneof![
        positive().prop_map(|radius| Geometry::Sphere(Sphere { radius })),
        (positive(), positive())
            .prop_map(|(radius, length)| Geometry::Cylinder(Cylinder { radius, length })),
        (positive(), positive())
            .prop_map(|(radius, length)| Geometry::Capsule(Capsule { radius, length })),
    ];
    if round { prop_oneof![1 => angular, 1 => rounded].boxed() } else { angular.boxed() }
}

fn material() -> impl Strategy<Value = Material> {
    let color = prop::array::uniform4(0.0..1.0f64).prop_map(|rgba| Color { rgba });
    let texture = name().prop_map(|name| Texture { filename: format!("{name}.png") });
    (name(), option(color), rarely(texture)).prop_map(|(name, color, texture)| Material {
        name: Some(name),
        color,
        texture,
    })
}

/// Elements that URDF does not define, as XML text.
fn unknown() -> impl Strategy<Value = Vec<String>> {
    let elements = [
        "<gazebo/>",
        "<gazebo reference=\"a &gt; b\">\n  <kp>1e6</kp>\n  <!-- kept -->\n</gazebo>",
        "<sensor name='a/>b' type=\"ray\"><ray/></sensor>",
        "<x:plugin xmlns:x=\"urn:x\"><x:a>λ &amp; <![CDATA[<b>]]></x:a></x:plugin>",
        "<transmission><transmission/></transmission >",
    ];
    let element = select(elements.to_vec()).prop_map(str::to_owned);
    prop::collection::vec(element, 0..3).prop_map(|v| if v.len() == 2 { v } else { Vec::new() })
}
