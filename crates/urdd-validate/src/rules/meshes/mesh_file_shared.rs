use crate::rules::prelude::*;
use crate::views::shared_meshes;

declare_rule! {
    /// Two entries of a mesh module name the same file, which can be right for one of them only.
    ///
    /// A derived mesh is in its link's own frame: the origin and scale of the link's geometry are
    /// applied. When two links are given one file, the mesh of the second overwrote that of the first,
    /// and hulls, pieces, boxes and distances of the first were then made from the wrong shape.
    ///
    /// Name derived files by link (SPEC 7.3), and write the mesh and link shape modules again. In
    /// legacy modules, links that place the very same mesh at the very same origin and scale may
    /// share a file: then it is right for both (LEG007).
    MSH005 "mesh-file-shared", Error, clause "7.3", since "0.1.0",
    phase References, needs [
        Module(Kind::Urdf), DERIVED_MESHES, NotFailed(MSH001), NotFailed(MSH003), NotFailedInV1(MSH007),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for shared in shared_meshes::all(context) {
        if shared.alike {
            continue;
        }
        let ((first, first_pointer), (link, pointer)) = (shared.first, shared.other);
        let label = context.link_label(link);
        let message = match first == link {
            true => format!("{label} names one file twice"),
            false => format!(
                "{} and {label} name the same file, which can be right for only one of them: write one for each link",
                context.link_label(first)
            ),
        };
        let file = format!("{}/module.json", shared.kind.folder());
        let mut finding = Finding::at(file, pointer, message)
            .values("a file of its own", format!("`{}` (also {first_pointer})", shared.path));
        finding.parts = shared.parts;
        findings.report(finding);
    }
    Some(())
}
