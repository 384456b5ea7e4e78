//! The configurations that the specification defines, identical for every producer and validator in any language.

use urdd_kinematics::configurations::*;

/// The first outputs of SplitMix64 with seed 0, as published with the generator.
const PUBLISHED: [u64; 3] = [0xE220_A839_7B1D_CDAF, 0x6E78_9E6A_A1B9_65F4, 0x06C4_5D18_8009_454F];

#[test]
fn is_splitmix64() {
    for (i, published) in (0..).zip(PUBLISHED) {
        assert_eq!(bits(0, i), published);
    }
}

#[test]
fn sample_k_goes_on_where_the_generator_is_after_k_times_2_to_the_32() {
    assert_eq!(bits(3, 5), bits(0, (3 << 32) + 5));
    assert_eq!(bits(1 << 32, 5), bits(0, 5), "wraps at 64 bits");
}
