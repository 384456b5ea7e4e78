//! The account of what may be made of what was read, and done with it.

use urdd_directory::account::{Account, AccountError, Charged, Cost, Overdrawn};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::limits::{ALLOWANCE, MULTIPLE};

const OVERDRAWN: AccountError = AccountError::Overdrawn(Overdrawn);

#[derive(Debug, PartialEq)]
struct Bytes(usize);

impl Cost for Bytes {
    fn cost(&self) -> usize {
        self.0
    }
}

fn allowance() -> usize {
    usize::try_from(ALLOWANCE).unwrap()
}

#[test]
fn a_charge_is_refused_where_it_exceeds_the_deposit() {
    let account = Account::default();
    let multiple = usize::try_from(MULTIPLE).unwrap();
    assert_eq!(account.charge(allowance()), Ok(()));
    assert_eq!(account.charge(1), Err(OVERDRAWN));
    account.deposit(2);
    assert_eq!(account.charge(2 * multiple - 1), Ok(()));
    assert_eq!(account.clone().charge(1), Err(OVERDRAWN), "clones share it");
    assert_eq!(account.charge(usize::MAX), Err(OVERDRAWN), "sums do not wrap");
    let mut list = Charged::default();
    assert_eq!(list.push(Bytes(1), &account), Err(OVERDRAWN));
    assert!(list.is_empty());
}

#[test]
fn a_list_has_what_was_charged_and_each_walk_is_a_step_an_entry() {
    let (account, mut list) = (Account::default(), Charged::default());
    assert_eq!(list.push(Bytes(allowance() - 4), &account), Ok(()));
    assert_eq!(list.push(Bytes(1), &account), Ok(()));
    let costs = |list: &Charged<Bytes>| Ok(list.walk(&account)?.map(Cost::cost).sum::<usize>());
    assert_eq!(costs(&list), Ok(allowance() - 3));
    assert_eq!(list[1], Bytes(1), "an index is free");
    assert_eq!(costs(&list), Err(OVERDRAWN), "3 steps were left, and 2 were done");
    assert!(list.walk_mut(&account).is_err());
    assert_eq!(list.push(Bytes(1), &account), Err(OVERDRAWN));
}

#[test]
fn whatever_is_charged_can_be_cancelled() {
    let cancellation = Cancellation::default();
    let account = Account::new(&cancellation);
    assert_eq!(account.charge(0), Ok(()));
    cancellation.cancel();
    assert_eq!(account.charge(0), Err(AccountError::Cancelled(Cancelled)));
    assert!(Charged::<Bytes>::default().walk(&account).is_err());
}
