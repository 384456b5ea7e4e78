//! Faults in the text of a JSON or YAML file, independent of its content.

use urdd_directory::position::*;

#[test]
fn keeps_the_first_of_each_kind_and_counts_all() {
    let mut faults = TextFaults::default();
    let mut built = 0;
    for _ in 0..100_000 {
        faults.add(TextFaultKind::YamlTag, || {
            built += 1;
            TextFault::new(TextFaultKind::YamlTag, "a tag")
        });
    }
    faults.push(TextFault::new(TextFaultKind::YamlDiffers, "differs"));
    assert_eq!(built, KEPT_PER_KIND);
    assert_eq!(faults.iter().count(), KEPT_PER_KIND + 1);
    assert_eq!(faults.total(TextFaultKind::YamlTag), 100_000);
    assert_eq!(faults.to_string(), "a tag (and 100000 more)");
}
