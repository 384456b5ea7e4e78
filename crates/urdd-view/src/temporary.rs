//! A folder that is removed when the program ends. The next run removes what a killed program left: a process that
//! obtains a folder's lock knows that no other process uses it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use urdd_directory::cancellation::Cancellation;
use urdd_directory::target_lock::{LockError, TargetLock};
use urdd_format::hexadecimal::hexadecimal;

/// The prefix of such folders' names.
const PREFIX: &str = "urdd-shown-";

/// A folder that is removed when this is dropped.
#[derive(Debug)]
pub struct Temporary {
    path: PathBuf,
    /// Released after the folder is removed.
    _lock: TargetLock,
}

impl Temporary {
    /// Creates a folder that only this user can access in `place`, and removes those of programs that have ended.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn begin(place: &Path) -> io::Result<Self> {
        take_away(place);
        let mut random = [0; 8];
        getrandom::fill(&mut random).map_err(io::Error::other)?;
        let path = place.join(format!("{PREFIX}{}", hexadecimal(&random)));
        // Locks before the folder exists: other processes remove unlocked folders.
        let lock = TargetLock::acquire(&path, &Cancellation::default());
        let lock = lock.map_err(|error| match error {
            LockError::Io(error) => error,
            LockError::Cancelled => io::ErrorKind::Interrupted.into(),
        })?;
        let mut builder = fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(&path)?;
        Ok(Temporary { path, _lock: lock })
    }

    /// Writes a page that only this user can read, and that leads to an address. A browser is given its path: everybody
    /// on the machine can read the arguments of programs, and the address has a token.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn page_to(&self, address: &str) -> io::Result<PathBuf> {
        let path = self.path.join("open.html");
        let mut options = fs::OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let text = format!(
            "<!doctype html>\n<meta charset=\"utf-8\">\n<title>urdd view</title>\n\
             <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<a href=\"{address}\">The robot</a>\n"
        );
        options.open(&path)?.write_all(text.as_bytes())?;
        Ok(path)
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.path);
    }
}

/// Removes the folders of programs that have ended: those with a name that [`Temporary::begin`] gives, and with the lock
/// file that a killed program leaves. Those of other users remain: they cannot be locked or removed.
fn take_away(place: &Path) {
    for entry in fs::read_dir(place).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let number = name.to_str().and_then(|name| name.strip_prefix(PREFIX)).unwrap_or_default();
        let is_ours = number.len() == 16
            && number.bytes().all(|digit| matches!(digit, b'0'..=b'9' | b'a'..=b'f'))
            && entry.file_type().is_ok_and(|kind| kind.is_dir())
            && TargetLock::is_left(&path);
        if is_ours && let Ok(Some(_lock)) = TargetLock::at_once(&path) {
            let _ = fs::remove_dir_all(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_goes_with_the_next_and_what_is_used_stays() {
        let place = tempfile::tempdir().expect("a folder");
        let living = Temporary::begin(place.path()).expect("a folder");
        fs::write(living.path().join("x"), "1").expect("written");
        // As a killed program leaves them: the folder, and its lock file, which no process holds.
        let left = place.path().join(format!("{PREFIX}0123456789abcdef"));
        fs::create_dir(&left).expect("a folder");
        fs::write(left.join("x"), "1").expect("written");
        let lock = TargetLock::at_once(&left).expect("a lock").expect("a lock");
        let file =
            fs::read_dir(place.path()).expect("a folder").flatten().map(|entry| entry.path());
        let file = file.filter(|file| file.extension().is_some_and(|ending| ending == "lock"));
        let files: Vec<PathBuf> = file.collect();
        drop(lock);
        files.iter().for_each(|file| fs::write(file, "").expect("written"));
        // Not ours: another name, or no lock file.
        let others = ["results", "0123456789abcdeg", "fedcba9876543210", "0123456789ABCDEF"];
        let others = others.map(|name| place.path().join(format!("{PREFIX}{name}")));
        others.iter().for_each(|other| fs::create_dir(other).expect("a folder"));
        let mine = place.path().join("urdd-mine");
        fs::create_dir(&mine).expect("a folder");
        let second = Temporary::begin(place.path()).expect("a folder");
        assert!(!left.exists() && others.iter().all(|other| other.exists()));
        drop(second);
        assert!(living.path().join("x").exists() && mine.exists());
        let path = living.path().to_owned();
        drop(living);
        assert!(!path.exists());
    }
}
