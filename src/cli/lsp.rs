//! `urdd lsp`.

use std::process::ExitCode;

use clap::Args;

use super::output;

/// Arguments of `urdd lsp`.
#[derive(Args)]
#[command(
    after_help = "Editors start it: see docs/editors.md. It speaks the Language Server Protocol on standard input and \
    output, and ends with the editor.\n\n\
    Exit status: 0 the editor ended it; 1 the editor went away; 2 a message could not be read or written."
)]
pub struct LspArguments {
    /// Accepted because some editors pass it: there is no other way to connect.
    #[arg(long, hide = true)]
    stdio: bool,
}

/// Exit status: the editor went away.
const LEFT: u8 = 1;

/// Runs `urdd lsp`.
pub fn run(_: &LspArguments) -> ExitCode {
    match urdd_lsp::serve_stdio() {
        Ok(ended) if ended.is_orderly() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::from(LEFT),
        Err(error) => {
            output::error(&output::one_line(error));
            ExitCode::from(output::USAGE)
        }
    }
}
