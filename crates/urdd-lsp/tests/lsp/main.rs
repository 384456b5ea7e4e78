//! The server as an editor sees it: messages in, messages out.

// A test may stop anywhere.
#![allow(clippy::restriction)]

mod client;
mod completing;
mod documents_of_a_urdd;
mod findings;
mod fixes;
mod hostile;
mod hovering;
mod lifecycle;
mod navigating;
mod settings_files;
mod xacro_files;
