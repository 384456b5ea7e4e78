//! Reserved file and folder names.

use urdd_directory::file_type::*;

#[test]
fn staging_folders_are_known_by_name() {
    for name in [".urdd-0123456789abcdef", ".ur5.urdd-4711-0", ".a.urdd-1-2.urdd-3-4"] {
        assert!(is_staging(name), "{name}");
    }
    for name in ["ur5", ".ur5", "ur5.urdd-1-2", ".ur5.urdd-1", ".ur5.urdd-a-b", ".git"] {
        assert!(!is_staging(name), "{name}");
    }
}
