use crate::rules::prelude::*;
use urdd_document::legacy::SIMPLE_SKIPS_DEPENDENCIES;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let of_skips = "this was written in the draft format of urdd 0.1.0: run `urdd generate` again \
                    into this folder; edits of the skips are kept";
    let of_model = "this was written in the draft format of urdd 0.2.0: run `urdd generate` again \
                    into this folder, with `--modules all,self_collision_model`";
    let mut is_draft = |kind, key: &str, message: &str| {
        let module = context.module(kind).filter(|module| module.is_draft);
        if let Some(module) = module {
            let finding = finding_in(module, "", message).actual("no such key");
            findings.report(finding.expected(format!("key {key}")));
        }
        module.is_some()
    };
    is_draft(Kind::SelfCollisionModel, "evaluation", of_model);
    if is_draft(Kind::LinkShapesSkips, "skipped_reasons", of_skips) {
        return Some(());
    }
    let names = SIMPLE_SKIPS_DEPENDENCIES.map(Kind::name);
    let kind = Kind::LinkShapesSimpleSkips;
    for entry in entries::all(context) {
        let stated = entry.entry.depends_on.iter().map(String::as_str);
        if entry.kind == Some(kind) && stated.eq(names) {
            let all: Vec<&str> = kind.depends_on().iter().map(|kind| kind.name()).collect();
            let finding = finding_in(&entry, "depends_on", of_skips);
            findings.report(finding.values(all.join(", "), names.join(", ")));
            break;
        }
    }
    Some(())
}
