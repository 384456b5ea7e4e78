//! Spheres as sentences and as JSON, in files and notes: what is said of them, Foam's format (`mean`, `best`, `worst`, `spheres`)
//! with additional metadata, and a URDF of them.

use serde_json::{Map, Value, json};

use super::{Level, Measured, Model, Point};
use crate::subject::by_link;
use crate::{Export, ExportError, Note, Subject, urdf};
use urdd_format::escape;
use urdd_format::rate::interval;
use urdd_robot::{LinkShape, Solid};
use urdd_spheres::fitted::Numbers;
use urdd_spheres::judge::{MAX_FALSE, MAX_MISSED, SphereRates};
use urdd_spheres::model::{Sphere, distance};

const NAMED: usize = 10;

/// Distance between the surface of a link and that of its spheres, in metres.
pub(super) struct Stand {
    pub mean: f64,
    pub best: f64,
    pub worst: f64,
    /// Maximum distance outside all spheres; 0 if no point is outside.
    pub outside: f64,
    /// Number of points inside a sphere, and number of points.
    pub held: [usize; 2],
}

impl Stand {
    pub fn new(spheres: &[Sphere], surface: &[Point]) -> Self {
        let off = |p: &Point| spheres.iter().map(|s| distance(s, *p)).fold(f64::INFINITY, f64::min);
        let offs: Vec<f64> = surface.iter().map(off).filter(|off| off.is_finite()).collect();
        let far = || offs.iter().map(|off| off.abs());
        Stand {
            mean: far().sum::<f64>() / offs.len().max(1) as f64,
            best: far().reduce(f64::min).unwrap_or(0.0),
            worst: far().fold(0.0, f64::max),
            outside: offs.iter().copied().fold(0.0, f64::max),
            held: [offs.iter().filter(|off| **off <= 0.0).count(), offs.len()],
        }
    }
}

impl Model {
    /// Describes the spheres, one sentence per element.
    pub fn said(&self, names: &[String], covers: bool) -> Vec<String> {
        let mut lines = vec!["Lengths in metres, in the frame of the link.".to_owned()];
        if self.links.is_empty() {
            lines.push("No link has shapes, so there are no spheres.".to_owned());
            return lines;
        }
        lines.extend(self.level.as_ref().map(Level::said));
        let stands = self.links.iter().zip(&self.surface);
        let stands: Vec<Stand> = stands.map(|((_, own), at)| Stand::new(own, at)).collect();
        let outside = stands.iter().map(|stand| stand.outside).fold(0.0, f64::max);
        let held: usize = stands.iter().map(|stand| stand.held[0]).sum();
        let points: usize = stands.iter().map(|stand| stand.held[1]).sum();
        lines.push(if covers {
            "The spheres of a link hold all of its convex pieces.".to_owned()
        } else {
            format!(
                "The spheres {}do not cover the links: {:.1} % of the surface is inside a sphere, and a point of it is at most {:.1} mm outside.",
                if self.level.as_ref().is_some_and(Level::is_given) { "" } else { "are fitted and " },
                100.0 * held as f64 / points.max(1) as f64,
                1000.0 * outside
            )
        });
        lines.extend(self.measured.said());
        if self.ignored_as_never > 0 {
            let (count, plural) = match self.ignored_as_never {
                1 => ("1 pair".to_owned(), ["is", "it was"]),
                count => (format!("{count} pairs"), ["are", "they were"]),
            };
            lines.push(format!(
                "{count} of links that the URDD checks {} ignored: {} in no sampled collision, and the spheres touch.",
                plural[0], plural[1]
            ));
        }
        if !self.measured.is_good() {
            lines.push(self.measured.named(names));
        }
        lines
    }
}

impl Measured {
    fn said(&self) -> Vec<String> {
        let Some(rates) = &self.rates else {
            return vec!["No pair of links is checked.".to_owned()];
        };
        let mut lines = vec![format!(
            "Measured with these spheres and these ignored pairs, without buffers, against contacts of the exact shapes, in {} sampled configurations that were not used for the fit (from sample {} on, SPEC 9.3). No band around contact is left out.",
            rates.colliding + rates.free,
            Numbers::MEASURE
        )];
        lines.extend(said_of(rates));
        if let Some(rates) = &self.near_default {
            lines.push(format!(
                "So few configurations are free that the spheres are fitted near the default configuration, and measured there too: in {} samples, each moved toward it by an even part of the way.",
                rates.colliding + rates.free
            ));
            lines.extend(said_of(rates));
        }
        let default = match self.default {
            [true, true] => "in contact, as the exact shapes are",
            [true, false] => "free, though the exact shapes are in contact",
            [false, true] => "in contact, though the exact shapes are free",
            [false, false] => "free",
        };
        lines.push(format!("Default configuration: {default}."));
        lines
    }

