//! The `urdd-kill-rate` program: for the maintainers of `urdd`, not published.

#![allow(clippy::disallowed_methods, reason = "for maintainers")]

use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use urdd_kill_rate::{Judge, MeasureError, Plan, measure, modules_of, present};
use urdd_validate::rules;
use urdd_validate::settings::Settings;

/// Exit status: a module is below the minimum rate, or a URDD has findings before any mutation.
const BELOW: u8 = 1;
/// Exit status: wrong usage, or nothing to measure with.
const USAGE: u8 = 2;

/// Change valid URDDs one value at a time, and count what the validator notices.
#[derive(Parser)]
#[command(
    name = "urdd-kill-rate",
    after_help = "Each change is made in a temporary copy; the URDDs themselves are only read. What counts as a change, \
    and why some survive: conformance/kill_rate.md.\n\nExit status: 0 every module has the least rate, in all \
    URDDs together; 1 one has not, or a URDD has findings before anything is changed; 2 wrong usage, or nothing to measure with."
)]
struct Arguments {
    /// Valid URDDs of version 1, or folders with URDDs at any depth.
    #[arg(required = true, value_name = "DIR")]
    paths: Vec<PathBuf>,

    /// How many changes are made of each field of each document, and of each kind of file.
    #[arg(long, value_name = "N", default_value_t = 24, conflicts_with = "all", value_parser = clap::value_parser!(u32).range(1..))]
    per_field: u32,

    /// Makes every change of every value.
    #[arg(long)]
    all: bool,

    /// Makes at most so many changes of each URDD, taken evenly from all fields.
    #[arg(long, value_name = "N")]
    limit: Option<usize>,

    /// The modules to change, separated by commas; urdd.json and source (the carried URDF) are names too. Without it, all.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    modules: Vec<String>,

    /// Looks again, as `urdd validate --deep` does, at what is not noticed otherwise.
    #[arg(long)]
    deep: bool,

    /// What choices follow from.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// The least part of a module's changes, in all URDDs together, that must be noticed.
    #[arg(long, value_name = "RATE", default_value_t = 0.99)]
    min_rate: f64,

    /// Threads; without it, one for each processor. The result is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,

    /// How the result is written to standard output.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,

    /// With --format json: lists every change, with the rules that notice it, not only the survivors.
    #[arg(long)]
    list_all: bool,
}

/// How the result is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table for people.
    Human,
    /// JSON, with every survivor.
    Json,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let plan = Plan {
        seed: arguments.seed,
        per_field: (!arguments.all).then_some(arguments.per_field as usize),
        limit: arguments.limit,
        modules: arguments.modules.clone(),
        threads: arguments.threads.map(usize::from),
    };
    let rules = rules::all();
    let judge = Judge {
        rules: &rules,
        plain: Settings::default(),
        deep: arguments.deep.then(|| Settings { deep: true, ..Settings::default() }),
    };
    let bar = match std::io::stderr().is_terminal() {
        true => ProgressBar::new(0),
        false => ProgressBar::hidden(),
    };
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta}") {
        bar.set_style(style);
    }
    let progress = |name: &str, done: usize, of: usize| {
        if bar.length() != Some(of as u64) {
            bar.set_length(of as u64);
            bar.set_message(urdd_format::escape::line(name).into_owned());
        }
        bar.set_position(done as u64);
    };
    // Crashed rules are caught and reported; suppress the output of the default hook.
    std::panic::set_hook(Box::new(|_| {}));
    let measured = measure(&arguments.paths, &judge, &plan, &progress);
    let _ = std::panic::take_hook();
    bar.finish_and_clear();
    let measured = match measured {
        Ok(measured) => measured,
        Err(error) => {
            eprintln!("urdd-kill-rate: {error}");
            let findings = matches!(error, MeasureError::HasFindings { .. });
            return ExitCode::from(if findings { BELOW } else { USAGE });
        }
    };
    let text = match arguments.format {
        Format::Human => present::table(&measured),
        Format::Json => {
            let value = present::json(&measured, &plan, arguments.list_all);
            let text = urdd_directory::canonical::json_string(&value);
            urdd_format::escape::json(&text).into_owned()
        }
    };
    let mut out = std::io::stdout().lock();
    if let Err(error) = out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        eprintln!("urdd-kill-rate: the result cannot be written: {error}");
        return ExitCode::from(USAGE);
    }
    let below = modules_of(&measured)
        .iter()
        .any(|module| module.deep.unwrap_or(module.plain).rate() < arguments.min_rate);
    match below {
        true => ExitCode::from(BELOW),
        false => ExitCode::SUCCESS,
    }
}
