use crate::rules::prelude::*;
use urdd_directory::position::LineIndex;
use urdd_document::schema_check::excerpt;
use urdd_format::index::Count;
use urdd_format::report::{Fix, TextEdit};

declare_rule! {
    /// A mesh that the URDF names is not carried.
    ///
    /// The file was not found when the URDD was made. The link lacks this part of its geometry: it is
    /// not shown, and nothing collides with it. Most often a `package://` could not be resolved, or a
    /// file is missing from the package.
    ///
    /// Give the producer the folder of the package, or remove the element from the URDF. Then write the
    /// URDD again.
    SRC007 "mesh-not-carried", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), Module(Kind::OriginalMeshes), Version1, NotFailed(MSH012), ModuleV1(Kind::OriginalMeshes),
    ], check mesh_not_carried,

    /// The carried URDF repeats an element that URDF allows once.
    ///
    /// A URDD takes the first, as most readers do; others take the last, or refuse the file. So two
    /// programs may see two robots: another axis, another mass. Two shapes in one `<geometry>` are
    /// one shape and another that no program sees.
    ///
    /// Keep one of them in the URDF; write several shapes as several `<visual>` or `<collision>`
    /// elements. Then write the URDD again.
    SRC008 "repeated-element", Warning, clause "6.1.8", since "0.1.0",
    phase References, needs [CarriedUrdf, Passed(URD011)], of Robot, check repeated_element,
}

fn mesh_not_carried(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let meshes = document!(context, OriginalMeshes)?;
    let references = meshes.references.iter().enumerate();
    for (index, reference) in references.filter(|(_, reference)| reference.path.is_none()) {
        let link = robot.links.get(reference.link_idx.get()).map_or("", |link| &link.name);
        let filename = excerpt(&reference.filename.as_str().into());
        let message = format!("a mesh of link `{link}` was not found and is not carried");
        finding_in(Kind::OriginalMeshes, format!("/references/{index}/path"), message)
            .values("a file", format!("null for {filename} of link `{link}`"))
            .report(findings);
    }
    Some(())
}

fn repeated_element(described: &Described, findings: &mut Findings) -> Option<()> {
    let carried = described.urdf.ok()?;
    let reading = described.urdf_text()?;
    let lines = LineIndex::new(&carried.text);
    for again in &reading.repeated {
        let (start, end) = (lines.position(again.range.start), lines.position(again.range.end));
        let message = format!(
            "a second `<{}>` in a `<{}>`: only the first counts; remove one of them",
            again.element, again.parent
        );
        Finding::in_file(&carried.path, message)
            .position(Some(start))
            .related(
                Finding::in_file(&carried.path, "the first, which counts")
                    .position(Some(lines.position(again.first))),
            )
            // Other readers take the last: which of them the author means is his to say.
            .fix(Fix {
                message: format!("remove the second `<{}>`", again.element),
                is_safe: false,
                edits: vec![TextEdit {
                    file: carried.path.clone(),
                    line: Count(start.line),
                    column: Count(start.column),
                    end_line: Count(end.line),
                    end_column: Count(end.column),
                    text: String::new(),
                }],
            })
            .report(findings);
    }
    Some(())
}
