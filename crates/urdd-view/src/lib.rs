//! Internal to urdd; no stability promise.
//!
//! `urdd view`: the page `page/`, the robots that it shows, and a server for both. Only a browser on this machine with
//! the printed address can use the server.

mod assets;
mod card;
mod cards;
mod collection;
mod connections;
mod drop_folder;
mod drops;
mod export;
mod guard;
mod http;
mod keep;
mod live;
mod one_file;
pub mod picture;
mod reply;
mod report;
mod revision;
mod route;
mod save;
mod server;
mod site_list;
mod states;

pub use collection::{Collection, Making, Shown, Source};
pub use export::export;
pub use live::Live;
pub use one_file::{may_hold_page, page_with};
pub use server::{Server, ServerError};
pub use site_list::ExportError;
pub use states::States;
