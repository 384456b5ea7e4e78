//! What an export gives: its files, and notes on what the format cannot express.

use thiserror::Error;

use crate::{Contacts, Limited, LinkPair, Ros, ShapeCounts, Shapes};
use urdd_format::urdf::Link;

/// Files by path.
pub(super) type Files = Vec<(String, Vec<u8>)>;

/// The result of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The text of the file.
    pub text: String,
    /// The path of the text in an exported folder; `None` for a format of one file, which has a path of its own.
    pub path: Option<String>,
    /// The other files of the folder; or those that the text references, with paths relative to it, sorted, and then an
    /// MJCF's scene, which includes it.
    pub files: Files,
    /// What the format cannot express, or expresses differently.
    pub notes: Vec<Note>,
    /// What was carried, carried otherwise and lost of this robot, and the notes: JSON.
    pub report: String,
}

impl Export {
    /// A text with the files that it references; not in a folder, and without a report yet.
    pub(super) fn of(text: String, files: Files, notes: Vec<Note>) -> Self {
        Export { text, path: None, files, notes, report: String::new() }
    }
}

/// Puts values in the place of words between `@`. A value may have the word of another: a line has one word at most. A
/// word alone on its line stands for any number of whole lines.
pub(super) fn fill(template: &str, values: &[(&str, String)]) -> String {
    let mut text = String::new();
    for line in template.lines() {
        let word = |word: &str| format!("@{word}@");
        let filled = match values.iter().find(|(name, _)| line.contains(&word(name))) {
            Some((name, value)) => line.replace(&word(name), value),
            None => format!("{line}\n"),
        };
        text += &filled;
        if !filled.is_empty() && !filled.ends_with('\n') {
            text.push('\n');
        }
    }
    text
}

