//! EXT: extension modules.

mod annotated;
mod document_invalid;
mod extension_index_out_of_range;
mod extension_length_differs;
mod folders;
mod schema_unusable;

use crate::rule::rules;
use folders::{MAX_PLACES, described, extensions};

rules! {
    document_invalid, extension_index_out_of_range, extension_length_differs, schema_unusable,
}
