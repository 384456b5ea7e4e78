//! `urdd check-collisions`.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use super::arguments::value_of;
use super::configurations::{self, Listed};
use super::inputs;
use super::output::{self, Failure};
use super::watch::Watch;
use urdd_directory::cancellation::Cancellation;
use urdd_export::KINDS;
use urdd_format::escape;
use urdd_format::readable::counted;
use urdd_robot::{Configurations, PairDistance, Proximity, Queries, RobotError, ShapeKind};

/// Arguments of `urdd check-collisions`.
///
/// Exit status: 0 where the robot is free in every configuration, 1 where it collides in one, 2 where nothing could be
/// asked.
#[derive(Args)]
pub struct CheckCollisionsArguments {
    /// A URDD: a folder or a zip archive.
    #[arg(value_name = "URDD")]
    path: PathBuf,

    /// File with one configuration per line, or `-` for standard input. A line is a JSON list with a value for each DOF
    /// (rad or m), a JSON object of DOF names and values, or comma-separated values. Default: the robot's default
    /// configuration.
    #[arg(long, short, value_name = "FILE", conflicts_with = "random")]
    configurations: Option<PathBuf>,

    /// Checks N random configurations within the bounds, the same ones in each run.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MAX_RANDOM))]
    random: Option<u64>,

    /// Shapes that represent the links.
    #[arg(long, value_parser = value_of::<ShapeKind>(&KINDS), default_value = "pieces")]
    shapes: ShapeKind,

    /// Number of nearest pairs to show for each configuration.
    #[arg(long, value_name = "K", default_value_t = 3)]
    nearest: usize,

    /// Output format: text, or JSON with one object per line for each configuration.
    #[arg(long, value_enum, default_value_t = CollisionFormat::Text)]
    format: CollisionFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CollisionFormat {
    Text,
    Json,
}

/// Maximum number of random configurations: some hours of work.
const MAX_RANDOM: u64 = 1_000_000_000;

/// Configurations per batch, so that memory does not grow with their number.
const CHUNK: u64 = 4096;

/// Text output summarizes more random configurations than this.
const FEW: u64 = 10;

/// Size of the text buffer, in bytes.
const MAX_UNPRINTED: usize = 1 << 16;

/// Number of pairs of links in a summary.
const WORST: usize = 10;

enum Chosen<'a> {
    Listed(Listed),
    Random(&'a Configurations, u64),
}

impl Chosen<'_> {
    fn count(&self) -> u64 {
        match self {
            Chosen::Listed(list) => list.count,
            Chosen::Random(_, count) => *count,
        }
    }

    /// Configuration `number`, for a robot with `dofs` DOFs.
    fn at(&self, number: u64, dofs: usize) -> Cow<'_, [f64]> {
        match self {
            Chosen::Listed(list) => {
                let start = usize::try_from(number).unwrap_or(usize::MAX).saturating_mul(dofs);
                list.values.get(start..start + dofs).unwrap_or_default().into()
            }
            Chosen::Random(space, _) => space.random(number).into(),
        }
    }
}

/// Runs `urdd check-collisions`. The exit status is 1 if the robot collides in any configuration.
pub fn run(arguments: &CheckCollisionsArguments, watch: &Watch) -> Result<u8, Failure> {
    watch.run_one(&arguments.path, None, |cancellation| check(arguments, cancellation))
}

