//! Obstacles in 32 bits.

use fearless_simd::Simd;

use super::check::Asked;
use super::model::{Model, Placed};

#[derive(Debug, Clone, Default)]
pub struct Obstacles {}

impl Obstacles {
    #[inline(always)]
    pub fn touching<S: Simd>(
        &self,
        _simd: S,
        _placed: &mut Placed,
        _model: &Model,
        _margin: f32,
        _asked: Asked,
        _found: u8,
    ) -> u8 {
        0
    }
}