/// What a format cannot express, or expresses differently.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Error)]
#[non_exhaustive]
pub enum Note {
    /// A link-level format, and two links of which the URDD skips some pairs of shapes and checks others.
    #[error("{}", mixed(.links, *.disabled, [*.checked, *.skipped], .contacts.as_ref()))]
    Mixed {
        /// The names of the two links.
        links: [String; 2],
        /// Whether the pair is disabled; otherwise it is checked.
        disabled: bool,
        /// Number of pairs of shapes that the URDD checks.
        checked: usize,
        /// Number of pairs of shapes that it skips.
        skipped: usize,
        /// The contacts in sampled configurations, if counted.
        contacts: Option<Contacts>,
    },
    /// A link's mass or inertia is exported differently.
    #[error("link `{}`: {what}", .link.escape_debug())]
    Inertia {
        /// The link.
        link: String,
        /// What is exported instead, and why.
        what: &'static str,
    },
    /// Links that are exported differently.
    #[error("{} {what}", some(.links))]
    Links {
        /// The links; at least one.
        links: Vec<String>,
        /// What they have, and what is exported instead.
        what: &'static str,
    },
    /// A joint that the format cannot express exactly.
    #[error("joint `{}`: {what}", .joint.escape_debug())]
    Joint {
        /// The joint.
        joint: String,
        /// What is exported instead.
        what: &'static str,
    },
    /// Links that are joined with those that they are fixed to.
    #[error("joined with what they are fixed to, and kept as frames: {}", few(.0))]
    Joined(Vec<String>),
    /// A link whose frame is elsewhere, since another joint moves it.
    #[error("link `{}`: its frame is at joint `{}`, which moves it now; that of the source is `{}`", .link.escape_debug(), .joint.escape_debug(), .frame.escape_debug())]
    Moved {
        /// The link.
        link: String,
        /// The joint.
        joint: String,
        /// The name of the frame that it had.
        frame: String,
    },
    /// A group that is exported differently.
    #[error("group `{}`: {what}", .group.escape_debug())]
    Group {
        /// The group.
        group: String,
        /// What is exported instead.
        what: &'static str,
    },
    /// Joints that MoveIt moves, without a limit.
    #[error("joints without a limit of {}: {}; {}. Write {}", .what.word(), few(.joints), .ros.without_limit(), .what.place())]
    Unlimited {
        /// What has no limit.
        what: Limited,
        /// The joints; at least one.
        joints: Vec<String>,
        /// Whose MoveIt moves them.
        ros: Ros,
    },
    /// A joint that has another name in the file.
    #[error("joint `{}` is called `{}`: a link has its name, or the format keeps it for itself", .joint.escape_debug(), .name.escape_debug())]
    Renamed {
        /// The joint.
        joint: String,
        /// Its name in the file.
        name: String,
    },
    /// Names that USD cannot have.
    #[error("USD has only letters, digits and `_` in names, and no two of one name in one place: written in another way, and shown as they are, are {}", few(.0))]
    Mended(Vec<String>),
    /// Groups, end effectors and tool frames were guessed.
    #[error(
        "groups, end effectors and tool frames are guessed: `urdd export init` writes the guesses to a file, to be checked"
    )]
    Guessed,
    /// Something about the robot as a whole, or its root link, that is exported in another way than was asked for.
    #[error("{0}")]
    Robot(&'static str),
    /// Elements that URDF does not define and that cannot be copied into the file.
    #[error(
        "{0} elements that URDF does not define are left out: they use prefixes that only the source file declares, have namespaces that are not URIs or, for MoveIt, are xacro's, or are not well-formed on their own"
    )]
    Elements(usize),
    /// A transmission or a loop that the format's reader rejects.
    #[error("a `<{element}>` is left out: {reason}")]
    Element {
        /// The element's name.
        element: &'static str,
        /// Why.
        reason: &'static str,
    },
    /// Loops or couplings that are not in the file.
    #[error("{} left out: {why}", which(.what, .names))]
    LeftOut {
        /// `loop` or `coupling`.
        what: &'static str,
        /// Their names; at least one.
        names: Vec<String>,
        /// Why.
        why: String,
    },
    /// Spheres whose error rates exceed the goals.
    #[error("the spheres are not good enough to plan with: {0}")]
    Spheres(String),
    /// The configuration to which cuRobo retracts is in contact.
    #[error("the retract configuration is in contact: spheres of links `{}` and `{}` overlap by {millimetres} mm; cuRobo refuses it. Name another in `[curobo] retract`", .links[0].escape_debug(), .links[1].escape_debug())]
    Retract {
        /// The names of the two links.
        links: [String; 2],
        /// By how much their spheres overlap, mm.
        millimetres: String,
    },
    /// A flat shape, which the format cannot represent without thickness.
    #[error("link `{}`: a flat piece is a box of {thickness} m", .link.escape_debug())]
    Flat {
        /// The link.
        link: String,
        /// The assumed thickness, in metres.
        thickness: &'static str,
    },
    /// What the format cannot carry: what, and how many.
    #[error("left out, since the format has no place for them: {0}")]
    Lost(String),
    /// Programs that have the joints in another order than the URDD.
    #[error(
        "the joints are in another order than in the URDD in {0}: `urdd info --order` lists it"
    )]
    Order(String),
    /// A texture that is not in the export.
    #[error("texture `{}` is left out, and what it covers has a plain colour: {reason}", .texture.escape_debug())]
    LostTexture {
        /// Its path in the URDD; of one in a mesh, that of the mesh, and what stands for its name.
        texture: String,
        /// Why.
        reason: String,
    },
    /// Textures that are written as PNG.
    #[error("written as PNG, since MuJoCo and Drake show no JPEG: {}", all(.0))]
    ConvertedTextures(Vec<String>),
    /// Visual geometry with fewer triangles.
    #[error("visual geometry has {to} of {from} triangles; where it was sampled, it deviates from the original by at most {} mm", *.micrometres as f64 / 1e3)]
    Simplified {
        /// Number of triangles of the original.
        from: usize,
        /// Number of triangles in the export.
        to: usize,
        /// The greatest sampled distance between both surfaces, um.
        micrometres: u64,
    },
    /// The collision geometry of the source is in the file: how many shapes of which kinds.
    #[error(
        "the shapes are those of the source, {0}; pairs, where the format has them, are judged by these"
    )]
    SourceShapes(ShapeCounts),
    /// Primitives are in the place of convex meshes.
    #[error("{} of {of} convex meshes are primitives that enclose them ({counts}), each with {costs}{}", .counts.total(), judged(*.counts))]
    Fitted {
        /// How many primitives of which kinds.
        counts: ShapeCounts,
        /// Number of convex meshes before.
        of: usize,
        /// What a primitive may cost.
        costs: String,
    },
    /// The collision geometry of the source is not in the file, or in another form.
    #[error("the source's collision geometry ({elements}) is not taken as it is, but {shapes}{}: choose the shapes `source` to keep it", if *.is_visual { " of visual geometry" } else { "" })]
    NotOfSource {
        /// How many shapes of which kinds.
        elements: ShapeCounts,
        /// What is in the file.
        shapes: Shapes,
        /// Whether that is made of visual geometry, at least of some links.
        is_visual: bool,
    },
    /// No link has shapes of the requested kind.
    #[error("no link has {0}: the file has no collision geometry")]
    NoShapes(Shapes),
}