fn check(arguments: &CheckCollisionsArguments, cancellation: &Cancellation) -> Result<u8, Failure> {
    let robot = inputs::open(&arguments.path)?;
    let in_urdd = output::about(&arguments.path);
    let space = robot.configurations().map_err(&in_urdd)?;
    let dofs = robot.dof_names().map_err(&in_urdd)?.len();
    let chosen = match (&arguments.configurations, arguments.random) {
        (Some(file), _) => Chosen::Listed(configurations::read(&robot, file)?),
        (None, Some(count)) => Chosen::Random(space, count),
        (None, None) => Chosen::Listed(Listed { values: space.zero(), count: 1 }),
    };
    let proximity = robot.proximity(arguments.shapes).map_err(&in_urdd)?;
    let hidden = robot.skipped_contacts(arguments.shapes).map_err(&in_urdd)?;
    let sum = arguments.random.is_some_and(|count| count > FEW);
    if arguments.format == CollisionFormat::Text && sum {
        let (text, any) =
            sum_up(&proximity, hidden.as_ref(), &chosen, dofs, cancellation).map_err(&in_urdd)?;
        output::print(&text)?;
        return Ok(any.into());
    }
    let of_pieces = !proximity.kind().is_of_links();
    let (mut text, mut any) = (String::new(), false);
    for number in 0..chosen.count() {
        cancellation.check()?;
        let configuration = chosen.at(number, dofs);
        let touching = proximity.collisions(&configuration).map_err(&in_urdd)?;
        let nearest = proximity.nearest(&configuration, arguments.nearest).map_err(&in_urdd)?;
        let unseen = hidden.as_ref().map(|hidden| hidden.collisions(&configuration)).transpose();
        let unseen = unseen.map_err(&in_urdd)?.unwrap_or_default();
        any |= !touching.is_empty();
        match arguments.format {
            CollisionFormat::Text => {
                as_text(&mut text, number, &touching, &nearest, of_pieces);
                for (links, _) in links_of(&unseen) {
                    let _ = writeln!(text, "  touching   {links}, skipped: they touch at rest");
                }
            }
            CollisionFormat::Json => {
                as_json(&mut text, number, &configuration, [&touching, &nearest, &unseen]);
            }
        }
        if text.len() > MAX_UNPRINTED && !output::print_some(&std::mem::take(&mut text))? {
            return Ok(any.into());
        }
    }
    if arguments.format == CollisionFormat::Text {
        text.push_str(&totals(&proximity, chosen.count()));
    }
    output::print(&text)?;
    Ok(any.into())
}

fn totals(proximity: &Proximity, count: u64) -> String {
    let shapes = counted(proximity.num_shapes(), "shape");
    let (kind, pairs) = (proximity.kind(), counted(proximity.num_pairs(), "pair"));
    let count = counted(count as usize, "configuration");
    format!("{count}, {shapes} ({kind}), {pairs} not skipped\n")
}

/// The names of a pair, with the pieces if there can be several.
fn label(pair: &PairDistance, of_pieces: bool) -> String {
    let [a, b] = [0, 1].map(|i| {
        let name = output::one_line(&pair.links[i]);
        if of_pieces { format!("{name}[{}]", pair.pieces[i]) } else { name }
    });
    format!("{a} - {b}")
}

fn as_text(
    text: &mut String,
    number: u64,
    touching: &[PairDistance],
    nearest: &[PairDistance],
    of_pieces: bool,
) {
    let links = links_of(touching);
    let verdict = match links.len() {
        0 => "free".to_owned(),
        count => format!("collides: {} of links", counted(count, "pair")),
    };
    let _ = writeln!(text, "configuration {number}: {verdict}");
    for (links, pairs) in &links {
        let pieces = match pairs {
            1 => String::new(),
            pairs => format!(" ({pairs} pairs of shapes)"),
        };
        let _ = writeln!(text, "  touching   {links}{pieces}");
    }
    for pair in nearest.iter().filter(|pair| pair.distance > 0.0) {
        let relative = pair.relative.map_or_else(String::new, |relative| {
            format!(", {:.0} % of its mean", 100.0 * relative)
        });
        let label = label(pair, of_pieces);
        let _ = writeln!(text, "  {:>9.4} m {label}{relative}", pair.distance);
    }
}

/// The pairs of links, in order, with the number of their pairs of shapes.
fn links_of(touching: &[PairDistance]) -> Vec<(String, usize)> {
    let mut links: Vec<(String, usize)> = Vec::new();
    for pair in touching {
        let label = label(pair, false);
        match links.last_mut() {
            Some((last, count)) if *last == label => *count += 1,
            _ => links.push((label, 1)),
        }
    }
    links
}

