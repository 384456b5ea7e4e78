//! Why a description of another format is refused.

use std::path::PathBuf;

use thiserror::Error;
use urdd_directory::account::AccountError;
use urdd_directory::listing::ReadError;
use urdd_format::short::Short;
use urdd_source::NotFound;
use urdd_source::gate::ImageFault;

#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ImportFault {
    #[error("{0}")]
    NotXml(String),
    #[error(transparent)]
    File(#[from] Unreachable),
    #[error("`{attribute}` of `<{element}>` is `{value}`, which is not {wanted}")]
    Value { element: String, attribute: String, value: String, wanted: &'static str },
    #[error(transparent)]
    Account(#[from] AccountError),
    #[error(transparent)]
    Mjcf(#[from] MjcfFault),
    #[error(transparent)]
    Sdf(#[from] SdfFault),
    #[error(transparent)]
    Usd(#[from] UsdFault),
}

impl ImportFault {
    /// Of an image, under the name that the description has for it.
    pub fn of_image(file: &str, why: ImageFault) -> Self {
        match why {
            ImageFault::Unread(why) => Unreachable::unread(file, &why).into(),
            ImageFault::Account(why) => why.into(),
        }
    }
}

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Unreachable {
    #[error("`{0}` was not found")]
    Missing(String),
    #[error(
        "`{file}` is outside of the folders of the description; `--allow-folder {}` allows its folder", folder.display()
    )]
    Outside { file: String, folder: PathBuf },
    #[error("`{file}` cannot be read: {reason}")]
    Unreadable { file: String, reason: String },
    #[error("`{file}` cannot be read as a mesh: {reason}")]
    NotMesh { file: String, reason: String },
    #[error("`{file}` is not an image")]
    NotImage { file: String },
    #[error("`{file}` has no part `{part}`")]
    NoPart { file: String, part: String },
}

impl Unreachable {
    /// Of a file that was not found, under the name that the description has for it.
    pub fn of(file: &str, why: NotFound) -> Self {
        match why.outside {
            Some(outside) => {
                let folder = outside.parent().unwrap_or(&outside).to_owned();
                Unreachable::Outside { file: file.to_owned(), folder }
            }
            None => Unreachable::Missing(file.to_owned()),
        }
    }

    /// Of a file that was found, and not read.
    pub fn unread(file: &str, why: &ReadError) -> Self {
        Unreachable::Unreadable { file: file.to_owned(), reason: why.to_string() }
    }
}

#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MjcfFault {
    #[error("the model has no `<worldbody>` with a body; there is no robot in it")]
    NoBody,
    #[error(
        "the bodies of the model are those of `<flexcomp>` or `<composite>`, which are soft; a URDF has rigid ones, so there is no robot in it"
    )]
    SoftBodies,
    #[error(
        "the model has no body `{0}`; `--body` names a body of the file, or `world` for all of it"
    )]
    UnknownBody(String),
    #[error("`<include>` needs the attribute `file`, and no children")]
    Include,
    #[error(
        "`{0}` is already included; MuJoCo includes each file once, so remove this `<include>`"
    )]
    IncludedTwice(String),
    #[error("elements are nested more than {0} deep, with what is included; flatten the model")]
    TooDeep(usize),
    #[error(
        "more than {0} models are attached in each other, or one to itself; remove one of the `<attach>`"
    )]
    DeepModels(usize),
    #[error("there are more than {0} outermost `<default>`; merge them")]
    TooManyDefaults(usize),
    #[error("`<default>`s are nested more than {0} deep; flatten the classes")]
    DeepDefaults(usize),
    #[error("`<{0}>` stands twice in one `<default>`; keep one of them")]
    DefaultTwice(String),
    #[error("`<default>` inside `<default>` needs the attribute `class`")]
    DefaultWithoutClass,
    #[error("the outermost `<default>` is the class `main`, and cannot be named `{0}`")]
    MainRenamed(String),
    #[error("the default class `{0}` is defined twice; rename one of them")]
    ClassTwice(String),
    #[error(
        "the default class `{0}` is not defined; define it in `<default>`, or correct its name"
    )]
    UnknownClass(String),
    #[error(
        "`coordinate=\"global\"` is of MuJoCo 2.3.3 and older; load and save the model in MuJoCo 2.3.3 first"
    )]
    GlobalCoordinates,
    #[error(
        "`<{element}>` says its orientation twice; keep one of quat, axisangle, xyaxes, zaxis, euler"
    )]
    TwoOrientations { element: String },
    #[error("`<{element}>` needs the attribute `{attribute}`")]
    Missing { element: String, attribute: &'static str },
    #[error(
        "`<{element}>` has a range but not `{attribute}`, and `<compiler autolimits=\"false\">`; write `{attribute}=\"true\"` or \"false\""
    )]
    NoLimited { element: String, attribute: &'static str },
    #[error("`{attribute}` of `<{element}>` must rise: its first number is not below its second")]
    Range { element: String, attribute: &'static str },
    #[error(
        "`range` of a ball has 0 and its greatest angle; MuJoCo refuses another first number where the ball is limited"
    )]
    BallRange,
    #[error("size {0} of `<geom>` must be positive")]
    Size(usize),
    #[error(
        "`fromto` of `<geom>` is for capsules, cylinders, boxes and ellipsoids without a mesh, and with two points that differ"
    )]
    FromTo,
    #[error("`<geom>` names the mesh `{0}`, which `<asset>` does not define")]
    UnknownMesh(String),
    #[error("`<geom type=\"mesh\">` needs the attribute `mesh`")]
    NoMesh,
    #[error("the mesh `{name}` {problem}")]
    Mesh { name: String, problem: String },
    #[error("`<geom>` names the material `{0}`, which `<asset>` does not define")]
    UnknownMaterial(String),
    #[error("the material names the texture `{0}`, which `<asset>` does not define")]
    UnknownTexture(String),
    #[error("`<{0}>` cannot be in the world; put it into a `<body>`")]
    InWorld(String),
    #[error(
        "a body turns after a ball joint, or has more than 6 degrees of freedom, or a free joint beside others or below another body; split it into several"
    )]
    Joints,
    #[error("two {what} are named `{name}`; rename one of them")]
    SameName { what: &'static str, name: String },
    #[error("mass and inertia must not be negative")]
    NegativeMass,
    #[error(
        "the principal moments of inertia {0} break A + B ≥ C; `<compiler balanceinertia=\"true\">` makes them equal"
    )]
    Unbalanced(String),
    #[error("`fullinertia` has a principal moment that is not positive; MuJoCo refuses it")]
    FullInertia,
    #[error(
        "`<inertial>` says its inertia twice; keep `fullinertia`, or `diaginertia` with an orientation"
    )]
    TwoInertias,
    #[error(
        "`<{0}>` is not supported; save the compiled model (`mujoco.mj_saveLastXML`), which has its bodies written out, and import that"
    )]
    Unsupported(String),
    #[error("`<{element}>` names the {what} `{name}`, which the model does not have")]
    Unknown { element: String, what: &'static str, name: Short },
    #[error("`qpos` of the key has {found} numbers, but the model has {expected} positions")]
    Qpos { found: usize, expected: usize },
}

