use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::draft::SIMPLE_SKIPS_DEPENDENCIES;
use urdd_document::entries;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// The URDD follows a draft of the format, which `urdd` 0.1.0 or 0.2.0 wrote.
    ///
    /// In the draft of 0.1.0, `link_shapes_skips_module` had no `skipped_reasons`, and the reasons of pairs did
    /// not know `Default`. A program that checks collisions by such a URDD finds neighbouring links of
    /// a robot at rest in collision. In the draft of 0.2.0, `self_collision_model_module` had counts of configurations
    /// that its producer chose (`held_out`), so that its rates could flatter it. What depends on these modules is not
    /// checked.
    ///
    /// Run `urdd generate` again into the same folder, with the same `--modules`: it writes the present format, keeps
    /// your edits of the skips, and makes again only what has changed.
    DIR030 "draft-format", Error, clause "4.4", since "0.2.0",
    phase Files, needs [Version1],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let message = "this was written in the draft format of urdd 0.1.0: run `urdd generate` again \
                   into this folder; edits of the skips are kept";
    let of_model = "this was written in the draft format of urdd 0.2.0: run `urdd generate` again \
                    into this folder, with `--modules all,self_collision_model`";
    for (kind, message, key) in [
        (ModuleKind::SelfCollisionModel, of_model, "evaluation"),
        (ModuleKind::LinkShapesSkips, message, "skipped_reasons"),
    ] {
        if let Some(module) = context.module(kind).filter(|module| module.is_draft) {
            findings.report(
                Finding::at(module.file("module.json"), "", message)
                    .expected(format!("key {key}"))
                    .actual("no such key"),
            );
        }
    }
    let skips = context.module(ModuleKind::LinkShapesSkips);
    if skips.is_some_and(|module| module.is_draft) {
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