fn as_json(
    text: &mut String,
    number: u64,
    configuration: &[f64],
    [touching, nearest, unseen]: [&[PairDistance]; 3],
) {
    let pair = |pair: &PairDistance| {
        json!({
            "links": pair.links.iter().map(|name| name.to_string()).collect::<Vec<_>>(),
            "pieces": pair.pieces,
            "distance": pair.distance,
            "relative": pair.relative,
            "points": pair.points,
        })
    };
    let line = json!({
        "configuration": number,
        "values": configuration,
        "in_collision": !touching.is_empty(),
        "touching": touching.iter().map(pair).collect::<Vec<_>>(),
        "nearest": nearest.iter().map(pair).collect::<Vec<_>>(),
        "skipped_touching": unseen.iter().map(pair).collect::<Vec<_>>(),
    });
    let _ = writeln!(text, "{}", escape::json(&line.to_string()));
}

fn list_worst(text: &mut String, often: BTreeMap<String, usize>) {
    let mut often: Vec<(String, usize)> = often.into_iter().collect();
    often.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    for (links, count) in often.iter().take(WORST) {
        let _ = writeln!(text, "  {count:>7} {links}");
    }
    if often.len() > WORST {
        let _ = writeln!(text, "  and {} more pairs of links", often.len() - WORST);
    }
}

/// Summarizes many configurations: the number that collide, and the links that collide most often.
fn sum_up(
    proximity: &Proximity,
    hidden: Option<&Proximity>,
    chosen: &Chosen,
    dofs: usize,
    cancellation: &Cancellation,
) -> Result<(String, bool), RobotError> {
    let count = chosen.count();
    let (mut colliding, mut unseen): (u64, u64) = (0, 0);
    let mut often: BTreeMap<String, usize> = BTreeMap::new();
    let mut often_unseen: BTreeMap<String, usize> = BTreeMap::new();
    for start in (0..count).step_by(CHUNK as usize) {
        let numbers = start..count.min(start + CHUNK);
        let values: Vec<f64> =
            numbers.clone().flat_map(|number| chosen.at(number, dofs).into_owned()).collect();
        let add = |shapes: &Proximity, total: &mut u64, often: &mut BTreeMap<_, usize>| {
            let answers = match dofs {
                // An empty slice does not determine the number of configurations.
                0 => {
                    let answer = shapes.in_collision(&[])?;
                    numbers.clone().map(|_| answer).collect()
                }
                _ => {
                    let mut answers = vec![false; numbers.clone().count()];
                    shapes.in_collision_batch_into(&values, cancellation, &mut answers)?;
                    answers
                }
            };
            for (number, _) in numbers.clone().zip(answers).filter(|(_, collides)| *collides) {
                cancellation.check()?;
                *total += 1;
                let touching = shapes.collisions(&chosen.at(number, dofs))?;
                for (links, _) in links_of(&touching) {
                    *often.entry(links).or_default() += 1;
                }
            }
            Ok::<(), RobotError>(())
        };
        add(proximity, &mut colliding, &mut often)?;
        if let Some(hidden) = hidden {
            add(hidden, &mut unseen, &mut often_unseen)?;
        }
    }
    let share = 100.0 * colliding as f64 / count as f64;
    let mut text = format!("{colliding} of {} configurations collide ({share:.1} %)\n", count);
    list_worst(&mut text, often);
    if unseen > 0 {
        let share = 100.0 * unseen as f64 / count as f64;
        let _ = writeln!(
            text,
            "not counted: {unseen} ({share:.1} %) in which links touch that are skipped because they touch at rest"
        );
        list_worst(&mut text, often_unseen);
    }
    text.push_str(&totals(proximity, count));
    Ok((text, colliding > 0))
}
