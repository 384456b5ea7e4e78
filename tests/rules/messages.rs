//! The text of findings: where, what is wrong, what was expected and found, in words that a reader can act on.

use serde_json::json;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use testkit::fixture::Fixture;

/// A code, a change, and the expected finding: its pointer or line, message, expected and found values.
type Case = (&'static str, fn(&mut Fixture), [&'static str; 4]);

const BOUNDS: &str = "bounds_module";

const CASES: &[Case] = &[
    (
        "BND002",
        |urdd| urdd.set(BOUNDS, "/bounds/1/0", json!(-1.1)),
        [
            "/bounds/1/0",
            "DOF 1: this is not the value of `/dof_lower_bounds/1`, and the lower limit of joint `shoulder` is -1.0",
            "-1.0, as `/dof_lower_bounds/1` has it",
            "-1.1",
        ],
    ),
    (
        "BND002",
        |urdd| urdd.set(BOUNDS, "/dof_upper_bounds/15", json!(1.0)),
        [
            "/dof_upper_bounds/15",
            "DOF 15: this is not the value of `/bounds/15/1`, and the upper bound of joint `spin`, which has no limits, is 3.141592653589793",
            "3.141592653589793, as `/bounds/15/1` has it",
            "1.0",
        ],
    ),
    (
        "BND002",
        |urdd| urdd.set(BOUNDS, "/bounds/15/0", json!(-1.0)),
        [
            "/bounds/15/0",
            "DOF 15: this is not the value of `/dof_lower_bounds/15`, and the lower bound of joint `spin`, which has no limits, is -3.141592653589793",
            "-3.141592653589793, as `/dof_lower_bounds/15` has it",
            "-1.0",
        ],
    ),
    (
        "BND002",
        |urdd| {
            urdd.set(BOUNDS, "/bounds/15/0", json!(-1.0));
            urdd.set(BOUNDS, "/dof_lower_bounds/15", json!(-2.0));
        },
        [
            "/dof_lower_bounds/15",
            "DOF 15: this is not the value of `/bounds/15/0`, and neither is right: the lower bound of joint `spin`, which has no limits, is -3.141592653589793",
            "-3.141592653589793 in both places",
            "-2.0",
        ],
    ),
    (
        "CON005",
        |urdd| urdd.set("connections_module", "/link_connection_paths/1/1", json!([0, 1])),
        [
            "/link_connection_paths/1/1",
            "the path of a link to itself is that link alone",
            "[1]",
            "[0, 1]",
        ],
    ),
    (
        "URD011",
        |urdd| urdd.urdf_replace("<mass value=\"", "<mass value=\"1 kg "),
        [
            "",
            "`value` of `<mass>` is not a number; write one number, without a unit",
            "",
            "\"1 kg 1\"",
        ],
    ),
    (
        "URD011",
        |urdd| urdd.urdf_replace("</robot>", "</robot> robot"),
        [
            "",
            "not well-formed XML: there is more after the end of the outermost element; remove it",
            "",
            "",
        ],
    ),
];

#[test]
fn findings_say_where_and_what_to_do() {
    for (code, change, expected) in CASES {
        let mut urdd = Fixture::toy();
        change(&mut urdd);
        urdd.seal();
        let folder = testkit::temporary::folder();
        let root = folder.path().join("robot");
        urdd.write_to(&root);
        let run = validate(&[&root], &Settings::default()).expect("something to examine");
        let report = run.report;
        let findings: Vec<_> = report.urdds[0].findings.iter().collect();
        let finding = findings
            .iter()
            .find(|finding| finding.code == *code)
            .unwrap_or_else(|| panic!("{code}: {findings:#?}"));
        let text = |text: &Option<String>| text.clone().unwrap_or_default();
        let found = [
            text(&finding.pointer),
            finding.message.clone(),
            text(&finding.expected),
            text(&finding.actual),
        ];
        assert_eq!(found, expected.map(str::to_owned), "{code}");
    }
}
