//! Batches of configurations.

use urdd_kinematics::fill;

#[test]
fn the_first_error_counts() {
    let mut out = vec![0; 3000];
    let write = |_: &mut (), k: usize, out: &mut [usize]| match k {
        517 | 900 => Err(k),
        _ => {
            out.fill(k);
            Ok(())
        }
    };
    assert_eq!(fill(&mut out, 3, 7, write), Err(517));
    let all = |_: &mut (), k: usize, out: &mut [usize]| write(&mut (), k % 500, out);
    assert_eq!(fill(&mut out, 3, 7, all), Ok(()));
    let expected = (0..1000).flat_map(|k| [k % 500; 3]);
    assert!(out.into_iter().eq(expected));
    assert_eq!(fill(&mut [0; 0], 0, 7, write), Ok(()));
}
