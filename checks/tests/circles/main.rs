//! No cyclic dependencies between the files of a crate: each can be read after the files that it uses.

mod modules;
mod names;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use modules::Crate;
use names::{Ties, ties};

fn repository() -> &'static Path {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    folder.expect("the repository")
}

/// Files that all reach each other.
type Circle<'a> = BTreeSet<&'a Path>;

fn circles<'a>(ties: &Ties<'a>) -> BTreeSet<Circle<'a>> {
    let reached = |from: &'a Path| {
        let mut reached = Circle::new();
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            let next = ties.get(file).into_iter().flat_map(BTreeMap::keys);
            open.extend(next.filter(|next| reached.insert(next)));
        }
        reached
    };
    let all: BTreeMap<&Path, Circle> = ties.keys().map(|file| (*file, reached(file))).collect();
    let circle = |(file, reached): (&&'a Path, &Circle<'a>)| -> Circle<'a> {
        let is_back = |other: &&&Path| all.get(**other).is_some_and(|back| back.contains(file));
        reached.iter().filter(is_back).copied().collect()
    };
    let circles = all.iter().map(circle);
    circles.filter(|circle| !circle.is_empty()).collect()
}

/// The names that connect the files of a cycle, one line each.
fn ties_of(circle: &Circle<'_>, ties: &Ties<'_>, folder: &Path) -> String {
    let short = |file: &Path| file.strip_prefix(folder).unwrap_or(file).display().to_string();
    let mut lines = String::new();
    for from in circle {
        for (to, names) in ties[from].iter().filter(|(to, _)| circle.contains(*to)) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            lines += &format!("  {} -> {}: {}\n", short(from), short(to), names.join(", "));
        }
    }
    lines
}

/// The folders of the repository's packages.
fn packages() -> Vec<PathBuf> {
    let mut packages = vec![repository().to_owned()];
    for folder in [repository().to_owned(), repository().join("crates")] {
        let entries = fs::read_dir(&folder).expect("a folder");
        packages.extend(entries.map(|entry| entry.expect("an entry").path()));
    }
    packages.retain(|folder| folder.join("Cargo.toml").is_file() && folder.join("src").is_dir());
    assert!(packages.len() > 15, "{packages:?}");
    packages
}

#[test]
fn no_circle_between_files() {
    let mut found = String::new();
    for package in packages() {
        let read = Crate::read(&package);
        let ties = ties(&read);
        for circle in circles(&ties) {
            found += &format!("a circle of {} files:\n", circle.len());
            found += &ties_of(&circle, &ties, repository());
        }
    }
    assert!(
        found.is_empty(),
        "{found}Move what both need into the file where it belongs, or join the files."
    );
}

/// The cycles between the files of a crate.
fn planted(files: &[(&str, &str)]) -> String {
    let package = tempfile::tempdir().expect("a folder");
    for (path, text) in files {
        let file = package.path().join("src").join(path);
        fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        fs::write(file, text).expect("a file");
    }
    let read = Crate::read(package.path());
    let ties = ties(&read);
    let source = package.path().join("src");
    let circles = circles(&ties).into_iter();
    circles.map(|circle| ties_of(&circle, &ties, &source)).collect()
}

