//! Bytes of all allocations, and steps that are charged, in proportion to the length of a text, whatever the text repeats.
//!
//! A program of its own, with one test: it counts what all threads allocate.

// A test may stop anywhere; an allocator is unsafe.
#![allow(clippy::restriction, clippy::disallowed_methods, unsafe_code)]

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use common::memory;
use urdd_usd::open;

struct Counting;

static ALL: AtomicUsize = AtomicUsize::new(0);

// SAFETY: the system's allocator does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALL.fetch_add(layout.size(), Relaxed);
        // SAFETY: guaranteed by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: guaranteed by the caller.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALL.fetch_add(size, Relaxed);
        // SAFETY: guaranteed by the caller.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn each(count: usize, of: impl Fn(usize) -> String) -> String {
    (0..count).map(|at| of(at) + "\n").collect()
}

/// Texts that say something so many times.
fn kinds(n: usize) -> Vec<(&'static str, String)> {
    let prim = |inside: String| format!("def \"p\" {{\n{inside}}}\n");
    let list = |of: &dyn Fn(usize) -> String| (0..n).map(of).collect::<Vec<_>>().join(", ");
    vec![
        ("prims", each(n, |at| format!("def \"p{at}\" {{}}"))),
        ("prims of one name", each(n, |_| "def \"p\" {}".to_owned())),
        ("attributes", prim(each(n, |at| format!("int a{at} = 1")))),
        ("attributes of one name", prim(each(n, |at| format!("int a = {at}")))),
        ("statements of one list", prim(each(n, |at| format!("append rel r = </a{at}>")))),
        ("targets", prim(format!("rel r = [{}]\n", list(&|at| format!("</a{at}>"))))),
        (
            "statements of one field",
            format!("def \"p\" (\n{}) {{}}\n", "append apiSchemas = \"one\"\n".repeat(n)),
        ),
        (
            "schemas",
            format!("def \"p\" (apiSchemas = [{}]) {{}}\n", list(&|at| format!("\"{at}\""))),
        ),
        (
            "entries of dictionaries",
            format!(
                "class \"c\" (customData = {{\n{}}}) {{}}\n",
                each(n, |at| format!("int e{at} = 1"))
            ) + "def \"p\" (inherits = </c>\ncustomData = {\nint own = 1\n}) {}\n",
        ),
        (
            "sites of a dictionary",
            format!(
                "class \"c\" (customData = {{\n{}}}) {{}}\n",
                each(n, |at| format!("int e{at} = 1"))
            ) + &each(200, |at| format!("class \"r{at}\" (customData = {{\nint own = 1\n}}) {{}}"))
                + &format!(
                    "def \"p\" (inherits = </c>\nreferences = [{}]) {{}}\n",
                    (0..200).map(|at| format!("</r{at}>")).collect::<Vec<_>>().join(", ")
                ),
        ),
        ("times", prim(format!("int a.timeSamples = {{{}}}\n", list(&|at| format!("{at}: 1"))))),
        ("numbers", prim(format!("int[] a = [{}]\n", list(&|_| "1".to_owned())))),
    ]
}

#[test]
fn in_proportion_to_the_text() {
    const FEW: usize = 2000;
    for ((what, few), (_, many)) in kinds(FEW).into_iter().zip(kinds(4 * FEW)) {
        let [few, many] = [few, many].map(|text| {
            let text = format!("#usda 1.0\n{text}");
            let mut files = memory(&[("root.usda", &text)]);
            let (before, left) = (ALL.load(Relaxed), files.left.get());
            open("root.usda", &mut files).unwrap();
            [ALL.load(Relaxed) - before, left - files.left.get()]
        });
        // Tables grow by doubling.
        for (few, many) in few.into_iter().zip(many) {
            assert!(many < 6 * few, "{what}: {few}, and {many} of four times as many");
        }
    }
}
