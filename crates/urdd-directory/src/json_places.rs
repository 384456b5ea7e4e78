//! Finds many positions of a JSON text in one pass.

use std::collections::HashMap;

use super::json_scan::Scan;

/// Byte offsets of the values at many pointers, in one pass through the text.
pub fn find_values(text: &str, pointers: &[&str]) -> Vec<Option<usize>> {
    let mut wanted = Wanted::default();
    for (number, pointer) in pointers.iter().enumerate() {
        let mut parts = pointer.split('/');
        // A pointer is empty or begins with a slash.
        if parts.next() != Some("") {
            continue;
        }
        let place = parts.fold(&mut wanted, |place, part| {
            let key = part.replace("~1", "/").replace("~0", "~");
            place.below.entry(key).or_default()
        });
        place.numbers.push(number);
    }
    let mut found = vec![None; pointers.len()];
    wanted.visit(&mut Scan::new(text), &mut found);
    found
}

/// The pointers that end at a value, and those that continue below it.
#[derive(Default)]
struct Wanted {
    numbers: Vec<usize>,
    below: HashMap<String, Wanted>,
}

impl Wanted {
    /// Records the value that begins here, and moves past it.
    fn visit(&self, scan: &mut Scan<'_>, found: &mut [Option<usize>]) -> Option<()> {
        scan.skip_space();
        scan.peek()?;
        for number in &self.numbers {
            found[*number] = Some(scan.at);
        }
        let list = match scan.peek() {
            Some(b'[') if !self.below.is_empty() => true,
            Some(b'{') if !self.below.is_empty() => false,
            _ => return scan.skip_value(),
        };
        scan.at += 1;
        for index in 0.. {
            scan.skip_space();
            if matches!(scan.peek(), Some(b']' | b'}')) {
                break;
            }
            let below = match list {
                true => self.below.get(index.to_string().as_str()),
                false => {
                    let key = scan.key()?;
                    scan.eat(b':')?;
                    self.below.get(&*key)
                }
            };
            match below {
                // For a duplicate key, only the last value counts.
                Some(below) => {
                    below.forget(found);
                    below.visit(scan, found)?;
                }
                None => scan.skip_value()?,
            }
            if scan.eat(b',').is_none() {
                break;
            }
        }
        scan.eat(if list { b']' } else { b'}' })
    }

    fn forget(&self, found: &mut [Option<usize>]) {
        for number in &self.numbers {
            found[*number] = None;
        }
        self.below.values().for_each(|below| below.forget(found));
    }
}
