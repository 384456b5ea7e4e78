use crate::program::urdd;
use testkit::robots::made_of;
use testkit::urdfs::TOWER;

#[test]
fn a_mixed_pair_is_named_on_the_command_line() {
    let (folder, _path) = made_of(TOWER);
    let run = |more: &[&str]| {
        let arguments = ["export", "srdf", "robot", "-o", "-"];
        urdd(&[&arguments[..], more].concat(), folder.path())
    };
    let (status, printed, said) = run(&[]);
    assert!(
        status == 0 && printed.contains("link2=\"arm\"") && said.contains("--keep-pairs"),
        "{said}"
    );
    let (status, printed, said) = run(&["--keep-pairs"]);
    assert!(
        status == 0 && !printed.contains("link2=\"arm\"") && !said.contains("--keep-pairs"),
        "{said}"
    );
}
