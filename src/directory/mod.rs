//! A URDD on disk. So far: the text layer, which reads and writes JSON and YAML and knows nothing
//! of URDD modules.

pub mod canonical;
pub mod json;
mod json_fault;
pub mod json_scan;
pub mod number_text;
pub mod position;
mod string_text;
pub mod text_fault;
pub mod yaml;
mod yaml_compare;
mod yaml_message;
mod yaml_open;
pub mod yaml_scalar;
mod yaml_tabs;
mod yaml_tag;
