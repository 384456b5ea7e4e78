//! EXT: extension modules.

mod documents;
use crate::rule::rules;

rules! {
    documents
}
