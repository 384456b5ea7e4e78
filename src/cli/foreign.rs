//! Advice on files that are not URDDs.

use std::io::Read;
use std::path::Path;

use super::output::one_line;
use urdd_directory::discover::DiscoverError;
use urdd_directory::regular;

/// How much of a file is read to identify it, in bytes.
const HEAD: u64 = 4096;

/// The message of an error, with advice if the file has a known format.
pub fn advice(error: &DiscoverError) -> String {
    let DiscoverError::NotAFolder { path } = error else {
        return one_line(error);
    };
    format!("{}: {}", one_line(path), of_file(Path::new(path)).unwrap_or(NEITHER))
}

fn of_file(path: &Path) -> Option<&'static str> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let by_name = match extension.to_ascii_lowercase().as_str() {
        "xacro" => Some(
            "this is a xacro file; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd diff` compares it",
        ),
        "sdf" | "world" => Some(SDF),
        "srdf" => Some(
            "this is SRDF, which adds groups and skipped collisions to a URDF; \
             give the URDF that it belongs to, or a URDD",
        ),
        "mjcf" => Some(MJCF),
        "usd" | "usda" | "usdc" | "usdz" => Some(
            "this is USD; URDDs are generated from URDF: export one (Isaac Sim has a URDF exporter), then `urdd generate`",
        ),
        "json" | "yaml" | "yml" => Some(
            "a URDD is a folder, not a single file; give the folder that contains urdd.json and the module folders",
        ),
        _ => None,
    };
    by_name.or_else(|| by_content(path))
}

const NEITHER: &str = "this is a file, but neither a URDF (its name would end in .urdf) nor a URDD \
    (a folder that holds urdd.json or the module folders, or a zip archive of one)";
const SDF: &str = "this is SDF; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd import` makes a URDF";
const MJCF: &str = "this is MJCF, the format of MuJoCo; `urdd generate` makes a URDD of it, `urdd lint` checks it, \
    `urdd import` makes a URDF";

fn by_content(path: &Path) -> Option<&'static str> {
    let mut head = Vec::new();
    let file = regular::open(path).ok()?;
    file.take(HEAD).read_to_end(&mut head).ok()?;
    let head = String::from_utf8_lossy(&head);
    if head.contains("<mujoco") {
        Some(MJCF)
    } else if head.contains("<sdf") {
        Some(SDF)
    } else if head.contains("<robot") {
        Some(
            "this looks like a URDF; give it a name that ends in .urdf, or use `urdd generate` to generate a URDD from it",
        )
    } else {
        None
    }
}
