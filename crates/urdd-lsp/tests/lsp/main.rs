//! The server as an editor sees it: messages in, messages out.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod client;
mod completing;
mod documents_of_a_urdd;
mod findings;
mod fixes;
mod hostile;
mod hovering;
mod lifecycle;
mod markup_place;
mod markup_scan;
mod navigating;
mod options;
mod settings_files;
mod text;
mod uri;
mod xacro_files;
