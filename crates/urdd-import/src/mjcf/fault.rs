//! Why an MJCF is refused.

use thiserror::Error;
use urdd_format::short::Short;

/// Why an MJCF is refused.
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
