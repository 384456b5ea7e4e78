//! The account of what may be made of what was read.

use urdd_directory::limits::{ALLOWANCE, Account, Charged, Cost, MULTIPLE, Overdrawn};

struct Bytes(usize);

impl Cost for Bytes {
    fn cost(&self) -> usize {
        self.0
    }
}

#[test]
fn a_charge_is_refused_where_it_exceeds_the_deposit() {
    let account = Account::default();
    let [allowance, multiple] = [ALLOWANCE, MULTIPLE].map(|of| usize::try_from(of).unwrap());
    assert_eq!(account.charge(allowance), Ok(()));
    assert_eq!(account.charge(1), Err(Overdrawn));
    account.deposit(2);
    assert_eq!(account.charge(2 * multiple - 1), Ok(()));
    assert_eq!(account.clone().charge(1), Err(Overdrawn), "clones share it");
    assert_eq!(account.charge(usize::MAX), Err(Overdrawn), "sums do not wrap");
    let mut list = Charged::default();
    assert_eq!(list.push(Bytes(1), &account), Err(Overdrawn));
    assert!(list.is_empty());
}

#[test]
fn a_list_has_what_was_charged() {
    let (account, mut list) = (Account::default(), Charged::default());
    let allowance = usize::try_from(ALLOWANCE).unwrap();
    assert_eq!(list.push(Bytes(allowance), &account), Ok(()));
    assert_eq!(list.push(Bytes(1), &account), Err(Overdrawn));
    assert_eq!(list.iter().map(Cost::cost).collect::<Vec<_>>(), [allowance]);
}
