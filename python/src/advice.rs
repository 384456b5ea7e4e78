//! Error messages for Python. Replaces advice for the command line, selected by the error and never by its text.

use urdd_directory::staging::StagingError;
use urdd_export::ExportError;
use urdd_format::escape::line;
use urdd_generate::combine::{CombineError, PartFault};
use urdd_generate::fault::Fault;
use urdd_generate::{EditsFault, GenerateError, SourceError};
use urdd_robot::RobotError;

/// The pointer to a full report.
pub const SAYS_MORE: &str = "urdd.validate(path) says more";

/// Maximum number of lines of a list in a message; an error's `places` has all.
const MAX_SHOWN: usize = 5;

/// The message of an error of a robot query.
pub fn of_robot(error: &RobotError) -> String {
    match error {
        RobotError::Missing(module) => {
            let name = module.name();
            let short = name.strip_suffix("_module").unwrap_or(name);
            format!(
                "{name} is missing: generate it with urdd.generate(urdf, folder, modules=[\"{short}\"])"
            )
        }
        RobotError::Unusable { module, reason } => {
            format!("{}: {reason}: {SAYS_MORE}", module.name())
        }
        RobotError::MotionOpen => {
            format!("the modules do not define how the joints move: {SAYS_MORE}")
        }
        error => error.to_string(),
    }
}

/// The message of a generation error.
pub fn of_generate(error: &GenerateError) -> String {
    match error {
        GenerateError::Source(SourceError::Refused { file, faults }) => {
            let each = faults.iter().map(|placed| {
                let fault = of_fault(&placed.fault);
                format!("{}: {}", placed.place(file), line(&fault))
            });
            shown(each)
        }
        GenerateError::Outside { file, meshes } => {
            let file = line(file);
            let each = meshes.iter().map(|mesh| {
                let (name, path) = (line(&mesh.name), mesh.path.display().to_string());
                let words = "is outside of the folders of the robot and its packages, at";
                format!("{}: mesh `{name}` {words} {}", mesh.place, line(&path))
            });
            let words = "a URDD includes its meshes, and a URDF must not make you publish other files; if these are \
                intended, pass their folder: allowed_folders=[folder], or packages={name: folder}";
            format!("{}\n{file}: {words}", shown(each))
        }
        GenerateError::Strict { notes } => {
            let words =
                "nothing was written: strict=True rejects assumptions that change the robot";
            format!("{}\n{words}", shown(notes.iter().map(ToString::to_string)))
        }
        GenerateError::Edits { file, at, lost, fault } => {
            let at = at.map_or_else(String::new, |at| format!(":{at}"));
            let words = format!(
                "a new run would lose the user's {lost}. Correct the file, or discard all its edits: drop_edits=True"
            );
            format!("{}{at}: {}; {words}", file.display(), of_edits(fault))
        }
        GenerateError::Geometry { file, reason } => {
            format!("{file}: {reason}; fix the mesh, or omit the distances: modules=[\"geometry\"]")
        }
        GenerateError::Write(StagingError::Occupied { path }) => format!(
            "{}: this folder is not empty, and not a URDD of urdd.generate; choose another one, or force=True to \
             write there (files with other names stay)",
            path.display()
        ),
        error => error.to_string(),
    }
}

/// The message of a combination error.
pub fn of_combine(error: &CombineError) -> String {
    match error {
        CombineError::Generate { id, error } => {
            let part = id.as_ref().map(|id| format!("part `{}`: ", line(id)));
            format!("{}{}", part.unwrap_or_default(), of_generate(error))
        }
        CombineError::Part { id, source_path, fault: PartFault::Fails { codes } } => {
            let part = match id.is_empty() {
                true => String::new(),
                false => format!("part `{}`: ", line(id)),
            };
            format!(
                "{part}{}: it does not pass urdd.validate: {}; correct it, or accept it: force=True",
                line(source_path),
                codes.join(", ")
            )
        }
        error => error.to_string(),
    }
}

/// The message of an export error.
pub fn of_export(error: &ExportError) -> String {
    match error {
        ExportError::NoTree => {
            format!("the joints do not form a tree with one root: {SAYS_MORE}")
        }
        error => error.to_string(),
    }
}

/// The message of a fault in a source.
pub fn of_fault(fault: &Fault) -> String {
    let leave_out = "omit the modules that need meshes: modules=[\"core\"]";
    match fault {
        Fault::TooManyTriangles { link, found, limit } => format!(
            "the shapes of link `{link}` have {found} triangles, and the limit for a link is {limit}; make its \
             meshes coarser, or {leave_out}"
        ),
        Fault::TooManyTrianglesInAll { limit } => format!(
            "the shapes of all links have more than {limit} triangles, which is the limit; make the meshes coarser, \
             or {leave_out}"
        ),
        Fault::Unresolved { link } => format!(
            "link `{link}`: its shape is too thin, or too far from the link's frame, for the 32-bit numbers of mesh \
             files; check its units and origin, or {leave_out}"
        ),
        fault => fault.to_string(),
    }
}

/// The message of a fault that would lose edits.
pub fn of_edits(fault: &EditsFault) -> String {
    match fault {
        EditsFault::NotAskedFor(count) => format!(
            "it has {count} edit{}, and the requested modules omit link_shapes_skips_module; add \
             \"link_shapes_skips\" to modules",
            if *count == 1 { "" } else { "s" }
        ),
        fault => fault.to_string(),
    }
}

/// The first lines, and the number of further ones.
fn shown(lines: impl ExactSizeIterator<Item = String>) -> String {
    let more = lines.len().saturating_sub(MAX_SHOWN);
    let mut lines: Vec<String> = lines.take(MAX_SHOWN).collect();
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    lines.join("\n")
}
