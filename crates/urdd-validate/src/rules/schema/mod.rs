//! SCH: documents against their schemas.

mod breaks_schema;

use crate::rule::rules;

rules! {
    breaks_schema
}
