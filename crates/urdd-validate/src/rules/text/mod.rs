//! JSN, YML and SCH: documents as text, in JSON and in the YAML beside it, and against their schemas.

mod faults;

use crate::rule::rules;

rules! {
    faults
}
