//! Programs by the names that settings have for them.

use thiserror::Error;

use urdd_programs::Program;

/// A name that no program has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no program `{name}`; write some of {}", all())]
pub struct UnknownProgram {
    /// The name.
    pub name: String,
}

fn all() -> String {
    let names = Program::ALL.iter().flat_map(|program| program.settings());
    names.collect::<Vec<_>>().join(", ")
}

/// The programs of these names: `ros`, `humble`, `mujoco`.
///
/// # Errors
/// If there is none of a name.
pub fn named_programs(names: &[String]) -> Result<Vec<Program>, UnknownProgram> {
    let mut programs = Vec::new();
    for name in names {
        let unknown = || UnknownProgram { name: name.clone() };
        let program = Program::of_name(&name.trim().to_lowercase()).ok_or_else(unknown)?;
        if !programs.contains(&program) {
            programs.push(program);
        }
    }
    Ok(programs)
}
