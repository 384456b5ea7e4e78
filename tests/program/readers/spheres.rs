//! Lists of spheres: cuRobo's and Foam's.

use urdd_directory::account::Account;
use urdd_export::read_spheres;

/// What is refused has a reason. What is accepted is spheres that can be.
pub fn spheres(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let account = Account::default();
    account.deposit(text.len());
    match read_spheres(text, &account) {
        Ok(list) => {
            for sphere in list.links.iter().flat_map(|(_, spheres)| spheres) {
                assert!(sphere.radius > 0.0 && sphere.radius <= 1e9);
                assert!(sphere.centre.iter().all(|x| x.abs() <= 1e9));
            }
            assert!(list.left_out.iter().all(|reason| !reason.is_empty()));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
