//! Mutations of documents: one value of one field each.

use super::dice::Dice;
use super::field::Field;
use super::free;
use super::mutation::{Change, Description, Mutation, Target};
use super::original::{Document, Original};
use super::plan::Plan;
use super::pointer;
use super::sample;
use super::schema;
use super::value_changes;

/// For this many mutations of both files, there is one of the JSON file alone and one of the mirror alone.
const ALONE: usize = 4;

/// Mutations of all documents, one list per field and target.
pub(crate) fn mutations(original: &Original, plan: &Plan) -> Vec<Vec<Mutation>> {
    let mut lists = Vec::new();
    for document in &original.documents {
        for (field, places) in pointer::fields(&document.value) {
            if free::is_free(&document.name, &field) {
                continue;
            }
            let field = Field {
                original,
                document,
                field: &field,
                places: &places,
                schema: schema::of_field(&document.schema, &field),
            };
            lists.push(of_field(&field, plan, Target::Document));
            if document.mirror.is_some() {
                let fewer = Plan {
                    per_field: plan.per_field.map(|most| most.div_ceil(ALONE)),
                    ..plan.clone()
                };
                lists.push(of_field(&field, &fewer, Target::JsonAlone));
                lists.push(of_field(&field, &fewer, Target::YamlAlone));
            }
        }
    }
    lists
}

fn of_field(field: &Field, plan: &Plan, target: Target) -> Vec<Mutation> {
    let Document { name, file, .. } = field.document;
    let seed = format!("{name} {} {}", field.field, target.as_str());
    let mut dice = Dice::new(plan.seed, &seed);
    let file = match (target, &field.document.mirror) {
        (Target::YamlAlone, Some(mirror)) => mirror,
        _ => file,
    };
    sample::draw(plan, field.places.len(), &mut dice, |index, dice| {
        let place = &field.places[index];
        let changes = value_changes::changes(field, place, dice).into_iter();
        changes
            .map(|change| Mutation {
                description: Description {
                    module: name.clone(),
                    file: file.clone(),
                    field: field.field.to_owned(),
                    pointer: Some(place.clone()),
                    target,
                    kind: change.kind,
                    from: String::new(),
                    to: String::new(),
                },
                change: Change::Document(change.edits),
            })
            .collect()
    })
}
