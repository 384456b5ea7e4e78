//! Why a USD is refused.

use thiserror::Error;

/// Why a USD is refused.
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
