#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| urdd_fuzz::readers::loops(bytes));
