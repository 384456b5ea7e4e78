//! Documents of a URDD: `urdd.json`, and `module.json` and `module.yaml` of each module, by their schemas.

mod check;
mod hover;
#[doc(hidden)]
pub use check::check;
pub use hover::hover;
