//! Names of ROS packages and of files in them.

use std::path::Path;

use urdd_robot::Robot;

/// The name of a package in a folder. Whether ROS takes it, the export says.
pub(super) fn of_folder(folder: &Path) -> String {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    name.to_lowercase().replace(['-', ' ', '.'], "_")
}

/// The name of the URDF from which a URDD was made.
pub(super) fn urdf(robot: &Robot) -> Result<String, String> {
    let source = robot.source().map_err(|error| error.to_string())?;
    let path = source.map(|source| source.path);
    let name = path.as_deref().and_then(|path| path.rsplit('/').next());
    Ok(name.unwrap_or("robot.urdf").to_owned())
}
