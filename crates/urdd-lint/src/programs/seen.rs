//! Which rules see which faults that programs name.

use urdd_findings::code::Code::{self, *};
use urdd_programs::{Fault, MASSLESS, MASSLESS_WITH_OTHERS};

/// How far from the fault the finding of a rule may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reach {
    /// At the same element.
    Element,
    /// At the element that it is in, or at one beside it.
    Beside,
    /// In the same link or joint.
    Part,
    /// At the part that the fault names.
    Named,
    /// At the robot as a whole.
    Robot,
    /// Anywhere in the file.
    File,
}

use Reach::{Beside, Element, File, Named, Part, Robot};

/// Rules, and how far from a fault they see it.
type Seeing = (Reach, &'static [Code]);

const OF_INERTIA: &[Code] = &[SRC003, SRC004, SRC005, LNT006, LNT008];
const OF_FILES: &[Code] = &[LNT026, LNT027, LNT028, LNT029, LNT030];
/// Whatever is missing.
const OF_MISSING: Seeing = (Element, &[URD011, LNT015]);

/// How far from a fault a rule sees it; `None` if it is about something else.
pub fn sees(code: Code, fault: &Fault) -> Option<Reach> {
    let seeing = seeing(fault).iter().find(|(_, codes)| codes.contains(&code));
    seeing.map(|(reach, _)| *reach)
}

/// The rules that see a fault. The first place of a rule counts.
fn seeing(fault: &Fault) -> &'static [Seeing] {
    match fault {
        Fault::Xml(_) | Fault::NotRobot => &[(File, &[URD011])],
        Fault::Tree(_) => &[(File, &[URD004, URD005, URD006])],
        // A mass that is next to nothing makes no density.
        Fault::Inertia(_) if [MASSLESS, MASSLESS_WITH_OTHERS].contains(fault) => {
            &[(Beside, &[URD011]), (Robot, &[LNT006]), (Part, &[LNT003]), (Part, OF_INERTIA)]
        }
        // LNT006: no link has a mass.
        Fault::Inertia(_) => &[(Beside, &[URD011]), (Robot, &[LNT006]), (Part, OF_INERTIA)],
        // A joint names a link without a name.
        Fault::Empty("link") => &[(Named, &[LNT015]), (Element, &[URD004, URD007]), OF_MISSING],
        Fault::Missing(name) | Fault::MissingElement(name) | Fault::Empty(name) => {
            seeing_missing(name)
        }
        Fault::NotANumber { .. } | Fault::Count { .. } => {
            &[(Beside, OF_INERTIA), (Element, &[URD011])]
        }
        Fault::Value { .. } => &[(Element, &[URD011, URD012])],
        Fault::Range { .. } => &[
            (Element, &[LNT012, LNT013, LNT023, LNT033, LNT048, URD010, URD011, SRC009]),
            (Element, OF_INERTIA),
        ],
        Fault::Type(_) => &[(Beside, &[URD012])],
        Fault::Repeated(_) => &[(Beside, &[SRC008, LNT008, URD011])],
        Fault::NotUnique { .. } => &[(Element, &[URD002, URD003, LNT015])],
        Fault::Unknown { .. } => &[
            (Part, &[URD007, URD008]),
            (Named, &[LNT041, LNT048]),
            (Element, &[LNT042, LNT043, URD011]),
        ],
        Fault::UnknownElement { .. } | Fault::UnknownAttribute { .. } => {
            &[(Beside, &[URD011, LNT008]), (Element, &[LNT040, LNT046, LNT047])]
        }
        Fault::Shape(_) => &[(Element, &[LNT040, LNT046, LNT047, URD011])],
        Fault::Limits(_) => &[(Element, &[SRC001, LNT014])],
        Fault::NotFound(_) => &[(Element, OF_FILES)],
        Fault::Mesh(_) => {
            &[(Beside, OF_FILES), (Beside, &[LNT020, LNT022, LNT023, LNT024, LNT034, LNT035])]
        }
        Fault::Name { .. } => &[(Named, &[LNT015])],
        Fault::Version(_) => &[(Element, &[URD011])],
        Fault::Other(_) => {
            &[(Part, &[URD009, URD010]), (Beside, &[LNT008, URD011, URD012, LNT046])]
        }
        Fault::NeverRead(_) | Fault::Way(_) | Fault::ForOthers(_) => &[],
    }
}

/// The rules that see that an element or attribute is missing.
fn seeing_missing(name: &str) -> &'static [Seeing] {
    match name {
        // The root, in Gazebo, where no link has a mass.
        "inertial" => &[(Robot, &[LNT006]), (Part, &[LNT008]), OF_MISSING],
        "mass" | "inertia" | "value" => &[(Part, &[LNT006, LNT008]), OF_MISSING],
        name if name.len() == 3 && name.starts_with('i') => {
            &[(Part, &[LNT006, LNT008]), OF_MISSING]
        }
        "limit" | "lower" | "upper" | "effort" | "velocity" => {
            &[(Part, &[SRC006, LNT017]), OF_MISSING]
        }
        "axis" | "xyz" => &[(Part, &[LNT016]), OF_MISSING],
        "joint" => &[(Element, &[URD008]), OF_MISSING],
        "link" => &[(Element, &[URD004, URD007]), OF_MISSING],
        "filename" => &[(Element, OF_FILES), OF_MISSING],
        _ => &[OF_MISSING],
    }
}