#[test]
fn circles_are_found_however_names_are_written() {
    let mods = ("lib.rs", "mod a; mod b; pub use b::B;");
    let a = ("a.rs", "use super::b::B; pub struct A(B);");
    for b in [
        "use super::a::A; pub struct B(Option<Box<A>>);",
        "use crate::{a::{A as Other}}; pub struct B(Vec<Other>);",
        "use super::*; pub struct B(Vec<a::A>);",
        "pub struct B; impl B { fn f() -> usize { 1 + crate::a::A::N } }",
        "pub struct B; fn f() { println!(\"{}\", super::a::A::new()); }",
        "pub struct B(#[serde(with = \"super::a::A\")] u8);",
        "mod inner { use super::super::a::A; } pub struct B;",
    ] {
        let ties = planted(&[mods, a, ("b.rs", b)]);
        assert_eq!(ties, "  a.rs -> b.rs: B\n  b.rs -> a.rs: A\n", "{b}");
    }
    // Re-exported by another file, and used from there.
    let a = ("a.rs", "use crate::B; pub struct A(B);");
    let ties = planted(&[mods, a, ("b.rs", "use super::a::A; pub struct B(A);")]);
    assert_eq!(ties, "  a.rs -> b.rs: B\n  b.rs -> a.rs: A\n");
    // A name of another crate, or of a third file, that a file re-exports.
    let mods = ("lib.rs", "mod a; mod b; mod c;");
    let b = ("b.rs", "use super::a::Name; pub struct B(Name);");
    let c = ("c.rs", "pub struct Name;");
    for name in ["other::Name", "super::c::Name", "crate::c::Name"] {
        let a = format!("use super::b::B; pub use {name}; pub struct A(B);");
        let ties = planted(&[mods, ("a.rs", &a), b, c]);
        assert_eq!(ties, "  a.rs -> b.rs: B\n  b.rs -> a.rs: Name\n", "{name}");
    }
    // A root that re-exports another crate's name, and uses its child.
    let root = "mod a; pub use other::Name; pub fn f() { a::f() }";
    let a = ("a.rs", "use crate::Name; pub fn f() -> Name {}");
    let ties = planted(&[("lib.rs", root), a]);
    assert_eq!(ties, "  a.rs -> lib.rs: Name\n  lib.rs -> a.rs: f\n");
    // Through three files.
    let files = [
        ("lib.rs", "mod a; mod b; mod c;"),
        ("a.rs", "use super::b::B; pub struct A;"),
        ("b.rs", "use super::c::C; pub struct B;"),
        ("c.rs", "use super::a::A; pub struct C;"),
    ];
    let ties = "  a.rs -> b.rs: B\n  b.rs -> c.rs: C\n  c.rs -> a.rs: A\n";
    assert_eq!(planted(&files), ties);
    // A parent uses its child, which uses the parent's item: in code, and through a macro that lists children.
    let child = ("a/child.rs", "use super::helper; pub fn run() { helper() }");
    for (parent, name) in [
        ("mod child; fn helper() {} pub fn run() { child::run() }", "run"),
        ("mod child; fn helper() {} list! { child }", "child"),
    ] {
        let ties = planted(&[("lib.rs", "mod a;"), ("a/mod.rs", parent), child]);
        let expected =
            format!("  a/child.rs -> a/mod.rs: helper\n  a/mod.rs -> a/child.rs: {name}\n");
        assert_eq!(ties, expected);
    }
}

#[test]
fn what_is_no_circle_is_not_found() {
    for (a, b) in [
        ("use super::b::B; pub struct A(B);", "pub struct B;"),
        // Only in tests.
        (
            "use super::b::B; pub struct A(B);",
            "pub struct B; #[cfg(test)] mod tests { use super::super::a::A; }",
        ),
        ("use super::b::B; pub struct A(B);", "#[cfg(test)] use super::a::A; pub struct B;"),
        // In words.
        ("use super::b::B; pub struct A(B);", "/// See [`super::a::A`].\npub struct B;"),
        // Another crate's name, taken from there.
        (
            "use super::b::B; pub use other::Name; pub struct A(B);",
            "use other::Name; pub struct B(Name);",
        ),
        // Fields and methods.
        ("use super::b::B; pub struct A(B);", "pub struct B; fn f(b: B) { b.a.A() }"),
    ] {
        let ties = planted(&[("lib.rs", "mod a; mod b;"), ("a.rs", a), ("b.rs", b)]);
        assert_eq!(ties, "", "{a} {b}");
    }
    // A parent that re-exports what its children define.
    let files = [
        ("lib.rs", "mod a;"),
        ("a/mod.rs", "mod x; mod y; pub use x::X; pub fn f() -> y::Y { y::Y }"),
        ("a/x.rs", "pub struct X;"),
        ("a/y.rs", "use super::X; pub struct Y(X);"),
    ];
    assert_eq!(planted(&files), "");
}
