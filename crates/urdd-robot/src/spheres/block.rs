//! Blocks of configurations: rows of a batch, or parts of a straight motion.

use std::cell::Cell;

use fearless_simd::{Simd, dispatch, f64x8, prelude::*};

use super::model::Model;
use super::obstacles::Obstacles;
use super::placed::{Asked, Placed};
use crate::lanes::{LANES, WideRow};

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
    /// For which model it is.
    model: u64,
    pub placed: Placed,
    pub values: Vec<WideRow>,
    pub travel: Vec<[f64; 2]>,
}

thread_local! {
    static MEMORY: Cell<Option<Box<Memory>>> = const { Cell::new(None) };
}

/// Runs with this thread's memory, which fits the robot.
pub fn with_memory<T>(model: &Model, act: impl FnOnce(&mut Memory) -> T) -> T {
    let mut memory = MEMORY.try_with(Cell::take).ok().flatten().unwrap_or_default();
    if memory.model != model.number {
        memory.placed.fit(model);
        memory.values.resize(model.most.len(), WideRow::default());
        memory.model = model.number;
    }
    let found = act(&mut memory);
    let _ = MEMORY.try_with(|kept| kept.set(Some(memory)));
    found
}

impl Memory {
    /// Takes up to eight configurations; the other lanes are like the first one. Returns a bit for each lane that is one.
    fn fill<'a>(&mut self, rows: impl ExactSizeIterator<Item = &'a [f64]>) -> u8 {
        let count = rows.len().min(LANES);
        for (lane, row) in rows.take(LANES).enumerate() {
            for (to, value) in self.values.iter_mut().zip(row) {
                match lane {
                    0 => *to = WideRow([*value; LANES]),
                    _ => to.0[lane] = *value,
                }
            }
        }
        ((1u16 << count) - 1) as u8
    }
}

impl Scene<'_> {
    /// The lanes that touch, of up to eight configurations; the others are like the first one.
    pub fn rows<'a>(
        &self,
        memory: &mut Memory,
        rows: impl ExactSizeIterator<Item = &'a [f64]>,
    ) -> u8 {
        let lanes = memory.fill(rows);
        let Memory { placed, values, .. } = memory;
        let asked = Asked { lanes, any: lanes == 1 };
        dispatch!(self.model.level, simd => self.touching(simd, placed, values, asked))
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
        self.obstacles.touching(simd, placed, self.model, self.margin, asked, found)
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
