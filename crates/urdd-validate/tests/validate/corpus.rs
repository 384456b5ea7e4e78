//! The findings in the published URDDs, compared with a list whose entries have all been reviewed and judged true. The
//! URDDs are not in this repository: `URDD_CORPUS` names their folder.

use std::collections::BTreeMap;
use std::path::PathBuf;

use urdd_format::report::Verdict;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

#[test]
#[ignore = "needs ../shared/corpus, or what URDD_CORPUS names"]
fn published_urdds_have_the_findings_that_were_judged_true() {
    let corpus = std::env::var_os("URDD_CORPUS").map(PathBuf::from);
    let corpus = corpus.unwrap_or_else(|| PathBuf::from("../shared/corpus"));
    let run = validate(&[corpus], &Settings::default()).expect("the published URDDs");
    let report = run.report;
    let mut lines = String::new();
    for urdd in &report.urdds {
        assert_eq!(urdd.verdict, Verdict::Fail, "{}", urdd.path);
        let mut found: BTreeMap<(&str, &str), Vec<u32>> = BTreeMap::new();
        for finding in &urdd.findings {
            let file = finding.file.as_deref().unwrap_or("-");
            found.entry((&finding.code, file)).or_default().push(finding.count.0);
        }
        for ((code, file), counts) in found {
            let counts: Vec<String> = counts.iter().map(u32::to_string).collect();
            lines.push_str(&format!("{:14} {code} {file} x {}\n", urdd.path, counts.join(" + ")));
        }
    }
    insta::assert_snapshot!("corpus_findings", lines);
}
