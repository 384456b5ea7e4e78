//! The table of URDDs by family of rules.

use crate::code::Code;
use crate::report::summary::*;

#[test]
fn each_family_of_rules_has_one_column() {
    let columns = columns();
    for code in Code::ALL {
        let own = column(code.family());
        let times = columns.iter().filter(|column| **column == own).count();
        assert_eq!(times, 1, "{code}");
    }
    assert_eq!(columns[..3], ["DIR", "TXT", "URD"]);
}
