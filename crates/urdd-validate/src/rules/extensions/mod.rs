//! EXT: extension modules.

mod document_invalid;
mod folders;
mod schema_unusable;

use crate::rule::rules;
use folders::extensions;

rules! {
    document_invalid, schema_unusable
}
