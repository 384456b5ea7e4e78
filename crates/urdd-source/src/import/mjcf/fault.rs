//! Why an MJCF is refused.

use thiserror::Error;

/// Why an MJCF is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum MjcfFault {
    #[error("the model has no `<worldbody>` with a body; there is no robot in it")]
    NoBody,
}
