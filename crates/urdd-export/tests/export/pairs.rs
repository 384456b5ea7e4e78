//! Pairs of links that need no collision check.

use crate::made::{export, robot, urdf};
use SkipReason::{Adjacent, Always, Default as Resting, Never, None as Sometimes};
use urdd_directory::account::{Account, AccountError, Overdrawn};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::limits::ALLOWANCE;
use urdd_export::pairs::*;
use urdd_export::{Choices, ExportError, Format, export_within};
use urdd_format::link_shapes_simple_skips::SkipReason;

#[test]
fn a_pair_of_links_is_what_its_shapes_make_it() {
    let of = |reasons: &[SkipReason]| together(reasons.iter().copied().map(Some));
    assert_eq!(of(&[Never, Never]), Some(Never));
    assert_eq!(of(&[Never, Sometimes]), Some(Sometimes));
    assert_eq!(of(&[Never, Resting, Sometimes]), Some(Resting));
    assert_eq!(of(&[Adjacent, Always]), Some(Always));
    assert_eq!(of(&[Adjacent, Adjacent]), Some(Adjacent));
    assert_eq!(together([Some(Never), None].into_iter()), None);
}

#[test]
fn names_in_very_many_pairs_are_charged() {
    // 300 links, and 500 pieces, with ordinary names; 2,000 links without a table.
    for (longest, shapes) in [(40, 300), (60, 500), (40, 2_000), (100_000, 20)] {
        assert!(
            charge(longest * shapes, shapes, &Account::default()).is_ok(),
            "{longest} {shapes}"
        );
    }
    assert!(charge(40_000 * 300, 300, &Account::default()).is_err());
    assert!(charge(usize::MAX / 1000, 2_000, &Account::default()).is_err());
}

#[test]
fn an_export_of_long_names_in_very_many_pairs_is_refused() {
    let exported = |length: usize| {
        let name = |k: usize| format!("{k}{}", "n".repeat(length));
        let link = |k: usize| {
            let geometry = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
            format!("<link name='{}'>{geometry}</link>", name(k))
        };
        let joint = |k: usize| {
            let ends = format!("<parent link='{}'/><child link='{}'/>", name(0), name(k));
            format!("<joint name='j{k}' type='fixed'>{ends}</joint>")
        };
        let parts = (0..60).map(link).chain((1..60).map(joint)).collect::<String>();
        let (_folder, robot) = robot(&urdf(&parts));
        export(&robot, Format::Srdf, &Choices::default()).map(drop)
    };
    assert!(exported(40).is_ok());
    let error = exported(20_000).expect_err("too much").to_string();
    assert!(error.contains("needs more memory or work"), "{error}");
}

#[test]
fn an_export_is_of_the_account_of_the_run() {
    let link = |k: usize| {
        let geometry = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
        format!("<link name='l{k}'>{geometry}</link>")
    };
    let ends = "<parent link='l0'/><child link='l1'/><origin xyz='3 0 0'/>";
    let joint = format!("<joint name='j' type='continuous'>{ends}</joint>");
    let (_folder, robot) = robot(&urdf(&(link(0) + &link(1) + &joint)));
    let cancellation = Cancellation::default();
    cancellation.cancel();
    for format in [Format::Srdf, Format::Urdf, Format::Mjcf, Format::Curobo] {
        let choices = Choices { samples: 100, ..Choices::default() };
        let options = choices.options(format).expect("options");
        let export = |account: &Account| export_within(&robot, &options, account);
        let name = format.name();
        assert!(export(&Account::default()).is_ok(), "{name}");
        let cancelled = export(&Account::new(&cancellation)).map(|_| ());
        assert_eq!(
            cancelled,
            Err(ExportError::Account(AccountError::Cancelled(Cancelled))),
            "{name}"
        );
    }
    // What another part of the run took is gone.
    let (options, account) =
        (Choices::default().options(Format::Srdf).expect("options"), Account::default());
    assert!(account.charge(usize::try_from(2 * ALLOWANCE).expect("a number")).is_err());
    let refused = export_within(&robot, &options, &account).map(|_| ());
    assert_eq!(refused, Err(ExportError::Account(AccountError::Overdrawn(Overdrawn))));
}
