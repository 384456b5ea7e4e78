//! Internal to urdd; no stability promise.
//!
//! `urdd view`: the page `page/`, the robots that it shows, and a server for both. Only a browser on this machine with
//! the printed address can use the server.

mod assets;
mod cards;
mod collection;
mod guard;
mod http;
mod live;
mod one_file;
pub mod picture;
mod report;
mod revision;
mod route;
mod save;
mod server;
mod shown;
mod site;

pub use collection::Collection;
pub use live::Live;
pub use one_file::{may_hold_page, page_with};
pub use server::{Server, ServerError};
pub use shown::{Making, Shown, Source, States};
pub use site::{ExportError, export};
