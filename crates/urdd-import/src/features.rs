//! What a description of another format can say, and what an import makes of it: the table of docs/import.md, the counts of
//! one robot, and the report on it.

use std::collections::BTreeMap;
use std::path::PathBuf;

use urdd_format::carried::How::{self, Elsewhere, No, Otherwise, Yes};
use urdd_format::carried::{self, Part, table};
use urdd_source::Format;
use urdd_source::note::{Note, NoteKind, SourcePlace};

use crate::place::{Place, Positions};

/// Something that a description can say, and what becomes of it, by format.
#[derive(Debug, Clone, Copy)]
pub struct Feature {
    /// In the words of people.
    pub name: &'static str,
    /// From MJCF. [`Elsewhere`]: the format cannot say it.
    pub mjcf: How,
    pub sdf: How,
    pub usd: How,
}

macro_rules! features {
    ($($feature:ident = $name:literal, $mjcf:expr, $sdf:expr, $usd:expr;)*) => {
        $(
            #[doc = $name]
            pub const $feature: Feature = Feature { name: $name, mjcf: $mjcf, sdf: $sdf, usd: $usd };
        )*
        /// All of them, in the order of the table.
        pub const ALL: &[Feature] = &[$($feature),*];
    };
}

const FRAME: How = Otherwise("as a link without mass, by a fixed joint");
const EMPTY: How = Otherwise("with a link without mass between, `BODY/JOINT`");
const BALL: How =
    Otherwise("as `type=\"spherical\"`, or with `--ball revolute` as three revolute joints");
const CAPSULE: How = Otherwise("as a cylinder and two spheres");
const ELLIPSOID: How = Otherwise("as a mesh of a sphere, scaled");
const STL: How = Otherwise("as STL");
const STL_OBJ: How = Otherwise("as STL, or with an image as OBJ");
const SLIDE: How = Otherwise("with limits of ±10 m");
const SRDF: How = Otherwise("in the SRDF");
const SETUP: How = Otherwise("in `NAME.export.toml`");
const LOOPS: How = Otherwise("in `NAME.loops.toml`");
const WHOLE: How = Otherwise("as pairs that are checked whole");
const HIDDEN: How = Otherwise("as collision elements alone");
const SCREW: How = Otherwise("as a hinge, and a slide that follows it");
const SIDE: How = Otherwise("with the other limit 10 m or 4π rad away from it, or from 0");
const TURN: How = Otherwise("with parent and child exchanged, and the axis turned round");
const HELD: How = Otherwise("by a fixed joint to the root");
const DEFAULT: How = Otherwise("as 1 kg and 1 kg m², which SDF says that they are");
const CONE: How = Otherwise("as a mesh");
const PART: How = Otherwise("as meshes of their own");
const GAZEBO: How = Otherwise("as text in `<gazebo>`");

