//! An import as part of a run: its account, and its cancellation.

use std::path::Path;

use urdd_directory::account::Account;
use urdd_directory::limits::ALLOWANCE;
use urdd_source::{Settings, SourceError};

use super::bounds::{in_memory, refused};
use crate::import;

const MODELS: [(&str, &str); 3] = [
    ("r.xml", "<mujoco><worldbody><body><geom size=\"1\"/></body></worldbody></mujoco>"),
    ("r.sdf", "<sdf version=\"1.10\"><model name=\"m\"><link name=\"l\"/></model></sdf>"),
    ("r.usda", "#usda 1.0\ndef Cube \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}\n"),
];

fn settings((name, text): (&str, &str)) -> Settings {
    in_memory(&[(name, text.as_bytes())])
}

#[test]
fn parts_of_a_run_share_its_account() {
    for model in MODELS {
        let account = Account::default();
        let own = settings(model);
        let shared = Settings { account: Some(account.clone()), ..own.clone() };
        let path = Path::new("/").join(model.0);
        assert!(import(&path, &shared).unwrap().is_some(), "{}", model.0);
        // Another part of the run takes what was left, and more.
        let most = usize::try_from(2 * ALLOWANCE).unwrap();
        assert!(account.charge(most).is_err());
        refused(model.0, &shared);
        assert!(import(&path, &own).unwrap().is_some(), "{}", model.0);
        // What a part reads is for all.
        account.deposit(most);
        assert!(import(&path, &shared).unwrap().is_some(), "{}", model.0);
    }
}

#[test]
fn an_import_can_be_cancelled() {
    for model in MODELS {
        let settings = settings(model);
        settings.cancellation.cancel();
        let cancelled = import(&Path::new("/").join(model.0), &settings);
        assert!(matches!(cancelled, Err(SourceError::Cancelled)), "{}", model.0);
    }
}
