//! What stands beside a URDF and says what it cannot: `NAME.srdf` (pairs that are not checked, named configurations,
//! groups) and `NAME.export.toml` (gains, the base, frictions). An import writes both.

use std::path::Path;

use urdd_directory::limits::{MAX_SETUP_BYTES, MAX_SRDF_BYTES};
use urdd_format::named_configurations::ConfigurationEdit;

use crate::gate::Gate;

/// The text of a file, or why it cannot be read.
pub type Companion = Result<String, String>;

/// What stands beside a URDF.
#[derive(Debug, Clone, Default)]
pub struct Beside {
    /// `NAME.srdf`, if it is there.
    pub srdf: Option<Companion>,
    /// `NAME.export.toml`, if it is there.
    pub setup: Option<Companion>,
    /// What only an import knows.
    pub import: Option<Carried>,
}

/// What an import carries in another way, and what it lost.
#[derive(Debug, Clone)]
pub struct Carried {
    /// The named configurations, which are in the SRDF too.
    pub configurations: Vec<ConfigurationEdit>,
    /// What is lost, and how many.
    pub lost: Vec<(String, usize)>,
}

impl Beside {
    /// Reads what stands beside a URDF.
    pub(super) fn read(urdf: &Path, gate: &Gate) -> Beside {
        let at = |ending: &str, limit| companion(&urdf.with_extension(ending), limit, gate);
        Beside {
            srdf: at("srdf", MAX_SRDF_BYTES),
            setup: at("export.toml", MAX_SETUP_BYTES),
            import: None,
        }
    }
}

/// The text of a file that is found by its name: no link leads out of the robot's folders. `None` if it is not there.
pub(super) fn companion(path: &Path, limit: u64, gate: &Gate) -> Option<Companion> {
    let found = match gate.at(path) {
        Ok(found) => found,
        Err(missing) => {
            let outside = missing.outside?;
            return Some(Err(format!(
                "it is {}, outside of the robot's folders",
                outside.display()
            )));
        }
    };
    let bytes = gate.bytes(&found, limit).map_err(|error| error.to_string());
    Some(bytes.and_then(text))
}

pub(super) fn text(bytes: Vec<u8>) -> Companion {
    String::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())
}
