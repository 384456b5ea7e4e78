//! Corruption of a file's bytes.

use super::dice::Dice;

/// A kind of corruption.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Damage {
    LastByte,
    Half,
    All,
    /// Flips one bit in a part of the file.
    Flip(Part, usize),
}

/// A part of a file.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Part {
    Beginning,
    Middle,
    End,
}

/// Number of bytes in the first and the last part.
const EDGE: usize = 96;

impl Damage {
    /// Every kind of corruption, with its name in reports.
    pub(crate) fn each(dice: &mut Dice) -> [(&'static str, Damage); 6] {
        let mut flip = |part| Damage::Flip(part, dice.below(1 << 30));
        [
            ("its last byte left out", Damage::LastByte),
            ("its second half left out", Damage::Half),
            ("emptied", Damage::All),
            ("a bit near its beginning turned", flip(Part::Beginning)),
            ("a bit in its middle turned", flip(Part::Middle)),
            ("a bit near its end turned", flip(Part::End)),
        ]
    }

    /// The corrupted file and a description. `None` for an empty file.
    pub(crate) fn of(self, bytes: &[u8]) -> Option<(Vec<u8>, String)> {
        let length = bytes.len();
        if length == 0 {
            return None;
        }
        let kept = match self {
            Damage::LastByte => length - 1,
            Damage::Half => length / 2,
            Damage::All => 0,
            Damage::Flip(part, drawn) => {
                let edge = EDGE.min(length);
                let at = match part {
                    Part::Beginning => drawn % edge,
                    Part::Middle => drawn % length,
                    Part::End => length - 1 - drawn % edge,
                };
                let mut damaged = bytes.to_vec();
                let before = damaged[at];
                damaged[at] ^= 1 << (drawn / length % 8);
                let told = format!("byte {at} is {:#04x} instead of {before:#04x}", damaged[at]);
                return Some((damaged, told));
            }
        };
        Some((bytes[..kept].to_vec(), format!("{kept} bytes")))
    }
}