features! {
    BODIES = "bodies", Yes, Yes, Yes;
    HINGES = "hinges", Yes, Yes, Yes;
    SLIDES = "slides with limits", Yes, Yes, Yes;
    FREE_SLIDES = "slides without limits", SLIDE, SLIDE, SLIDE;
    BALLS = "balls", BALL, BALL, BALL;
    PLANAR = "planar joints, and floating ones below the root", Elsewhere, Elsewhere, Yes;
    FREE = "the free joint of the root", SETUP, Elsewhere, SETUP;
    MORE_JOINTS = "more joints of a body, and joints away from its frame", EMPTY, EMPTY, EMPTY;
    MASSES = "masses and inertias", Yes, Yes, Yes;
    BOXES = "boxes, spheres and cylinders", Yes, Yes, Yes;
    CAPSULES = "capsules", CAPSULE, CAPSULE, CAPSULE;
    ELLIPSOIDS = "ellipsoids", ELLIPSOID, ELLIPSOID, ELLIPSOID;
    MESHES = "meshes", Yes, Yes, STL_OBJ;
    COLOURS = "colours", Yes, Yes, Yes;
    TEXTURES = "textures", Yes, Yes, Yes;
    FRAMES = "sites, cameras and frames", FRAME, FRAME, FRAME;
    POSES = "named configurations", SRDF, Elsewhere, SRDF;
    MIMICS = "joints that follow others", Yes, Yes, Yes;
    APART = "pairs that never collide", SRDF, SRDF, SRDF;
    GAINS = "gains of actuators, their names and ranges, and armatures", SETUP, Elsewhere, SETUP;
    CLOSED = "closed chains", LOOPS, LOOPS, LOOPS;
    TIES = "welds and connections that are not active, or of a body that is not of the robot, and distances", No, Elsewhere, Elsewhere;
    OPEN = "joints of other kinds that close a chain", Elsewhere, No, No;
    WRITTEN_MESHES = "meshes in the text, and MSH files", STL, Elsewhere, Elsewhere;
    MADE_TEXTURES = "textures that are made, cubes and grids, and images that are not PNG", No, Elsewhere, Elsewhere;
    SURFACES = "planes and height fields", No, No, No;
    DISCARDED = "shapes that `discardvisual` leaves out", No, Elsewhere, Elsewhere;
    ONLY_COLLIDING = "shapes that collide and are hidden: in group 3 and above, transparent, or inside those that are only seen", HIDDEN, Elsewhere, Elsewhere;
    UNSEEN = "shapes that neither collide nor are seen: in group 3 and above, or transparent", No, Elsewhere, Elsewhere;
    SPRINGS = "springs of joints", No, No, No;
    BALL_RANGES = "ranges of balls", No, Elsewhere, No;
    POLYNOMIALS = "equalities of joints that are not linear, or that no mimic can say", LOOPS, Elsewhere, Elsewhere;
    COUPLINGS = "equalities of joints that are not active, or of balls and joints that are left out", No, Elsewhere, No;
    TENDONS = "tendons", No, Elsewhere, No;
    MOTORS = "motors, as the greatest forces of joints", Yes, Elsewhere, Yes;
    MORE_GAINS = "gains and armatures of joints that follow others, and names and ranges of several actuators of one joint", No, Elsewhere, No;
    GRAVCOMP = "gravity compensation of bodies", No, Elsewhere, Elsewhere;
    OTHER_ACTUATORS = "actuators of tendons, sites and bodies, and muscles", No, Elsewhere, No;
    SOFT = "flexes, skins and composites", No, Elsewhere, No;
    CONTACT_PAIRS = "parameters of pairs in contact", No, Elsewhere, Elsewhere;
    PARTLY_APART = "pairs of bodies of which some shapes never collide with some of the other", WHOLE, Elsewhere, WHOLE;
    TORSION = "torsional and rolling friction", No, Elsewhere, Elsewhere;
    FRICTIONS = "coefficients of friction that differ", No, No, No;
    CONTROLS = "velocities, activations and controls of named configurations", No, Elsewhere, Elsewhere;
    BASE_POSES = "poses of the free root in named configurations", SETUP, Elsewhere, Elsewhere;
    MEASURED = "sensors", No, Elsewhere, Elsewhere;
    OWN_DATA = "data of users", No, Elsewhere, Elsewhere;
    SETTINGS = "settings of the simulator and the viewer", No, No, No;
    SCREWS = "screws", Elsewhere, SCREW, Elsewhere;
    GEARBOXES = "gearboxes", Elsewhere, LOOPS, Elsewhere;
    LOST_GEARBOXES = "gearboxes about other axes than their joints turn, or seen from no link", Elsewhere, No, Elsewhere;
    ONE_SIDED = "limits of one side", Elsewhere, SIDE, SIDE;
    TURNED = "joints that lead to their parent", Elsewhere, TURN, TURN;
    DETACHED = "links that no joint holds", Elsewhere, HELD, Elsewhere;
    DEFAULT_MASSES = "masses and inertias that are not given", Elsewhere, DEFAULT, Elsewhere;
    AUTO_MASSES = "masses and inertias of shapes by density", Elsewhere, Yes, Yes;
    CONES = "cones", Elsewhere, CONE, CONE;
    MISSING_MESHES = "meshes and images that are not found or read", No, No, No;
    SUBMESHES = "parts of meshes", Elsewhere, PART, PART;
    LIGHTING = "materials of scripts, and what is not a colour of them", Elsewhere, No, No;
    FRICTION = "friction of surfaces, the same of all", SETUP, SETUP, SETUP;
    CONTACTS = "other properties of contacts", Elsewhere, No, Elsewhere;
    INCLUDES = "included models", Elsewhere, Yes, Elsewhere;
    IN_WORLD = "the pose of the model in the world", Elsewhere, No, No;
    KEPT = "plugins, sensors and settings of Gazebo", Elsewhere, GAZEBO, Elsewhere;
    DETACHED_BODIES = "bodies that no joint holds, and other robots", Elsewhere, Elsewhere, No;
    ALONE = "shapes that belong to no body", Elsewhere, Elsewhere, No;
    MISSING_PARTS = "references that are not found, of prims without bodies and joints", Elsewhere, Elsewhere, No;
    DISTANCES = "joints that hold a distance, that are not active, or whose body is not there", Elsewhere, Elsewhere, No;
    OTHER_SHAPES = "curves, points and other shapes that are not solid", Elsewhere, Elsewhere, No;
    SAMPLES = "values by time, but the first", Elsewhere, Elsewhere, No;
}

/// As many remarks of one robot are kept.
const MOST_REMARKS: usize = 1000;
/// The characters of one that are kept.
const LONGEST_REMARK: usize = 1000;

/// Something that a person has to know of one robot: what was assumed, or what is left out beside the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    pub place: Place,
    /// What is said, and what became of it, as one sentence.
    pub text: String,
}

/// What became of what one description says.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    counts: BTreeMap<&'static str, usize>,
    /// Elements and attributes that are not read, with their number.
    unread: BTreeMap<String, usize>,
    /// What else a person has to know.
    pub remarks: Vec<Remark>,
}

impl Tally {
    pub fn count(&mut self, feature: Feature) {
        self.add(feature, 1);
    }

