//! What a report says of what was not examined.

use super::index::Count;
use super::types::types;

types! {
    /// Why a URDD or URDF was not examined.
    pub struct NotExamined {
        /// What kind of reason it is.
        pub cause: Cause,
        /// Why, and what to do.
        pub reason: String,
        /// Whether a person names or declares it, so that the run fails. A xacro file that was found in a folder and needs
        /// arguments is not asked for.
        pub is_asked_for: bool,
        /// The file with the reason, as seen from the folder of what was to be examined, with forward slashes; null where it
        /// is not known.
        pub file: Option<String>,
        /// Line in the file, from 1.
        pub line: Option<Count>,
        /// Column in the line, in characters, from 1.
        pub column: Option<Count>,
    }

    /// What keeps a URDD or URDF from being examined.
    pub enum Cause {
        /// It cannot be read.
        Unreadable = "unreadable",
        /// It is a xacro file that needs arguments, or does not take one that is declared of it.
        Arguments = "arguments",
        /// It takes more time or memory than it may.
        Limit = "limit",
        /// The program crashed: a bug in it.
        Crash = "crash",
        /// No rule that was selected could look at it.
        NoRule = "no-rule",
    }
}
