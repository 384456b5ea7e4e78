//! What the report says of a URDF alone: what programs do with it, and what it was imported from.

use super::index::Count;
use super::types::types;

types! {
    /// What a program does with a URDF.
    pub struct ProgramResult {
        /// The program, as `--for` and `Does` name it: `mujoco`, `urdfdom6`.
        pub program: String,
        /// Its name for people.
        pub name: String,
        /// Its name whatever its version.
        pub family: String,
        /// The version that its reader was held to.
        pub version: String,
        /// Whether the settings name it.
        pub is_chosen: bool,
        /// The worst that it does; null where it reads all as it is written, but for what is usual.
        pub does: Option<Deed>,
        /// All that it does otherwise than the file says, in order of place.
        pub effects: Vec<ProgramEffect>,
        /// How many effects are not listed here, because there are too many.
        pub effects_cut: Count,
    }

    /// What a program does with a part of a URDF, or with the whole.
    pub enum Deed {
        /// It reads the part otherwise than the file says.
        Reads = "reads",
        /// It leaves the part out.
        Drops = "drops",
        /// It refuses the file.
        Refuses = "refuses",
        /// It crashes.
        Crashes = "crashes",
    }

    /// Something that a program does otherwise than the file says.
    pub struct ProgramEffect {
        /// What it does.
        pub does: Deed,
        /// Line in the file, from 1; null where it is no text.
        pub line: Option<Count>,
        /// Column in the line, in characters, from 1.
        pub column: Option<Count>,
        /// What is lost or read otherwise, such as `joint/elbow/limit`; null for the whole file.
        pub part: Option<String>,
        /// Why.
        pub reason: String,
        /// What the program makes of the part, where it reads it otherwise.
        pub makes: Option<String>,
        /// Whether the program does so with every robot, or because of another fault: nothing is wrong there.
        pub is_usual: bool,
        /// Whether the program refuses the file for something else before. It is so once that is mended.
        pub is_supposed: bool,
    }

    /// What a program does because of a finding.
    pub struct Does {
        /// The program.
        pub program: String,
        /// What it does.
        pub does: Deed,
        /// Whether the program refuses the file for something else before. It is so once that is mended.
        pub is_supposed: bool,
    }

    /// What an import made of a description that is no URDF.
    pub struct ImportedFrom {
        /// The format: `mjcf`, `sdf`.
        pub format: String,
        /// What the URDF has in another way.
        pub otherwise: Vec<ImportedPart>,
        /// What is lost.
        pub lost: Vec<ImportedPart>,
        /// What else was assumed or left out, each with its place.
        pub notes: Vec<String>,
    }

    /// Something that a description has.
    pub struct ImportedPart {
        /// What it is.
        pub what: String,
        /// How many there are.
        pub count: Count,
        /// How it is carried otherwise; null where it is lost.
        pub how: Option<String>,
    }
}
