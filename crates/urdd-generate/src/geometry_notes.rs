//! Which elements the shapes of links are made of, where that is not what a person may expect.

use super::context::Context;
use super::error::first_names;
use urdd_format::meshes::GeometryKind;
use urdd_format::plain_meshes::PlainMeshesModule;
use urdd_format::short::Short;
use urdd_source::note::{Note, NoteKind};

/// Notes about the links that collide by their visual elements, and about a robot in which nothing can collide.
pub(super) fn notes(context: &Context, plain: &PlainMeshesModule) -> Vec<Note> {
    let links = &context.source.reading.robot.links;
    let note = |problem: String, assumed: &str| {
        vec![context.note(NoteKind::GeometryTaken, problem, assumed)]
    };
    if plain.link_meshes.iter().all(Option::is_none) {
        // A single link has no pair, whatever it is made of.
        if links.len() < 2 {
            return Vec::new();
        }
        let problem = "no link has a visual or collision element with a surface";
        return note(problem.to_owned(), "nothing can collide: there is no pair to check");
    }
    let is_visual = |link: usize| {
        let mesh = plain.link_meshes.get(link).and_then(Option::as_ref);
        mesh.is_some_and(|mesh| mesh.geometry == GeometryKind::Visual)
    };
    let taken = |collides: bool| {
        let all = links.iter().enumerate();
        let those =
            all.filter(|(at, link)| is_visual(*at) && link.collision.is_empty() != collides);
        those.map(|(_, link)| link.name.as_str()).collect::<Vec<_>>()
    };
    let (instead, only) = (taken(true), taken(false));
    let mut notes = Vec::new();
    if links.iter().all(|link| link.collision.is_empty()) {
        let problem = "no link has a collision element".to_owned();
        let assumed =
            format!("the collision shapes of {} are made of visual elements", listed(&only));
        notes.extend(note(problem, &assumed));
    } else if !only.is_empty() {
        let problem = format!("{} {} no collision element", listed(&only), has(&only));
        notes.extend(note(problem, "collision shapes are made of visual elements there"));
    }
    if !instead.is_empty() {
        let problem =
            format!("{} {} visual and collision elements", listed(&instead), has(&instead));
        let assumed = match plain.preferred_geometry {
            GeometryKind::Visual => {
                "collision shapes are made of the visual elements; `--geometry collision` takes the collision elements"
            }
            GeometryKind::Collision => {
                "collision shapes are made of the visual elements, since the collision elements cannot be used"
            }
        };
        notes.extend(note(problem, assumed));
    }
    notes
}

fn has(names: &[&str]) -> &'static str {
    if names.len() == 1 { "has" } else { "have" }
}

/// The number of these links and the names of the first.
fn listed(names: &[&str]) -> String {
    let links = if names.len() == 1 { "link" } else { "links" };
    let shown = first_names(names.iter().map(|name| Short::of(name)));
    format!("{} {links} ({shown})", names.len())
}
