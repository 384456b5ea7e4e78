//! Notes about combined robots.

use std::fmt;

use crate::note as generated;
use urdd_format::escape;

/// A note about combined robots.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Note {
    /// A deviation in the URDF of a part.
    Part {
        /// The part.
        part: String,
        /// The note from the generator.
        note: generated::Note,
    },
    /// The URDD of the part has no file for a mesh in its URDF.
    NoMesh {
        /// The part.
        part: String,
        /// The mesh file name as written in the URDF.
        name: String,
    },
    /// A legacy URDD lacks the original mesh of a link; the plain mesh is used.
    PlainMesh {
        /// The part.
        part: String,
        /// The link.
        link: String,
    },
    /// A material references a texture file. URDDs store the textures of meshes, not those of materials.
    Texture {
        /// The part.
        part: String,
        /// The texture file name as written in the URDF.
        name: String,
    },
    /// In an element that URDF does not define, a value equals the name of a link or joint. It was not renamed, since
    /// it may mean something else.
    LeftAlone {
        /// The part.
        part: String,
        /// `element`, or `element@attribute`.
        place: String,
        /// The name.
        name: String,
    },
    /// An element was removed with the link or joint that it names.
    Gone {
        /// The part.
        part: String,
        /// The element and the name.
        what: String,
    },
    /// A joint was frozen because the joint that it mimics was frozen.
    Following {
        /// The part.
        part: String,
        /// The joint.
        joint: String,
    },
    /// A skip edit names a dropped link.
    EditLost {
        /// The part.
        part: String,
        /// One link.
        link_a: String,
        /// The other.
        link_b: String,
    },
    /// A named configuration has the name, in the combined robot, of an earlier one.
    ConfigurationLost {
        /// The part.
        part: String,
        /// The configuration.
        name: String,
    },
    /// A named configuration has a position of a joint that is dropped or frozen.
    PositionLost {
        /// The part.
        part: String,
        /// The configuration.
        name: String,
        /// The DOF.
        dof: String,
    },
    /// A legacy module has content that a recipe cannot express, or lacks what a recipe needs.
    NotSaid(String),
    /// The parts skip pairs for different reasons.
    ReasonsDiffer,
    /// The parts have different modules.
    UnequalModules {
        /// The part.
        part: String,
        /// The modules that it lacks and others have.
        lacks: Vec<String>,
    },
}

impl Note {
    /// A machine-readable name of its kind.
    pub fn kind(&self) -> &'static str {
        match self {
            Note::Part { note, .. } => note.kind.as_str(),
            Note::NoMesh { .. } => "mesh-not-found",
            Note::PlainMesh { .. } => "plain-mesh",
            Note::Texture { .. } => "texture",
            Note::LeftAlone { .. } => "left-alone",
            Note::Gone { .. } => "gone",
            Note::Following { .. } => "following",
            Note::EditLost { .. } => "edit-lost",
            Note::ConfigurationLost { .. } => "configuration-lost",
            Note::PositionLost { .. } => "position-lost",
            Note::NotSaid(_) => "not-said",
            Note::ReasonsDiffer => "reasons-differ",
            Note::UnequalModules { .. } => "unequal-modules",
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = escape::line;
        match self {
            Note::Part { part, note } => write!(f, "part `{}`: {note}", line(part)),
            Note::NoMesh { part, name } => write!(
                f,
                "part `{}`: its URDD has no file for mesh `{}`: not carried; the element has no surface",
                line(part),
                line(name)
            ),
            Note::PlainMesh { part, link } => write!(
                f,
                "part `{}`: its URDD lacks the original mesh of link `{}`; the plain mesh is used, without colours",
                line(part),
                line(link)
            ),
            Note::Texture { part, name } => write!(
                f,
                "part `{}`: texture `{}` of a material is not carried; its name is unchanged, and the file stays where it is",
                line(part),
                line(name)
            ),
            Note::LeftAlone { part, place, name } => write!(
                f,
                "part `{}`: `{}` contains `{}`, the name of a link or joint, and was left unchanged; if it refers to that, write names = [\"{}\"]",
                line(part),
                line(place),
                line(name),
                line(place)
            ),
            Note::Gone { part, what } => write!(f, "part `{}`: left out {}", line(part), line(what)),
            Note::Following { part, joint } => write!(
                f,
                "part `{}`: joint `{}` mimics a frozen joint, and is frozen at the position that follows",
                line(part),
                line(joint)
            ),
            Note::EditLost {
                part,
                link_a,
                link_b,
            } => write!(
                f,
                "part `{}`: the edit of the skips between `{}` and `{}` is left out, since one of them is dropped",
                line(part),
                line(link_a),
                line(link_b)
            ),
            Note::ConfigurationLost { part, name } => write!(
                f,
                "part `{}`: the configuration `{}` is left out, since an earlier part has one of this name; give the part a prefix",
                line(part),
                line(name)
            ),
            Note::PositionLost { part, name, dof } => write!(
                f,
                "part `{}`: the configuration `{}` is kept without a position of `{}`, whose joint is dropped or frozen",
                line(part),
                line(name),
                line(dof)
            ),
            Note::NotSaid(what) => f.write_str(&line(what)),
            Note::ReasonsDiffer => f.write_str(
                "the parts skip pairs for different reasons; the default ones are used: same-link, always, adjacent, default (`--skip` chooses others)",
            ),
            Note::UnequalModules { part, lacks } => write!(
                f,
                "part `{}` has no {}, which other parts have; it is computed",
                line(part),
                lacks.join(", ")
            ),
        }
    }
}
