//! Progress of a long job, which the host is told of while it runs.

use serde_json::json;
use urdd_format::registry::ModuleKind;
use urdd_generate::Progress;

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "urdd")]
unsafe extern "C" {
    /// Tells the host of progress: JSON with `what`, `done` and `of`.
    fn progress(text: *const u8, length: usize);
}

/// Tells the host.
pub struct Told;

impl Told {
    fn tell(what: &str, done: usize, of: usize) {
        let text = json!({ "what": what, "done": done, "of": of }).to_string();
        #[cfg(target_arch = "wasm32")]
        // SAFETY: the host only reads the bytes, and does so before it returns.
        unsafe {
            progress(text.as_ptr(), text.len());
        }
        #[cfg(not(target_arch = "wasm32"))]
        drop(text);
    }
}

impl Progress for Told {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        Told::tell(kind.name(), done, total);
    }

    fn part(&self, kind: ModuleKind, done: usize, total: usize) {
        Told::tell(&format!("{}: step", kind.name()), done, total);
    }
}