    pub fn add(&mut self, feature: Feature, number: usize) {
        *self.counts.entry(feature.name).or_default() += number;
    }

    /// Counts one, and says what was assumed, or left out.
    pub fn say(&mut self, feature: Feature, place: Place, text: impl AsRef<str>) {
        self.count(feature);
        self.remark(place, text);
    }

    /// Counts an element or attribute that is not read and is of meaning for the robot: it is lost.
    pub fn unread(&mut self, name: impl Into<String>) {
        *self.unread.entry(name.into()).or_default() += 1;
    }

    /// Says what was assumed, or left out. What is beyond the greatest number is counted.
    pub fn remark(&mut self, place: Place, text: impl AsRef<str>) {
        if self.remarks.len() == MOST_REMARKS {
            self.unread("what more remarks would say");
            return;
        }
        let text = text.as_ref().chars().take(LONGEST_REMARK).collect();
        self.remarks.push(Remark { place, text });
    }

    pub fn number_of(&self, feature: Feature) -> usize {
        self.counts.get(feature.name).copied().unwrap_or_default()
    }

    /// What is not read, with its number, by name.
    pub fn all_unread(&self) -> &BTreeMap<String, usize> {
        &self.unread
    }
}

/// What became of a description.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The name of the robot.
    pub robot: String,
    /// The format.
    pub format: Format,
    /// What it has: what, how many, and how it is carried.
    pub parts: Vec<Part>,
    /// What else a person has to know.
    pub remarks: Vec<Note>,
}

impl Report {
    /// The report on a description. `elsewhere` names the files that were read from outside of the description's folder.
    pub fn of(
        robot: &str,
        tally: &Tally,
        format: Format,
        positions: &Positions<'_>,
        elsewhere: &BTreeMap<PathBuf, String>,
    ) -> Self {
        let counted = ALL.iter().map(|feature| {
            let count = tally.number_of(*feature);
            (feature.name.to_owned(), count, how(*feature, format))
        });
        let mut parts: Vec<Part> =
            counted.filter(|(_, count, how)| *count > 0 && *how != How::Elsewhere).collect();
        let unread = tally.all_unread().iter();
        parts.extend(unread.map(|(name, count)| (name.clone(), *count, How::No)));
        let note = |remark: &Remark| {
            let (file, line, column) = positions.at(remark.place).unwrap_or_default();
            let place = SourcePlace { file: file.to_owned(), line, column };
            Note::at(place, NoteKind::Otherwise, &*remark.text, "")
        };
        let first = positions.at(Place::default()).map_or("", |(file, ..)| file);
        let outside = elsewhere.iter().map(|(path, why)| {
            let path = path.display();
            let problem = format!("{path} is outside of the description's folder and project");
            Note::of_file(first, NoteKind::Outside, problem, format!("read, {why}"))
        });
        let remarks = tally.remarks.iter().map(note).chain(outside).collect();
        Report { robot: robot.to_owned(), format, parts, remarks }
    }

    /// What is lost: what, and how many.
    pub fn lost(&self) -> impl Iterator<Item = (&str, usize)> {
        let lost = self.parts.iter().filter(|(_, _, how)| *how == How::No);
        lost.map(|(name, count, _)| (name.as_str(), *count))
    }

    /// What is carried in another way: what, how many, and how.
    pub fn otherwise(&self) -> impl Iterator<Item = (&str, usize, &'static str)> {
        self.parts.iter().filter_map(|(name, count, how)| match how {
            How::Otherwise(how) => Some((name.as_str(), *count, *how)),
            _ => None,
        })
    }

    /// All that is lost or carried otherwise, as notes; `file` is the description.
    pub fn notes(&self, file: &str) -> Vec<Note> {
        let note = |kind, (what, count, how): (&str, usize, &str)| {
            Note::of_file(file, kind, format!("{what} ({count})"), how)
        };
        let lost = self.lost().map(|(what, count)| (what, count, "lost; a URDF cannot say it"));
        let lost = lost.map(|part| note(NoteKind::Lost, part));
        let otherwise = self.otherwise().map(|part| note(NoteKind::Otherwise, part));
        lost.chain(otherwise).chain(self.remarks.iter().cloned()).collect()
    }

    /// As JSON, with the keys of the report of an export.
    #[must_use]
    pub fn to_json(&self) -> String {
        let notes: Vec<String> = self.remarks.iter().map(ToString::to_string).collect();
        carried::report(&self.robot, self.format.name(), &self.parts, &notes)
    }
}

fn how(feature: Feature, format: Format) -> How {
    match format {
        Format::Mjcf => feature.mjcf,
        Format::Sdf => feature.sdf,
        Format::Usd => feature.usd,
    }
}

/// The table of docs/import.md, in Markdown.
#[must_use]
pub fn imported_table() -> String {
    let formats = Format::ALL.map(Format::name);
    let row = |feature: &'static Feature| (feature.name, Format::ALL.map(|of| how(*feature, of)));
    table(&formats, ALL.iter().map(row))
}