impl Note {
    /// A note on links, by their indices, if there are any.
    pub(super) fn of_links(links: Vec<usize>, all: &[Link], what: &'static str) -> Option<Note> {
        let name = |link: usize| all.get(link).map(|link| link.name.clone());
        Note::links(links.into_iter().filter_map(name).collect(), what)
    }

    /// A note on links, by their names, if there are any.
    pub(super) fn links(links: Vec<String>, what: &'static str) -> Option<Note> {
        (!links.is_empty()).then_some(Note::Links { links, what })
    }

    pub(super) fn joint(joint: &str, what: &'static str) -> Note {
        let joint = joint.to_owned();
        Note::Joint { joint, what }
    }

    /// The note of a link-level format on a pair of links. `None` if all their pairs of shapes are treated alike, or if
    /// the pair is checked and the skipped shapes never touched.
    pub fn of_pair(pair: &LinkPair) -> Option<Note> {
        let mixed = pair.mixed.as_ref()?;
        let is_wrong = |contacts: Contacts| pair.disabled || contacts.skipped > 0;
        (mixed.contacts.map_or(pair.disabled, is_wrong)).then(|| Note::Mixed {
            links: pair.names.clone(),
            disabled: pair.disabled,
            checked: mixed.checked.len(),
            skipped: mixed.skipped.len(),
            contacts: mixed.contacts,
        })
    }
}

/// Number of names in a note.
const SHOWN: usize = 5;

/// Names of links, the first few of many, and a verb.
fn some(links: &[String]) -> String {
    let shown = if links.len() > SHOWN { SHOWN - 1 } else { SHOWN };
    let names = all(&links[..shown.min(links.len())]);
    match links.len() {
        1 => format!("link {names} has"),
        count if count > SHOWN => format!("links {names} and {} others have", count - shown),
        _ => format!("links {names} have"),
    }
}

/// Names, the first few of many.
fn few(names: &[String]) -> String {
    match names.len().saturating_sub(SHOWN) {
        0 => all(names),
        more => format!("{} and {more} others", all(&names[..SHOWN])),
    }
}

/// What has these names, and a verb.
fn which(what: &str, names: &[String]) -> String {
    match names {
        [name] => format!("{what} `{}` is", name.escape_debug()),
        _ => format!("{what}s {} are", few(names)),
    }
}

fn all(names: &[String]) -> String {
    names.iter().map(|name| format!("`{}`", name.escape_debug())).collect::<Vec<_>>().join(", ")
}

fn mixed(
    links: &[String; 2],
    disabled: bool,
    [checked, skipped]: [usize; 2],
    contacts: Option<&Contacts>,
) -> String {
    let [a, b] = links.each_ref().map(|name| name.escape_debug());
    let all = checked + skipped;
    let (done, count) = if disabled {
        ("disabled", format!("checks {checked}"))
    } else {
        ("checked", format!("skips {skipped}"))
    };
    let text = format!(
        "links `{a}` and `{b}` are {done} as a whole, though the URDD {count} of the {all} pairs of their pieces"
    );
    match (contacts, disabled) {
        (None, _) => text,
        (Some(contacts), true) => format!(
            "{text}: collisions are lost in {} of {} sampled configurations",
            contacts.checked, contacts.samples
        ),
        (Some(contacts), false) => format!(
            "{text}: these touch in {} of {} sampled configurations",
            contacts.skipped, contacts.samples
        ),
    }
}

fn judged(fitted: ShapeCounts) -> &'static str {
    match fitted.total() {
        0 => "",
        _ => "; pairs, where the format has them, are judged by these",
    }
}