    /// Names the pairs of links that cause wrong results.
    pub fn named(&self, names: &[String]) -> String {
        let named = self.faults.iter().take(NAMED).map(|(links, faults)| {
            let [a, b] = links.map(|link| names.get(link).map_or("", String::as_str));
            format!("`{a}` and `{b}` ({} missed, {} false)", faults.missed, faults.false_contacts)
        });
        format!(
            "Goals are at most {} % missed and {} % false. Pairs of links behind wrong answers, worst first: {}.",
            100.0 * MAX_MISSED,
            100.0 * MAX_FALSE,
            named.collect::<Vec<_>>().join(", ")
        )
    }

    pub fn json(&self) -> Value {
        let default =
            json!({ "exact_shapes_collide": self.default[0], "spheres_touch": self.default[1] });
        json!({
            "rates": self.rates.map(rates_json),
            "rates_near_default_configuration": self.near_default.map(rates_json),
            "default_configuration": default,
        })
    }
}

fn said_of(rates: &SphereRates) -> [String; 2] {
    [
        rate("missed collisions", rates.missed, rates.colliding, "collisions"),
        rate("false contacts", rates.false_contacts, rates.free, "free configurations"),
    ]
}

fn rate(what: &str, hits: usize, of: usize, all: &str) -> String {
    let [low, high] = interval(hits, of).map(|x| 100.0 * x);
    let part = 100.0 * hits as f64 / of.max(1) as f64;
    format!("  {what}: {hits} of {of} {all}, {part:.2} % (95 % interval {low:.2} % to {high:.2} %)")
}

fn rates_json(rates: SphereRates) -> Value {
    json!({
        "colliding": rates.colliding,
        "missed": rates.missed,
        "missed_interval_95": interval(rates.missed, rates.colliding),
        "free": rates.free,
        "false_contacts": rates.false_contacts,
        "false_contacts_interval_95": interval(rates.false_contacts, rates.free),
    })
}

/// The note for the user: that there is nothing to fit to, or that the spheres are not good enough for planning.
pub(super) fn note(model: &Model, subject: &Subject) -> Option<Note> {
    if model.links.is_empty() {
        return Some(Note::NoShapes(subject.shapes));
    }
    if model.measured.is_good() {
        return None;
    }
    let mut lines: Vec<String> = model.measured.said().into_iter().skip(1).collect();
    lines.push(model.measured.named(&subject.links));
    let lines: Vec<String> =
        lines.iter().map(|line| escape::line(line.trim()).into_owned()).collect();
    Some(Note::Spheres(lines.join("; ")))
}

pub(crate) fn foam(subject: &Subject) -> Result<Export, ExportError> {
    let model = Model::new(subject)?;
    let name = |link: usize| subject.links.get(link).cloned().unwrap_or_default();
    let sphere = |sphere: &Sphere| json!({ "origin": sphere.centre, "radius": sphere.radius });
    let links = model.links.iter().zip(&model.surface).map(|((link, spheres), surface)| {
        let stand = Stand::new(spheres, surface);
        let spheres: Vec<Value> = spheres.iter().map(sphere).collect();
        let value = json!({
            "mean": stand.mean,
            "best": stand.best,
            "worst": stand.worst,
            "spheres": spheres,
        });
        (name(*link), value)
    });
    let links: Map<String, Value> = links.collect();
    let document = json!({
        "made_from": subject.origin()?,
        "about": model.said(&subject.links, subject.options.chosen.cover),
        "measured": model.measured.json(),
        "ignored_pairs": model.ignored.iter().map(|pair| pair.map(name)).collect::<Vec<_>>(),
        "links": links,
    });
    let text = serde_json::to_string_pretty(&document).unwrap_or_default() + "\n";
    let text = escape::json(&text).into_owned();
    Ok(Export::of(text, Vec::new(), note(&model, subject).into_iter().collect()))
}

pub(crate) fn spherized(subject: &Subject) -> Result<Export, ExportError> {
    let model = Model::new(subject)?;
    let mut shapes: Vec<LinkShape> = Vec::new();
    for (link, spheres) in &model.links {
        let spheres = spheres.iter().enumerate().map(|(piece, sphere)| LinkShape {
            link: *link,
            piece,
            solid: Solid::Sphere { centre: sphere.centre, radius: sphere.radius },
        });
        shapes.extend(spheres);
    }
    let shapes = by_link(&subject.described, shapes);
    let mut notes = note(&model, subject).into_iter().collect();
    let (robot, files) = urdf::robot(subject, shapes, &mut notes)?;
    let said = model.said(&subject.links, subject.options.chosen.cover).join(" ");
    let text = robot.document(&subject.comments(said, &notes)?);
    Ok(Export::of(text, files, notes))
}
