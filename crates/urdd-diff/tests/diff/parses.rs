//! A description is parsed once for all that compare it and for the rules about robots.

use testkit::fixture::{Fixture, toy_robot};
use urdd_diff::{Options, Side};
use urdd_xml::tally;

#[test]
fn each_side_is_parsed_once() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("a.urdf");
    std::fs::write(&urdf, "<robot name='a'><link name='b'/></robot>").unwrap();
    let mut urdd = Fixture::core(&toy_robot());
    urdd.seal();
    urdd.write_to(&folder.path().join("toy"));
    for (path, times) in [(urdf, 1), (folder.path().join("toy"), 1)] {
        tally::take();
        Side::open(&path, &Options::default()).unwrap();
        assert_eq!(tally::take(), [("roxmltree", times)].into(), "{}", path.display());
    }
}
