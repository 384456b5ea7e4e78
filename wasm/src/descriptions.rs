//! The descriptions among files.

use serde_json::{Value, json};
use urdd_source::dropped::{Dropped, descriptions};

use crate::answer;
use crate::around::Given;
use crate::files::Files;

/// The descriptions among these files: `path`, `name` and `format` (`urdf`, `xacro`, `mjcf`, `sdf`) of each.
///
/// # Safety
/// `files` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_descriptions(files: *mut Files) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let files = unsafe { &*files };
    answer::result(Given::of(files).map(|given| {
        let one = |Dropped { job, kind }: &Dropped| {
            json!({ "path": given.path(&job.source), "name": job.name, "format": kind.name() })
        };
        Value::from(descriptions(given.files()).iter().map(one).collect::<Vec<_>>())
    }))
}
