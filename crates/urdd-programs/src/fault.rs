//! What in a file makes a program do something else than its author meant, in words that hold for all programs.

use std::fmt;

use urdd_format::short::Short;

use crate::tree::Attribute;

/// A reason. Programs that do something at one place for one reason share a sentence.
// Fields are what the sentence of a fault names.
#[allow(missing_docs)]
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Fault {
    /// The parser of XML cannot read the file.
    Xml(&'static str),
    /// The root is another element.
    NotRobot,
    /// An attribute that is needed is not there.
    Missing(&'static str),
    /// An element that is needed is not there.
    MissingElement(&'static str),
    /// An attribute is empty.
    Empty(&'static str),
    /// Text that is no number to the program.
    NotANumber { attribute: Short, text: Short },
    /// Another count of numbers than there should be.
    Count { attribute: Short, expected: usize, text: Short },
    /// A number outside of what is allowed: "must not be negative".
    Range { attribute: Short, text: Short, rule: &'static str },
    /// Another element of a name that stands once.
    Repeated(Short),
    /// Another part of the same kind and name.
    NotUnique { kind: &'static str, name: Short },
    /// Refers to something that is not there.
    Unknown { kind: &'static str, name: Short },
    /// A value that is none of those that are allowed.
    Value { attribute: Short, text: Short },
    /// A type of joints that URDF has, and the program does not, or not here.
    Type(&'static str),
    /// A shape that the program does not know.
    Shape(Short),
    /// An element or attribute that the program never reads.
    NeverRead(Short),
    /// What the program does with every such part, or because of another fault: nothing is wrong there.
    Way(&'static str),
    /// An element that URDF does not have in its place, and the one that it looks like.
    UnknownElement { name: Short, like: &'static str },
    /// An attribute that its element does not have, and the one that it looks like.
    UnknownAttribute { name: Short, like: &'static str },
    /// The joints and links make no tree.
    Tree(&'static str),
    /// A mass or an inertia that no body can have, or that is not there.
    Inertia(&'static str),
    /// The limits of a joint against each other, or against its type.
    Limits(&'static str),
    /// There is no file of this name: of a `mesh` or a `texture`.
    NotFound(&'static str),
    /// A mesh file that is not as it should be.
    Mesh(&'static str),
    /// A mesh in a format, or under a name, that other programs take: no fault of the robot.
    ForOthers(&'static str),
    /// The version of URDF on `<robot>`.
    Version(Short),
    /// A name that the program cannot have.
    Name { kind: &'static str, name: Short, rule: &'static str },
    /// What ros2_control does not take, and what to do.
    Control(&'static str, &'static str),
    /// A value that ros2_control does not take, and what it takes.
    ControlValue { attribute: &'static str, text: Short, expected: &'static str },
    /// Anything else, as a sentence without its end.
    Other(&'static str),
}

/// A mesh in a format that a program does not know.
pub const FORMAT: Fault = Fault::ForOthers("the mesh is in a format that the program cannot read");

/// A mesh in a format that hardly any program knows.
pub const RARE_FORMAT: Fault =
    Fault::Mesh("the mesh is in a format that few programs for robots read");

/// A mesh in a package that is not here: other programs may know where it is.
pub const NO_PACKAGE: Fault =
    Fault::ForOthers("the package of the mesh is not here, and the program needs it");

/// A COLLADA file that only lenient readers of XML read.
pub const BEGINS_LATE: Fault =
    Fault::Mesh("white space is before `<?xml` in the file of the mesh, where XML has none");

/// The same.
pub const HAS_MORE: Fault = Fault::Mesh("more is behind the outermost element of the mesh's file");

/// A link without mass, which Gazebo leaves out.
pub const MASSLESS: Fault = Fault::Inertia("a link without mass is left out, with all below");

/// The same, and others go with it.
pub const MASSLESS_WITH_OTHERS: Fault =
    Fault::Inertia("links without mass are left out, and others are fixed to them or below");

/// A link without a shape is merged into the one above, and has joints below.
pub const MERGED: Fault =
    Fault::Inertia("its inertia goes to the link above, and all below it is lost");

/// A joint mimics one that the program does not have as a joint.
pub const FOLLOWS_NONE: Fault = Fault::Other("the joint that it follows is fixed, or left out");

/// The shape of a visual or collision is missing.
pub const NO_SHAPE: Fault = Fault::Other("`<geometry>` has no shape");

pub const CROSSED: Fault = Fault::Limits("`lower` is above `upper`");
pub const NO_DYNAMICS: Fault = Fault::Other("`<dynamics>` has neither damping nor friction");
/// What a colour breaks.
pub const COLOR_RULE: &str = "a colour is of numbers from 0 to 1";
pub const MIMICS_ITSELF: Fault = Fault::Other("the joint mimics itself");

pub const NO_ROOT: Fault = Fault::Tree("no link is the root");
pub const TWO_ROOTS: Fault = Fault::Tree("two links have no joint above them");
pub const TWO_PARENTS: Fault = Fault::Tree("a link is the child of two joints");
pub const UNREACHED: Fault = Fault::Tree("it is in a loop, which the root does not reach");

/// What a limit has since URDF 1.2.
pub const FURTHER: &str = "acceleration deceleration jerk";
/// The numbers of an `<inertia>`.
pub const MOMENTS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
/// The types of joints that URDF has.
pub const JOINT_TYPES: &[&str] =
    &["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];

impl Fault {
    pub(crate) fn not_a_number(value: &Attribute) -> Fault {
        Fault::NotANumber { attribute: (&*value.name).into(), text: (&*value.value).into() }
    }

    pub(crate) fn count(value: &Attribute, expected: usize) -> Fault {
        let (attribute, text) = ((&*value.name).into(), (&*value.value).into());
        Fault::Count { attribute, expected, text }
    }

    pub(crate) fn range(value: &Attribute, rule: &'static str) -> Fault {
        Fault::range_of(&value.name, &value.value, rule)
    }

    pub(crate) fn range_of(attribute: &str, text: &str, rule: &'static str) -> Fault {
        Fault::Range { attribute: attribute.into(), text: text.into(), rule }
    }

    pub(crate) fn value(attribute: &str, text: &str) -> Fault {
        let mut types = JOINT_TYPES.iter().chain(&["spherical"]);
        match types.find(|one| attribute == "type" && **one == text) {
            Some(known) => Fault::Type(known),
            None => Fault::Value { attribute: attribute.into(), text: text.into() },
        }
    }

    pub(crate) fn value_but(attribute: &'static str, text: &str, expected: &'static str) -> Fault {
        Fault::ControlValue { attribute, text: text.into(), expected }
    }

    pub(crate) fn not_unique(kind: &'static str, name: &str) -> Fault {
        Fault::NotUnique { kind, name: name.into() }
    }

    pub(crate) fn unknown(kind: &'static str, name: &str) -> Fault {
        Fault::Unknown { kind, name: name.into() }
    }

    pub(crate) fn name(kind: &'static str, name: &str, rule: &'static str) -> Fault {
        Fault::Name { kind, name: name.into(), rule }
    }

    /// A link below a joint has the name of the world.
    pub(crate) fn world() -> Fault {
        Fault::name("link", "world", "this is the world itself")
    }

    /// Whether the program does so with every robot.
    pub fn is_usual(&self) -> bool {
        matches!(self, Fault::NeverRead(_) | Fault::Way(_))
    }

    /// Whether something is wrong with the robot: not what is usual, and no mesh that other programs take.
    pub fn is_of_robot(&self) -> bool {
        !self.is_usual() && !matches!(self, Fault::ForOthers(_))
    }

    /// Whether another fault at the same element is the same one, said otherwise.
    pub fn is_alike(&self, other: &Fault) -> bool {
        fn name(fault: &Fault) -> Option<&str> {
            match fault {
                Fault::Missing(name) | Fault::MissingElement(name) | Fault::Empty(name) => {
                    Some(name)
                }
                Fault::Repeated(name) | Fault::Shape(name) => Some(name),
                Fault::NotUnique { kind, .. } | Fault::Unknown { kind, .. } => Some(kind),
                Fault::ControlValue { attribute, .. } => Some(attribute),
                _ => None,
            }
        }
        let is_plain = !matches!(self, Fault::Other(_) | Fault::Control(..));
        std::mem::discriminant(self) == std::mem::discriminant(other)
            && name(self) == name(other)
            && (is_plain || self == other)
    }

    /// What to do about it.
    pub fn advice(&self) -> &'static str {
        match self {
            Fault::Xml(_) => "mend the XML",
            Fault::NotRobot => "make `<robot>` the root",
            Fault::Missing(_) | Fault::MissingElement(_) | Fault::Empty(_) => "write it",
            Fault::NotANumber { .. } => {
                "write a decimal number, such as `1.5`, without white space around it"
            }
            Fault::Count { .. } => "write them with single spaces between them",
            Fault::Range { .. } => "write another number",
            Fault::Repeated(_) => "keep one",
            Fault::NotUnique { name, .. } if name.is_empty() => "give each a name of its own",
            Fault::NotUnique { .. } => "rename one of them, or remove it",
            Fault::Unknown { .. } => "mend the name, or add what it names",
            Fault::Value { .. } => "write one of those that URDF defines",
            Fault::Type(_) => "use joints that the program has",
            Fault::Shape(shape) if **shape == *"capsule" => {
                "use other shapes, or write `version=\"1.1\"` on `<robot>` for ROS (urdfdom 6) and Pinocchio alone"
            }
            Fault::Shape(_) => "use box, cylinder, sphere or mesh",
            Fault::NeverRead(_) | Fault::Way(_) => "do not rely on it there",
            Fault::UnknownElement { .. } | Fault::UnknownAttribute { .. } => {
                "correct the name, or move it to its place"
            }
            Fault::Tree(_) => "give each link but one a joint of which it is the child",
            fault if *fault == MERGED => "write its inertia in the link above",
            Fault::Inertia(_) => {
                "write the mass and the inertia of the body, about its centre of mass"
            }
            Fault::Limits(_) => "write limits that the joint has",
            Fault::NotFound(_) => "mend its name, or put the file there",
            fault if *fault == RARE_FORMAT => "export it as STL, OBJ or COLLADA",
            Fault::Mesh(_) | Fault::ForOthers(_) => {
                "export the mesh in another format, or mend its file"
            }
            Fault::Version(_) => "write `1.0`, or remove it",
            // Another program may need its name.
            Fault::Name { kind, .. } if kind.starts_with("attribute") => {
                "rename it, or give these programs a file without it"
            }
            Fault::Name { .. } => "rename it",
            fault if *fault == FOLLOWS_NONE => {
                "let it follow a joint that moves, with a mass in the link below"
            }
            Fault::Control(_, advice) => advice,
            Fault::ControlValue { .. } => "write such a value",
            Fault::Other(_) => "mend it",
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Xml(what)
            | Fault::Inertia(what)
            | Fault::Limits(what)
            | Fault::Tree(what)
            | Fault::Mesh(what)
            | Fault::ForOthers(what)
            | Fault::Way(what)
            | Fault::Control(what, _)
            | Fault::Other(what) => f.write_str(what),
            Fault::NotFound(kind) => write!(f, "the file of the {kind} was not found"),
            Fault::NotRobot => f.write_str("the root is not `<robot>`"),
            Fault::Missing(attribute) => write!(f, "`{attribute}` is missing"),
            Fault::MissingElement(element) => write!(f, "`<{element}>` is missing"),
            Fault::Empty(attribute) => write!(f, "`{attribute}` is empty"),
            Fault::NotANumber { attribute, text } => {
                write!(f, "`{attribute}` is `{text}`, which is not only a number")
            }
            Fault::Count { attribute, expected, text } => {
                let numbers = if *expected == 1 { "number" } else { "numbers" };
                write!(f, "`{attribute}` is `{text}`, and should be {expected} {numbers}")
            }
            Fault::Range { attribute, text, rule } => {
                write!(f, "`{attribute}` is `{text}`, and {rule}")
            }
            Fault::Repeated(element) => write!(f, "another `<{element}>` is there before"),
            Fault::NotUnique { kind, name } if name.is_empty() => {
                write!(f, "another {kind} has no name either")
            }
            Fault::NotUnique { kind, name } => write!(f, "another {kind} is called `{name}`"),
            Fault::Unknown { kind, name } => write!(f, "no {kind} is called `{name}`"),
            Fault::Value { attribute, text } => write!(f, "`{attribute}` cannot be `{text}`"),
            Fault::Type(kind) => write!(f, "a {kind} joint is not for every program"),
            Fault::Shape(shape) if **shape == *"capsule" => {
                f.write_str("`<capsule>` is not a shape in every program")
            }
            Fault::Shape(shape) => write!(f, "`<{shape}>` is not a shape"),
            Fault::NeverRead(what) => write!(f, "`{what}` is not read"),
            Fault::UnknownElement { name, like } if **name == **like => {
                write!(f, "`<{name}>` is where URDF does not have it")
            }
            Fault::UnknownElement { name, like } => {
                write!(f, "`<{name}>` is not an element of URDF here (`<{like}>` is)")
            }
            Fault::UnknownAttribute { name, like } if **name == **like => {
                write!(f, "`{name}` is on an element that does not have it")
            }
            Fault::UnknownAttribute { name, like } => {
                write!(f, "`{name}` is not an attribute of URDF here (`{like}` is)")
            }
            Fault::ControlValue { attribute, text, expected } => {
                write!(f, "`{attribute}` is `{text}`, where it has to be {expected}")
            }
            Fault::Version(version) => write!(f, "URDF has no version `{version}`"),
            Fault::Name { kind, name, rule } => {
                let a = if kind.starts_with('a') { "an" } else { "a" };
                write!(f, "{a} {kind} is called `{name}`, and {rule}")
            }
        }
    }
}
