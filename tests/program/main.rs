//! The program from outside, and consistency of the repository: SPEC.md, the suite, the page, figures.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod annotations;
mod architecture;
mod bad_input;
mod broad_folders;
mod cli_schema;
mod cli_validate;
mod combine;
mod conformance;
mod diff;
mod directory_sources;
mod export;
mod file_types;
mod fuzz_findings;
mod generate;
mod imports;
mod info;
mod large_inputs;
mod links;
mod lint;
mod lsp;
mod new_extension;
mod outputs;
mod parsers;
mod printing;
mod producers_agree;
mod program;
mod published_corpus;
mod published_schemas;
mod readers;
mod report_formats;
mod report_summary;
mod results;
mod robot;
mod robots;
mod scripts_doc;
mod security_doc;
mod snapshots;
mod spec_agrees;
mod support_is_sound;
mod texts;
mod vectors;
mod view;
mod workspace;
