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

#[test]
fn a_long_path_keeps_what_tells_it_from_its_neighbours() {
    assert_eq!(ending("arms/urdf/h2017.blue.urdf", 25), "arms/urdf/h2017.blue.urdf");
    assert_eq!(ending("arms/urdf/h2017.blue.urdf", 16), "…h2017.blue.urdf");
    assert_eq!(ending("arms/urdf/h2017.white.urdf", 16), "…2017.white.urdf");
    assert_eq!(ending("ä/ö", 2), "…ö");
}
