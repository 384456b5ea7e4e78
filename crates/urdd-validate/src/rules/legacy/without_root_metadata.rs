use crate::rules::prelude::*;

declare_rule! {
    /// The URDD is from before version 1, and has no `urdd.json`.
    ///
    /// That was usual then. Nothing says what the URDD was made from, which of its files
    /// belong together, or whether one was changed; it is checked by the rules that apply to it.
    ///
    /// Nothing needs to be done. For a URDD of version 1, write it again from its URDF.
    LEG001 "legacy-without-root-metadata", Info, clause "10.2", since "0.1.0",
    phase Files, needs [Legacy],
}

fn check(_: &Context, findings: &mut Findings) -> Option<()> {
    let message = "this URDD is from before version 1: it has no urdd.json, and is checked by the rules for that format";
    Finding::in_directory(message).report(findings);
    Some(())
}