#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SdfFault {
    #[error("the file has no `<model>`; there is no robot in it")]
    NoModel,
    #[error("the world has {}; name one with `--model NAME`", listed(.0))]
    Models(Vec<String>),
    #[error("there is no model `{wanted}`; the file has {}", listed(.there))]
    OtherModels { wanted: String, there: Vec<String> },
    #[error("`<{0}>` is not `<sdf>`; give an SDF")]
    Root(String),
    #[error("`<sdf>` of version `{0}` is not read; 1.2 to 1.12 are: let `gz sdf -p` convert it")]
    Version(String),
    #[error("`<{0}>` has no name; give it one")]
    NoName(String),
    #[error("two {kind}s of a model have the name `{name}`; rename one")]
    Twice { kind: &'static str, name: String },
    #[error("`{element}` names `{name}`, which is no link, joint, frame or model of `{model}`")]
    Unknown { element: String, name: String, model: String },
    #[error("the frame of `{0}` refers to itself, through others; break the circle")]
    Circle(String),
    #[error("`<{element}>` has no `<{child}>`; add it")]
    Missing { element: String, child: &'static str },
    #[error(
        "joint `{joint}`: `{kind}` is not a type of joint; write `revolute`, `fixed` or another of SDF's types"
    )]
    JointType { joint: String, kind: String },
    #[error("joint `{0}`: the axis has no length; write a direction such as `0 0 1`")]
    ZeroAxis(String),
    #[error("joint `{0}`: its child is the world; make the world its parent")]
    WorldChild(String),
    #[error("link `{0}`: `world` is the name of the world; rename the link")]
    WorldLink(String),
    #[error("model `{0}` has no link; there is no robot in it")]
    NoLink(String),
    #[error(
        "`<include>` has `<experimental:params>`, which is not read; write the included model out"
    )]
    Params,
    #[error("`{uri}` was not found: {why}")]
    NoInclude { uri: String, why: String },
    #[error("`{0}` includes itself, through others; break the circle")]
    IncludeCircle(String),
    #[error("`{0}` has no `<model>`; include a model")]
    IncludesNone(String),
    #[error("`{0}` is a URDF, which an SDF includes; convert it first: `gz sdf -p`")]
    IncludesUrdf(String),
    #[error("models are nested more than {0} deep; a robot has fewer")]
    Deep(usize),
}

/// The number of models, and their first names.
fn listed(names: &[String]) -> String {
    const MOST: usize = 10;
    let first: Vec<String> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > MOST { ", …" } else { "" };
    match names.len() {
        0 => "no models".to_owned(),
        1 => format!("one model: {}", first.concat()),
        count => format!("{count} models: {}{more}", first.join(", ")),
    }
}

#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum UsdFault {
    /// Of a layer, with its place.
    #[error("{0}")]
    Layer(String),
    #[error("no prim has `PhysicsRigidBodyAPI`; there is no robot in it")]
    NoBody,
    #[error("there is no body `{0}`; `--body` takes the name or the path of one")]
    NoSuchBody(String),
    #[error("`metersPerUnit` and `kilogramsPerUnit` have to be above 0")]
    Units,
    #[error("`{0}` is scaled by 0 or by what is not a number")]
    Scale(String),
}
