//! Blocks of configurations: rows of a batch, or parts of a straight motion.

use std::cell::RefCell;

use fearless_simd::{Simd, dispatch, f64x8, prelude::*};

use super::check::Asked;
use super::lanes::{LANES, WideRow};
use super::model::{Model, Placed};
use super::obstacles::Obstacles;
use crate::error::RobotError;

/// The largest value of a DOF, and the farthest slide, rad or m.
const MOST: f64 = 1e9;

/// What is checked in each configuration.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    pub model: &'a Model,
    pub obstacles: &'a Obstacles,
    /// m.
    pub margin: f32,
}

/// What a thread keeps.
#[derive(Debug, Default)]
pub struct Memory {
    pub placed: Placed,
    pub values: Vec<WideRow>,
    pub travel: Vec<[f64; 2]>,
}

thread_local! {
    static MEMORY: RefCell<Memory> = RefCell::default();
}

/// Runs with this thread's memory, which fits the robot.
pub fn with_memory<T>(model: &Model, act: impl FnOnce(&mut Memory) -> T) -> T {
    let mut memory = MEMORY.try_with(RefCell::take).unwrap_or_default();
    memory.placed.fit(model);
    let found = act(&mut memory);
    let _ = MEMORY.try_with(|kept| kept.replace(memory));
    found
}

impl Model {
    /// # Errors
    /// [`RobotError::Far`].
    pub fn check(&self, configuration: &[f64]) -> Result<(), RobotError> {
        let far = |dof: usize, value: f64| Err(RobotError::Far { dof_idx: dof, value });
        if let Some(dof) = configuration.iter().position(|q| q.abs() > MOST) {
            return far(dof, configuration[dof]);
        }
        for input in self.tape.angles.iter().chain(&self.tape.lengths) {
            let value = input.multiplier * configuration[input.dof] + input.offset;
            // Not a comparison the other way, for what is not a number.
            if !(value.abs() <= MOST) {
                return far(input.dof, configuration[input.dof]);
            }
        }
        Ok(())
    }
}

impl Scene<'_> {
    /// The lanes that touch, of up to eight configurations; the others are like the last one.
    pub fn rows<'a>(
        &self,
        memory: &mut Memory,
        rows: impl ExactSizeIterator<Item = &'a [f64]>,
    ) -> u8 {
        let count = rows.len();
        let dofs = rows.enumerate().fold(0, |_, (lane, row)| {
            memory.values.resize(row.len(), WideRow::default());
            for (to, value) in memory.values.iter_mut().zip(row) {
                to.0[lane..].fill(*value);
            }
            row.len()
        });
        let lanes = ((1u16 << count) - 1) as u8;
        let Memory { placed, values, .. } = memory;
        let asked = Asked { lanes, any: count == 1 };
        dispatch!(self.model.level, simd => self.touching(simd, placed, &values[..dofs], asked))
    }

    /// The lanes that touch, of these parts of a straight motion.
    pub fn parts(
        &self,
        memory: &mut Memory,
        ends: [&[f64]; 2],
        parts: &[f64; LANES],
        any: bool,
    ) -> u8 {
        let Memory { placed, values, .. } = memory;
        values.resize(ends[0].len(), WideRow::default());
        let asked = Asked { lanes: u8::MAX, any };
        dispatch!(self.model.level, simd => {
            between(simd, values, ends, parts);
            self.touching(simd, placed, values, asked)
        })
    }

    #[inline(always)]
    fn touching<S: Simd>(
        &self,
        simd: S,
        placed: &mut Placed,
        values: &[WideRow],
        asked: Asked,
    ) -> u8 {
        placed.place(simd, self.model, values);
        let found = placed.touches_itself(simd, self.model, self.margin, asked);
        if asked.is_done(found) {
            return found;
        }
        found | self.obstacles.touching(simd, placed, self.model, self.margin, asked, found)
    }
}

/// Each DOF at parts of the way between two values; at 1, it is the second one.
#[inline(always)]
fn between<S: Simd>(simd: S, values: &mut [WideRow], ends: [&[f64]; 2], parts: &[f64; LANES]) {
    let part = f64x8::load_array_ref(simd, parts);
    let is_end = part.simd_eq(1.0);
    for (to, (from, end)) in values.iter_mut().zip(ends[0].iter().zip(ends[1])) {
        let value = part * (end - from) + *from;
        *to = WideRow(is_end.select(f64x8::splat(simd, *end), value).to_array());
    }
}
