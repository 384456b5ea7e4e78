//! Why an SDF is refused.

use thiserror::Error;

/// Why an SDF is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum SdfFault {
    #[error("the file has no `<model>`; there is no robot in it")]
    NoModel,
}
