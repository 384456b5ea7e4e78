//! Why an SDF is refused.

use thiserror::Error;

/// Why an SDF is refused.
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
