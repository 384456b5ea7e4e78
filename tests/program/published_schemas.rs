//! The published schemas: the committed folder matches the types.

use testkit::repository;
use urdd_directory::schema_files;

#[test]
fn the_committed_schemas_are_what_the_types_write() {
    let folder = repository().join("schema");
    let faults = schema_files::check(&folder).unwrap();
    let lines: Vec<String> = faults.iter().map(|fault| fault.to_string()).collect();
    assert!(
        faults.is_empty(),
        "{}\nrepair what is missing or outdated: urdd schema export schema",
        lines.join("\n")
    );
}
