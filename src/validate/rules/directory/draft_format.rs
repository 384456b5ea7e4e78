use crate::directory::discover::ROOT_METADATA;
use crate::document::draft::SIMPLE_SKIPS_DEPENDENCIES;
use crate::document::entries;
use crate::format::registry::ModuleKind;
use crate::validate::context::Context;
use crate::validate::finding::{Finding, Findings};
use crate::validate::rule::declare_rule;

declare_rule! {
    /// The URDD follows the draft of the format that `urdd` 0.1.0 wrote.
    ///
    /// In the draft, `link_shapes_skips_module` had no `skipped_reasons`, and the reasons of pairs did
    /// not know `Default`. A program that checks collisions by such a URDD finds neighbouring links of
    /// a robot at rest in collision. What depends on these two modules is not checked.
    ///
    /// Run `urdd generate` again into the same folder: it writes the present format, keeps your edits of
    /// the skips, and makes again only what has changed.
    DIR030 "draft-format", Error, clause "4.4", since "0.2.0",
    phase Files, needs [Version1],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let message = "this was written in the draft format of urdd 0.1.0: run `urdd generate` again \
                   into this folder; edits of the skips are kept";
    let skips = context.module(ModuleKind::LinkShapesSkips);
    if let Some(module) = skips.filter(|module| module.is_draft) {
        findings.report(
            Finding::at(module.file("module.json"), "", message)
                .expected("key skipped_reasons")
                .actual("no such key"),
        );
        return;
    }
    let names = SIMPLE_SKIPS_DEPENDENCIES.map(ModuleKind::name);
    for entry in entries::all(context) {
        let stated = entry.entry.depends_on.iter().map(String::as_str);
        if entry.kind == Some(ModuleKind::LinkShapesSimpleSkips) && stated.eq(names) {
            let all = ModuleKind::LinkShapesSimpleSkips.depends_on().iter();
            let all: Vec<&str> = all.map(|kind| kind.name()).collect();
            findings.report(
                Finding::at(ROOT_METADATA, entry.pointer("depends_on"), message)
                    .expected(all.join(", "))
                    .actual(names.join(", ")),
            );
            return;
        }
    }
}
