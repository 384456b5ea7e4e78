//! Which rules see which faults that programs name.

use urdd_findings::code::Code;
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
    /// Anywhere in the file.
    File,
}

/// How far from a fault a rule sees it; `None` if it is about something else.
pub fn sees(code: Code, fault: &Fault) -> Option<Reach> {
    use Reach::{Beside, Element, File, Part};
    match fault {
        Fault::Xml(_) | Fault::NotRobot => (code == Code::URD011).then_some(File),
        Fault::Tree(_) => {
            matches!(code, Code::URD004 | Code::URD005 | Code::URD006).then_some(File)
        }
        Fault::Inertia(_) if code == Code::URD011 => Some(Beside),
        // No link has a mass.
        Fault::Inertia(_) if code == Code::LNT006 => Some(File),
        // A mass that is next to nothing makes no density.
        Fault::Inertia(_) if code == Code::LNT003 => {
            [MASSLESS, MASSLESS_WITH_OTHERS].contains(fault).then_some(Part)
        }
        Fault::Inertia(_) => of_inertia(code).then_some(Part),
        Fault::Missing(name) | Fault::MissingElement(name) | Fault::Empty(name) => {
            of_missing(code, name)
        }
        Fault::NotANumber { .. } | Fault::Count { .. } if of_inertia(code) => Some(Beside),
        Fault::NotANumber { .. } | Fault::Count { .. } => (code == Code::URD011).then_some(Element),
        Fault::Value { .. } => matches!(code, Code::URD011 | Code::URD012).then_some(Element),
        Fault::Range { .. } => of_range(code).then_some(Element),
        Fault::Type(_) => (code == Code::URD012).then_some(Beside),
        Fault::Repeated(_) => {
            matches!(code, Code::SRC008 | Code::LNT008 | Code::URD011).then_some(Beside)
        }
        Fault::NotUnique { .. } => {
            matches!(code, Code::URD002 | Code::URD003 | Code::LNT015).then_some(Element)
        }
        Fault::Unknown { .. } => of_unknown(code),
        Fault::UnknownElement { .. } | Fault::UnknownAttribute { .. }
            if matches!(code, Code::URD011 | Code::LNT008) =>
        {
            Some(Beside)
        }
        Fault::Shape(_) | Fault::UnknownElement { .. } | Fault::UnknownAttribute { .. } => {
            of_unknown_to_urdf(code).then_some(Element)
        }
        Fault::Limits(_) => matches!(code, Code::SRC001 | Code::LNT014).then_some(Element),
        Fault::NotFound(_) => of_files(code).then_some(Element),
        Fault::Mesh(_) => of_meshes(code).then_some(Beside),
        Fault::Name { .. } => (code == Code::LNT015).then_some(File),
        Fault::Version(_) => (code == Code::URD011).then_some(Element),
        Fault::Other(_) if matches!(code, Code::URD009 | Code::URD010) => Some(Part),
        Fault::Other(_) => {
            matches!(code, Code::LNT008 | Code::URD011 | Code::URD012 | Code::LNT046)
                .then_some(Beside)
        }
        Fault::NeverRead(_) | Fault::Way(_) | Fault::ForOthers(_) => None,
    }
}

fn of_inertia(code: Code) -> bool {
    matches!(code, Code::SRC003 | Code::SRC004 | Code::SRC005 | Code::LNT006 | Code::LNT008)
}

fn of_missing(code: Code, name: &str) -> Option<Reach> {
    match (code, name) {
        // The root, in Gazebo, where no link has a mass.
        (Code::LNT006, "inertial") => Some(Reach::File),
        (Code::LNT006 | Code::LNT008, "inertial" | "mass" | "inertia" | "value") => {
            Some(Reach::Part)
        }
        (Code::LNT006 | Code::LNT008, name) if name.len() == 3 && name.starts_with('i') => {
            Some(Reach::Part)
        }
        (Code::SRC006 | Code::LNT017, "limit" | "lower" | "upper" | "effort" | "velocity") => {
            Some(Reach::Part)
        }
        (Code::LNT016, "axis" | "xyz") => Some(Reach::Part),
        (Code::URD008, "joint") | (Code::URD007, "link") => Some(Reach::Element),
        (Code::URD011 | Code::LNT015, _) => Some(Reach::Element),
        (code, "filename") if of_files(code) => Some(Reach::Element),
        _ => None,
    }
}

fn of_range(code: Code) -> bool {
    let of_lint =
        matches!(code, Code::LNT012 | Code::LNT013 | Code::LNT023 | Code::LNT033 | Code::LNT048);
    of_lint || of_inertia(code) || matches!(code, Code::URD010 | Code::URD011 | Code::SRC009)
}

fn of_unknown(code: Code) -> Option<Reach> {
    match code {
        Code::URD007 | Code::URD008 => Some(Reach::Part),
        Code::LNT041 | Code::LNT048 => Some(Reach::File),
        Code::LNT042 | Code::LNT043 | Code::URD011 => Some(Reach::Element),
        _ => None,
    }
}

fn of_unknown_to_urdf(code: Code) -> bool {
    matches!(code, Code::LNT040 | Code::LNT046 | Code::LNT047 | Code::URD011)
}

fn of_files(code: Code) -> bool {
    matches!(code, Code::LNT026 | Code::LNT027 | Code::LNT028 | Code::LNT029 | Code::LNT030)
}

fn of_meshes(code: Code) -> bool {
    of_files(code)
        || matches!(
            code,
            Code::LNT020 | Code::LNT022 | Code::LNT023 | Code::LNT024 | Code::LNT034 | Code::LNT035
        )
}
