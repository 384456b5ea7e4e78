use crate::rules::prelude::*;

declare_rule! {
    /// The ids of a composed robot's parts do not tell them apart.
    ///
    /// A link of a part is named `id/link`: with two parts of one id, or a slash in an id, nobody knows
    /// which link is meant.
    ///
    /// Give each part an id of its own, without `/`.
    CMP002 "composition-part-ids", Error, clause "6.6.2", since "0.2.0",
    phase References, needs [Version1, Module(Kind::Composition), ROBOT_SOUND],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let composition = document!(context, Composition)?;
    let parts = &composition.parts;
    for (place, part) in parts.iter().enumerate() {
        let is_taken = parts[..place].iter().any(|before| before.id == part.id);
        let message = match () {
            () if part.id.is_empty() => "the id is empty",
            () if part.id.contains('/') => "the id contains a `/`",
            () if is_taken => "another part has this id",
            () => continue,
        };
        finding_in(Kind::Composition, format!("/parts/{place}/id"), message)
            .actual(format!("`{}`", part.id))
            .report(findings);
    }
    Some(())
}
